/* The wrench of a patch from C. Ends with 0 if all of it is as it should be. */
#include <contensou/wrench.h>

#include <math.h>
#include <stdio.h>

int main(void) {
  contensou_law* law = contensou_law_new("exact");
  const contensou_patch patch = {0.2, 3e-3, 1e-4};
  const double motion[3] = {1, 0, 100};
  contensou_wrench wrench;
  const int status = contensou_patch_wrench(law, motion, 1.7, &patch, &wrench);
  const double mobility[2] = {20, 2e4};
  contensou_step after;
  const int stepped = contensou_patch_step(law, motion, mobility, 1.7, &patch, 0.01, &after);
  contensou_law_free(law);
  printf("force %g N, moment %g N m, slopes %g N s/m and %g N m s\n", wrench.force[0], wrench.moment,
         wrench.jacobian[0][0], wrench.jacobian[2][2]);
  return !(status == 0 && stepped == 0 && after.motion[0] < 1 && after.motion[0] > 0.9 && after.force[0] < -0.3 &&
           wrench.force[0] < -0.3 && wrench.force[0] > -0.34 && wrench.force[1] == 0 && wrench.moment < 0 &&
           wrench.jacobian[0][0] < 0 && wrench.jacobian[2][2] < 0 &&
           fabs(wrench.jacobian[0][2] - wrench.jacobian[2][0]) < 1e-15);
}
