/* The wrench of a contact patch under combined dry friction, for physics engines: a C interface to contensou/si/wrench.hpp,
 * which says how it is regularised, what creeps, and which creep speed a time step needs. Nothing throws. */
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
  double creep;    /**< s in m/s, > 0: the speed below which friction is viscous */
} contensou_patch;

/** What friction does to the body, and how that changes with its motion. */
typedef struct contensou_wrench {
  double force[2];       /**< N */
  double moment;         /**< N m, about the normal */
  double jacobian[3][3]; /**< rows: force, moment; columns: vx, vy in m/s, omega in rad/s */
} contensou_wrench;

/** The law of a name that the program takes for --law, such as "exact" or "elliptic:0.6"; to be freed.
 *  Null if there is none, or no memory. */
contensou_law* contensou_law_new(const char* name);

/** Null is allowed. */
void contensou_law_free(contensou_law* law);

/** Does not allocate. Several threads may share a law.
 *
 *  @param motion  vx, vy of the patch centre over the other body in m/s, omega about the normal in rad/s
 *  @param load    N in N; 0 or less is no contact: zeros
 *  @param wrench  zeros if something is wrong
 *  @return        0; or 1 if a pointer is null, a number is not finite, a speed, a stiffness or a result overflows, or a
 *                 member of the patch is out of its range */
int contensou_patch_wrench(const contensou_law* law, const double motion[3], double load, const contensou_patch* patch,
                           contensou_wrench* wrench);

#ifdef __cplusplus
}
#endif

#endif
