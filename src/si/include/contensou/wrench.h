/* The force and moment of a contact patch under combined dry friction, for physics engines: a C interface to
 * contensou/si/wrench.hpp, which describes the regularisation and the choice of the creep speed. Nothing throws. */
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
  double creep;    /**< speed s in m/s, > 0, below which friction is viscous */
} contensou_patch;

/** The friction of a patch on a body, and its derivatives by the motion. */
typedef struct contensou_wrench {
  double force[2];       /**< N */
  double moment;         /**< N m, about the normal */
  double jacobian[3][3]; /**< rows: force, moment; columns: vx, vy in m/s, omega in rad/s */
} contensou_wrench;

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

#ifdef __cplusplus
}
#endif

#endif
