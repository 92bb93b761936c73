/** u = R omega_z is the speed of pivoting, v that of sliding, in any one unit; tau = (3 pi/2) f g t has that unit, too. */
export interface State { u: number; v: number }

/** What decides the plane of a body. */
export interface System {
  /** Radius of the contact patch over that of the body, at most 1 for a ball; known of disc, puck and ring. */
  mu?: number;
  /** One of `laws`, with its number behind a colon where it has one, or formulas, as `phi = k/(1 + k); psi = 0.5/(1 + k)`. */
  law?: string;
  /** One of `bodies`; default ball. */
  body?: string;
  /** 1 + m R^2/J and m R^2/J_z, in place of the body's. */
  chi?: number;
  gamma?: number;
  /** A constant force along the slip, over f N. */
  drive?: number;
}

/** One number, or an array of one number for each start. Anything else is a TypeError, such as "1" or a BigInt64Array. */
export type Numbers = number | ArrayLike<number>;

export class Flow {
  /** @throws Error in the library's words, also for an unknown option, with the nearest one */
  constructor(system: System);
  /** What k = v/(mu |u|) tends to. */
  readonly terminalRatio: number;
  /** What that says of the end. */
  readonly meaning: string;
  /** tau until slip and spin have ended. */
  stopTime(start: State): number;
  /** The same for each of many starts; NaN where there is no start. A number belongs to each start. */
  stopTimes(starts: { u: Numbers; v: Numbers }): Float64Array;
  /** From the start to the stop, columns. */
  motion(start: State): { tau: Float64Array; u: Float64Array; v: Float64Array; lnV: Float64Array; k: Float64Array };
  /** After tau; `force` is the friction against the slip, over f N. */
  at(start: State, tau: number): State & { tau: number; k: number; force: number };
  /** Every statement of the theory about this motion, as a number that must be small. */
  check(start: State): { name: string; measured: number; allowed: number; passed: boolean }[];
}

export function stopTime(start: System & State): number;
/** mu may be an array, too. Each of its values costs 3 ms, all of its starts 3 us each. */
export function stopTimes(starts: Omit<System, "mu"> & { mu?: Numbers; u: Numbers; v: Numbers }): Float64Array;

/** SI units. One of patch_radius, spin_deceleration and both moduli tells the patch; neither does, of what lies flat. */
export interface BallFields {
  body?: string; law?: string; radius?: number; mass?: number; friction?: number; gravity?: number;
  patch_radius?: number; spin_deceleration?: number; youngs_modulus?: [number, number]; poisson_ratio?: [number, number];
  slip?: number; spin?: number;
}

/** m/s, rad/s; x along the slip, z up. */
export interface Start { slip?: number; spin?: number; velocity?: [number, number]; angularVelocity?: [number, number, number] }

export interface Roll {
  /** s, until the slip is below rollingBelow; of what lies flat, until it rests. */
  slidesUntil: number;
  /** m, of the centre until then. */
  path: number;
  /** Degrees by which the path has turned until then. */
  turned: number;
  /** s, until slip and spin have ended. */
  stopTime: number;
  /** Columns in SI units, dense at the beginning; with rolling friction where it rests. */
  motion(until?: number): Record<"t" | "x" | "y" | "vx" | "vy" | "wx" | "wy" | "wz" | "slip" | "energy", Float64Array> & { rest?: { t: number; x: number; y: number } };
}

export class Ball {
  /** @throws Error in the library's words */
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
/** The built-in balls by their names; `patch` is what `patchBy` says. */
export const balls: Record<string, Required<Pick<BallFields, "body" | "law" | "radius" | "mass" | "friction" | "gravity" | "slip" | "spin">> & { title: string; sources: string; patchBy: string; patch: number }>;
