/**
 * How a gaze looks, in numbers, from an engine's world matrices (16 numbers, column-major): nothing here asks the package.
 *
 * The criteria and their limits are those of `aim bake` (aim-character/src/bake/plausibility).
 */

export type Vec3 = readonly [number, number, number];
/** Three columns of a rotation. */
export type Turn = readonly [Vec3, Vec3, Vec3];

const DEG = 180 / Math.PI;
const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
];
const scaled = (a: Vec3, by: number): Vec3 => [by * a[0], by * a[1], by * a[2]];
const sum = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const unit = (a: Vec3): Vec3 => scaled(a, 1 / Math.hypot(...a));
export const apply = (m: Turn, v: Vec3): Vec3 => sum(sum(scaled(m[0], v[0]), scaled(m[1], v[1])), scaled(m[2], v[2]));
const transposed = (m: Turn): Turn => [
  [m[0][0], m[1][0], m[2][0]], [m[0][1], m[1][1], m[2][1]], [m[0][2], m[1][2], m[2][2]],
];
const times = (...all: readonly Turn[]): Turn =>
  all.reduce((m, n) => [apply(m, n[0]), apply(m, n[1]), apply(m, n[2])] as const);

/** The rotation of a matrix of positive, near uniform scale: columns orthonormalised in their order. */
export function rotation(e: ArrayLike<number>): Turn {
  const column = (i: number): Vec3 => [e[i] ?? NaN, e[i + 1] ?? NaN, e[i + 2] ?? NaN];
  const x = unit(column(0));
  const y = unit(sum(column(4), scaled(x, -dot(x, column(4)))));
  return [x, y, cross(x, y)];
}
export const origin = (e: ArrayLike<number>): Vec3 => [e[12] ?? NaN, e[13] ?? NaN, e[14] ?? NaN];
/** A world direction in the space of a bone. */
export const inSpaceOf = (e: ArrayLike<number>, v: Vec3): Vec3 => apply(transposed(rotation(e)), v);

/** The angle from where an eye looks to a point, degrees. */
export function offDeg(eye: ArrayLike<number>, forward: Vec3, point: Vec3): number {
  const [looks, wanted] = [apply(rotation(eye), forward), sum(point, scaled(origin(eye), -1))];
  return Math.atan2(Math.hypot(...cross(looks, wanted)), dot(looks, wanted)) * DEG;
}

const wrapped = (deg: number): number => deg - 360 * Math.round(deg / 360);
const elevation = (v: Vec3, up: Vec3): number => Math.asin(Math.max(-1, Math.min(1, dot(unit(v), up)))) * DEG;
/** About `up` from where `front` points, positive to the left, degrees. */
function heading(v: Vec3, up: Vec3, front: Vec3): number {
  const left = cross(up, front);
  return Math.atan2(dot(v, left), dot(v, cross(left, up))) * DEG;
}
function roll(forward: Vec3, left: Vec3, up: Vec3): number {
  const level = unit(cross(up, forward));
  return -Math.atan2(dot(left, cross(forward, level)), dot(left, level)) * DEG;
}
/** Axis times angle, degrees. */
function rotationVector(m: Turn): Vec3 {
  const axis: Vec3 = [m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]];
  const length = Math.hypot(...axis);
  const angle = Math.atan2(length, m[0][0] + m[1][1] + m[2][2] - 1) * DEG;
  return length > 0 ? scaled(axis, angle / length) : [0, 0, 0];
}

/** World matrices of the bones by which a frame is judged. */
export interface Landmarks {
  readonly eye: ArrayLike<number>;
  readonly head: ArrayLike<number>;
  readonly chest: ArrayLike<number>;
}

/** The largest of each, in degrees and seconds. */
export interface Looks {
  headToChest: number;
  headRoll: number;
  headSpeed: number;
  headAcceleration: number;
  reversals: number;
  /** Of the eye in the head, from the rest pose. */
  eyeHeading: number;
  eyePitch: number;
}

/** Acceleration that counts as full one way or the other: half of the head's budget, degrees a second squared. */
const FULL = 600;
const REVERSAL_S = 0.1;
const COUNTED_S = 0.5;
const UP: Vec3 = [0, 1, 0];

/** Follows a character that stands as `rest` in its rest pose, with its front at `front`, level, in a world with +Y up. */
export class Judge {
  readonly looks: Looks = {
    headToChest: 0, headRoll: 0, headSpeed: 0, headAcceleration: 0, reversals: 0, eyeHeading: 0, eyePitch: 0,
  };
  readonly #rest: Readonly<Record<keyof Landmarks, Turn>>;
  readonly #front: Vec3;
  #before: Turn | undefined;
  #velocity: Vec3 | undefined;
  #full: ({ t: number; way: boolean } | undefined)[] = [];
  #reversals: number[][] = [[], [], []];

  constructor(rest: Landmarks, front: Vec3) {
    this.#rest = { eye: rotation(rest.eye), head: rotation(rest.head), chest: rotation(rest.chest) };
    this.#front = unit(front);
  }

  /** The frame at `t` seconds, `dt` after the one before: with the gaze, and as the animation alone has it. */
  push(t: number, dt: number, aimed: Landmarks, animated: Landmarks): void {
    const turned = (from: Landmarks, bone: keyof Landmarks): Turn =>
      times(rotation(from[bone]), transposed(this.#rest[bone]));
    const [head, chest, eye] = [turned(aimed, "head"), turned(aimed, "chest"), turned(aimed, "eye")];
    const animatedHead = turned(animated, "head");
    const front = this.#front;
    const left = cross(UP, front);
    const most = (key: keyof Looks, value: number): void => {
      // NaN stays.
      this.looks[key] = Math.abs(value) <= this.looks[key] ? this.looks[key] : Math.abs(value);
    };
    const of = (turn: Turn): number => heading(apply(turn, front), UP, front);
    const rollOf = (turn: Turn): number => roll(apply(turn, front), apply(turn, left), UP);
    most("headToChest", wrapped(of(head) - of(chest)));
    most("headRoll", wrapped(rollOf(head) - rollOf(animatedHead)));
    const inHead = apply(times(transposed(head), eye), front);
    most("eyeHeading", heading(inHead, UP, front));
    most("eyePitch", elevation(inHead, UP));

    // By what the correction turns the head beyond the chest.
    const correction = times(
      rotation(animated.chest), transposed(rotation(aimed.chest)), rotation(aimed.head), transposed(rotation(animated.head)),
    );
    if (this.#before) {
      const velocity = scaled(rotationVector(times(correction, transposed(this.#before))), 1 / dt);
      most("headSpeed", Math.hypot(...velocity));
      if (this.#velocity) {
        const acceleration = scaled(sum(velocity, scaled(this.#velocity, -1)), 1 / dt);
        most("headAcceleration", Math.hypot(...acceleration));
        acceleration.forEach((along, axis) => { this.#watch(axis, along, t); });
      }
      this.#velocity = velocity;
    }
    this.#before = correction;
  }

  #watch(axis: number, along: number, t: number): void {
    if (Math.abs(along) <= FULL) return;
    const way = along > 0;
    const last = this.#full[axis];
    if (last && last.way !== way && t - last.t <= REVERSAL_S + 1e-6) {
      const recent = [...(this.#reversals[axis] ?? []), t].filter((at) => t - at < COUNTED_S);
      this.#reversals[axis] = recent;
      this.looks.reversals = Math.max(this.looks.reversals, recent.length);
    }
    this.#full[axis] = { t, way };
  }
}

/** The value below which this part of all values is. */
export function quantile(values: readonly number[], part: number): number {
  const sorted = [...values].sort((a, b) => (Number.isNaN(a) ? 1 : Number.isNaN(b) ? -1 : a - b));
  return sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))] ?? NaN;
}
