/* The force and moment of a contact patch under combined dry friction, and time steps under this friction, for physics
 * engines: a C interface to contensou/si/wrench.hpp. Nothing throws. */
#ifndef CONTENSOU_WRENCH_H
#define CONTENSOU_WRENCH_H

#ifdef __cplusplus
extern "C" {
#endif

/** A friction law. */
typedef struct contensou_law contensou_law;

/** A circular contact patch. */
typedef struct contensou_patch {
  double friction; /**< f, >= 0 */
  double radius;   /**< eps in m, >= 0 */
  double creep;    /**< speed s in m/s, > 0, below which friction is viscous; contensou_patch_step ignores it */
} contensou_patch;

/** The friction of a patch on a body, and its derivatives by the motion. */
typedef struct contensou_wrench {
  double force[2];       /**< N */
  double moment;         /**< N m, about the normal */
  double jacobian[3][3]; /**< rows: force, moment; columns: vx, vy in m/s, omega in rad/s */
} contensou_wrench;

/** Slip and spin after a time step, and the friction during the step. */
typedef struct contensou_step {
  double motion[3]; /**< vx, vy in m/s, omega in rad/s */
  double force[2];  /**< mean force in N; multiplied by dt, the impulse to apply */
  double moment;    /**< mean moment in N m */
} contensou_step;

/** Returns the law of a name as in the program's --law, such as "exact" or "elliptic:0.6". The caller must free it.
 *  Returns null if there is no such law, or no memory. */
contensou_law* contensou_law_new(const char* name);

/** Frees a law; null is allowed. */
void contensou_law_free(contensou_law* law);

/** Computes the wrench of a patch. It does not allocate. Several threads may share a law.
 *
 *  @param motion  vx, vy of the patch centre over the other body in m/s, omega about the normal in rad/s
 *  @param load    N in newtons; for 0 or less there is no contact, and the wrench is 0
 *  @param wrench  result; zeros in case of an error
 *  @return        0; or 1 if a pointer is null, a number is not finite, a slope or a result overflows, or a member of
 *                 the patch is out of its range */
int contensou_patch_wrench(const contensou_law* law, const double motion[3], double load, const contensou_patch* patch,
                           contensou_wrench* wrench);

/** Computes an implicit time step under dry friction. It never adds energy, and it brings a contact to rest that
 * friction can stop within dt (contensou/wrench_kernel.h). It does not allocate. Several threads may share a law.
 *
 *  @param motion    as above, changed already by all other forces of the step
 *  @param mobility  change of slip by a unit of impulse at the contact in 1/kg, for a ball 3.5/m; change of spin by a
 * unit of angular impulse in 1/(kg m^2), 1/J_z; both >= 0
 *  @param load      as above
 *  @param dt        time step in s, >= 0
 *  @param after     result; zeros in case of an error
 *  @return          0; or 1 if a pointer is null, a number is not finite or out of its range, or a result overflows */
int contensou_patch_step(const contensou_law* law, const double motion[3], const double mobility[2], double load,
                         const contensou_patch* patch, double dt, contensou_step* after);

#ifdef __cplusplus
}
#endif

#endif
