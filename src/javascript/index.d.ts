/** u = R omega_z: pivoting speed; v: sliding speed, both in any one unit. tau = (3 pi/2) f g t has this unit, too. */
export interface State { u: number; v: number }

/** The numbers that determine the equations of motion. */
export interface System {
  /** Radius of the contact patch divided by that of the body, at most 1 for a ball; default 1 for disc, puck and ring. */
  mu?: number;
  /** Name of one of `laws`, with a colon and a number for a law with a letter; or formulas, such as `phi = k/(1 + k); psi = 0.5/(1 + k)`. */
  law?: string;
  /** Name of one of `bodies`; default ball. */
  body?: string;
  /** 1 + m R^2/J and m R^2/J_z, instead of those of the body. */
  chi?: number;
  gamma?: number;
  /** Constant force along the slip, divided by f N. */
  drive?: number;
}

/** One number, or an array with one number for each start. Other values, such as "1" or a BigInt64Array, throw a TypeError. */
export type Numbers = number | ArrayLike<number>;

export class Flow {
  /** @throws Error with the message of the library; for an unknown option, with the nearest one */
  constructor(system: System);
  /** Limit of k = v/(mu |u|) at the stop. */
  readonly terminalRatio: number;
  /** Meaning of this limit in words. */
  readonly meaning: string;
  /** Returns the time tau until slip and spin end. */
  stopTime(start: State): number;
  /** Returns the stop times of many starts; NaN for values that are no start. A single number applies to all starts. */
  stopTimes(starts: { u: Numbers; v: Numbers }): Float64Array;
  /** Returns the motion from the start to the stop as columns. */
  motion(start: State): { tau: Float64Array; u: Float64Array; v: Float64Array; lnV: Float64Array; k: Float64Array };
  /** Returns the state after the time tau; `force` is the friction against the slip, divided by f N. */
  at(start: State, tau: number): State & { tau: number; k: number; force: number };
  /** Returns each statement of the theory about this motion as a number that must be small. */
  check(start: State): { name: string; measured: number; allowed: number; passed: boolean }[];
}

export function stopTime(start: System & State): number;
/** mu may be an array, too. Up to 31 of its values cost a Flow each. From 32 values on, all of them share tables, which are kept. */
export function stopTimes(starts: Omit<System, "mu"> & { mu?: Numbers; u: Numbers; v: Numbers }): Float64Array;

/** A contact patch for one time step. */
export interface Contact {
  /** As in System; default exact. */
  law?: string;
  /** Slip vx, vy in m/s and spin in rad/s, changed already by all other forces of the step. */
  motion: ArrayLike<number> & Iterable<number>;
  /** N, for 0 or less there is no contact; coefficient of friction; radius of the patch, m; time step, s. */
  load: number; friction: number; radius: number; dt: number;
  /** Change of slip by a unit of impulse at the contact, 1/kg, for a ball 3.5/m; change of spin by a unit of angular impulse, 1/J_z. */
  byForce: number; byMoment: number;
}
/** Returns slip and spin after an implicit time step under dry friction, and mean force in N and moment in N m; times dt, they are the
 *  impulses to apply. The step never adds energy. A contact rests after it if friction can stop it within dt.
 *  @throws Error for a number out of its range */
export function step(contact: Contact): { motion: [number, number, number]; force: [number, number]; moment: number };

/** Fields of a ball in SI units. patch_radius, spin_deceleration or both moduli give the patch; a disc or ring needs none of them. */
export interface BallFields {
  body?: string; law?: string; radius?: number; mass?: number; friction?: number; gravity?: number;
  patch_radius?: number; spin_deceleration?: number; youngs_modulus?: [number, number]; poisson_ratio?: [number, number];
  slip?: number; spin?: number;
}

/** A start in m/s and rad/s; x along the slip, z up. */
export interface Start { slip?: number; spin?: number; velocity?: [number, number]; angularVelocity?: [number, number, number] }

export interface Roll {
  /** Time until the slip is below rollingBelow, or until a disc or ring rests, s. */
  slidesUntil: number;
  /** Path of the centre until then, m. */
  path: number;
  /** Change of the direction of the path until then, degrees. */
  turned: number;
  /** Time until slip and spin end, s. */
  stopTime: number;
  /** Returns columns in SI units, dense at the beginning; with rolling friction also time and place of rest. */
  motion(until?: number): Record<"t" | "x" | "y" | "vx" | "vy" | "wx" | "wy" | "wz" | "slip" | "energy", Float64Array> & { rest?: { t: number; x: number; y: number } };
}

export class Ball {
  /** @throws Error with the message of the library */
  constructor(ball: string | BallFields, changes?: BallFields);
  readonly law: string;
  readonly mu: number;
  /** m */
  readonly patchRadius: number;
  /** rad/s^2 */
  readonly spinDeceleration: number;
  roll(start?: Start, options?: { rollingFriction?: number; rollingBelow?: number }): Roll;
}

export const laws: { name: string; meaning: string; letter?: string; example?: number }[];
export const bodies: { name: string; chi: number; gamma: number; mu?: number }[];
/** The built-in balls by their names. `patchBy` is the name of the field that `patch` contains. */
export const balls: Record<string, Required<Pick<BallFields, "body" | "law" | "radius" | "mass" | "friction" | "gravity" | "slip" | "spin">> & { title: string; sources: string; patchBy: string; patch: number }>;
