// Types of the values that modules exchange. The file bindings.cpp defines the functions of the library.

type Store = import("./state/store.js").Store;
type Player = import("./state/player.js").Player;
type Hero = import("./hero/hero.js").Hero;
type Facts = import("./hero/story.js").Facts;
type Plane = import("./plane/plane.js").Plane;
type Copies = import("./plane/copies.js").Copies;
type Frame = import("./drawing/frame.js").Frame;
type Controls = ReturnType<typeof import("./controls/fields.js").makeControls>;

interface Speeds { u: number; v: number }
/** The start of a motion. along, across: velocity of a real ball's centre, m/s, in the direction of the slip and to the left of it;
 *  heading: direction of the throw on the screen, degrees to the left. */
interface Start extends Speeds { along: number; across: number; heading: number }

/** The state; page_state.js describes each member. */
interface State {
  law: string; body: string; mu: number;
  view: string; window: number[] | null; against: string | null; field: string; isochrones: number;
  orbits: Start[]; chosen: number; fraction: number; part: string; isochrone: number;
  ball: Ball | null; theme: string; embed: boolean; project: boolean; lab: boolean; step: number; line: number; day: string; tries: number; system: string; points: number[][]; drop: number; restitution: number;
}

interface Ball {
  name: string; title: string; body: string; law: string; sources: string; patchBy: string;
  radius: number; mass: number; friction: number; gravity: number; patch: number;
  slip: number; spin: number; rollingFriction: number; slope: number; initial?: Ball;
}

interface Law { name: string; meaning: string; letter?: string; example?: number }
interface Body { name: string; chi: number; gamma: number; mu?: number }
interface View { name: string; title: string; hint: string; layered: boolean }
interface Contact { mu: number; patchRadius: number; spinDeceleration: number; secondsPerTau: number; drive: number; without: string; momentArm: number }

/** The request for a portrait, made by portrait_request.js. */
interface PortraitRequest extends Pick<State, "law" | "mu" | "chosen" | "view" | "window" | "isochrones" | "field" | "against"> {
  chi: number; gamma: number; screen: boolean; linear: boolean; drive: number; orbits: Speeds[]; ball: object & Ball & { velocity: number[]; angular_velocity: number[] } | null;
}

/** Columns. */
interface Motion { tau: Float64Array; u: Float64Array; v: Float64Array; k: Float64Array; lnV: Float64Array }
interface OwnOrbit extends Omit<Motion, "lnV"> { stop: number; panels: { line: Float64Array; arrow: Float64Array }[] }
interface Instant extends Speeds { tau: number; k: number; places: Float64Array }
/** SI units. end: time when sliding ends; path: path of the centre until then; turned: change of its direction, degrees; stop: time when slip and spin end. */
interface Slide { end: number; path: number; turned: number; stop: number }
/** SI units. down, up: normal speeds; before, after: speeds along the floor. */
interface Rebound { down: number; up: number; before: number; after: number }
/** Columns in SI units. */
interface Ride {
  t: Float64Array; x: Float64Array; y: Float64Array; vx: Float64Array; vy: Float64Array; wx: Float64Array; wy: Float64Array; wz: Float64Array;
  slip: Float64Array; energy: Float64Array; rest?: { t: number; x: number; y: number };
}

type Words = import("./drawing/runs.js").Text;
interface Tick { at: number; text: Words }
interface Axis { name: Words; low: number; high: number; ticks: Tick[] }
interface Lines { lines: Float64Array | number[]; colour: string; width: number; dashed: boolean; legend: Words; shape?: undefined }
interface Marks { points: Float64Array | number[]; colour: string; size: number; shape: string; legend: Words }
interface Label { x: number; y: number; text: Words; colour: string; align: string }
interface Panel {
  title: Words; x: Axis; y: Axis; lines: Lines[]; marks: Marks[]; labels: Label[]; bare: boolean; to_scale: boolean;
  arrows: { arrows: Float64Array; colour: string }[]; regions: { border: Float64Array; colour: string }[];
}
interface Figure {
  narrowest: number;
  title: Words; panels: Panel[]; ground: string; ink: string; faint: string; line: number; columns: number;
  colour_bar?: { name: Words; colours: string[]; ticks: Tick[] };
}
/** The layout in pixels. colours: boxes from the bottom up. */
interface Layout {
  texts: { x: number; y: number; text: Words; size: number; align: string; turned: boolean; bold: boolean }[];
  panels: { box: Box; x: Tick[]; y: Tick[] }[];
  legend: { legend: Words; x: number; y: number; width: number }[]; colours: Box[];
}
interface Box { left: number; top: number; width: number; height: number }
interface Portrait { figure: Figure; window: [number, number]; through: Speeds[] }

interface Library {
  laws: Law[]; bodies: Body[]; balls: Ball[]; views: View[]; rollingSlip: number; plane: LibraryPlane;
  cueMass: number; largestTipOffset: number;
  lawName(called: string): string; contact(law: string, ball: object): Contact; typedPortrait(typed: string, points: number[], screen: boolean): Figure;
  struck(ball: object, speed: number, right: number, above: number, elevation: number): BallStart;
  bounce(law: string, ball: object, asBuilt: boolean, height: number, restitution: number): Rebound;
  fit(film: string, name: string, ball: object, laws: string[]): Fitted;
  layOut(figure: Figure, width: number, height: number, letter: number): Layout;
  rowsOf(figure: { panels: unknown[]; columns: number; narrowest: number }, width: number): number;
}
/** Columns in SI units: t, the measured values of each observable of a film and, with _fitted, the fitted values. */
type Columns = Record<string, Float64Array>;
interface Measured { ball: string; columns: Columns }
/** SI units. slip, spin; along, across: velocity of the centre along the slip and to the left of it. */
interface BallStart { slip: number; spin: number; along: number; across: number }
interface Fitted { measured: Columns; report: string; notes: string; law: string; friction: number; patch: number; start: BallStart; figure: Figure }
interface LibraryPlane {
  choose(law: string, mu: number, chi: number, gamma: number, drive: number): { terminalRatio: number; meaning: string };
  portrait(request: PortraitRequest): Portrait; own(request: PortraitRequest): OwnOrbit[]; portraitFile(request: PortraitRequest): string;
  stop(u: number, v: number): number; stopBy(law: string, mu: number, u: number, v: number): number; force(u: number, v: number): number;
  motion(u: number, v: number): Motion; instant(u: number, v: number, tau: number): Instant; isochrone(tau: number): Float64Array[];
  place(u: number, v: number): Float64Array; at(panel: number, x: number, y: number): Speeds | null;
  slide(ball: object, rollingFriction: number, least: number): Slide; ride(ball: object, rollingFriction: number, end: number): Ride;
}

/** An element of the page, with the members of fields, lists, forms, links and canvases. */
interface PageElement extends HTMLElement {
  href: string; width: number; height: number; toBlob: HTMLCanvasElement["toBlob"]; get value(): string; set value(value: string | number);
  checked: boolean; disabled: boolean; options: HTMLCollectionOf<HTMLOptionElement>; files: FileList; elements: Record<string, PageElement>;
}

declare module "contensou" {
  const load: (options: { wasmBinary: ArrayBuffer }) => Promise<Omit<Library, "laws" | "bodies" | "balls" | "views" | "plane"> & {laws(): Law[]; bodies(): Body[]; catalogue(): Ball[]; views(): View[]; Plane: new () => LibraryPlane}>;
  export default load;
}
