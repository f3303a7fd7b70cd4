/**
 * Eyes of VRM avatars that are not turned as they look: bones by range maps, and expressions.
 */
import type { VRMCore } from "@pixiv/three-vrm";
import type { Quaternion } from "three";

import { LOCAL } from "./skeleton.js";

type VRMExpressionManager = NonNullable<VRMCore["expressionManager"]>;

/** The expressions that look, in the order of {@link Looks}. */
export const LOOKS = ["lookLeft", "lookRight", "lookUp", "lookDown"] as const;

/** How far an eye turns, or an expression shows, by where it looks. */
interface RangeMap {
  readonly inputMaxValue: number;
  readonly outputScale: number;
}

/** The maps of a file, as the appliers of three-vrm have them. */
export interface RangeMaps {
  readonly rangeMapHorizontalInner?: RangeMap;
  readonly rangeMapHorizontalOuter?: RangeMap;
  readonly rangeMapVerticalDown?: RangeMap;
  readonly rangeMapVerticalUp?: RangeMap;
}

/** The least that an input maximum counts, degrees: one of 0 would make a step of the map. */
const LEAST_INPUT_DEG = 0.01;

/**
 * What a looking angle gives: `outputScale · min(angle, inputMax) / inputMax` by the VRM specification, and likewise on the other side.
 *
 * Where the animation is beyond that, at the looking angle `animated`, it goes on as far as there.
 */
function mapped(map: RangeMap | undefined, angle: number, animated: number): number {
  if (!map) return angle;
  const input = Math.max(map.inputMaxValue, LEAST_INPUT_DEG);
  const most = angle * animated > 0 ? Math.max(input, Math.abs(animated)) : input;
  return (Math.sign(angle) * map.outputScale * Math.min(Math.abs(angle), most)) / input;
}

/** The looking angle that gives `output`, `most` at most. */
function unmapped(map: RangeMap | undefined, output: number, most: number): number {
  if (!map) return output;
  if (!(map.outputScale > 0)) return 0;
  const angle = (Math.max(map.inputMaxValue, LEAST_INPUT_DEG) * Math.abs(output)) / map.outputScale;
  return Math.sign(output) * Math.min(angle, most);
}

/** How far an animation may have an eye look, degrees. */
const MOST_YAW_DEG = 170;
const MOST_PITCH_DEG = 85;

const DEG = Math.PI / 180;

/** Yaw (to the left) and pitch (down) of a direction, degrees. */
const look = { yaw: 0, pitch: 0 };
/** Rotations, xyzw: the one by `look`, and one that has been mapped. In arrays, since numbers in objects may be allocated anew. */
const yawPitch = new Float64Array(4);
const turnedEye = new Float64Array(4);

/** Puts where a rotation turns +Z into `look`. */
function lookOf(x: number, y: number, z: number, w: number): void {
  const left = 2 * (x * z + w * y);
  const up = 2 * (y * z - w * x);
  const front = 1 - 2 * (x * x + y * y);
  look.yaw = Math.atan2(left, front) / DEG;
  look.pitch = Math.atan2(-up, Math.sqrt(left * left + front * front)) / DEG;
}

/** Puts the rotation by `look`, yaw about Y after pitch about X, into `yawPitch`. */
function rotationOfLook(): void {
  const yaw = (look.yaw * DEG) / 2;
  const pitch = (look.pitch * DEG) / 2;
  yawPitch[0] = Math.cos(yaw) * Math.sin(pitch);
  yawPitch[1] = Math.sin(yaw) * Math.cos(pitch);
  yawPitch[2] = -Math.sin(yaw) * Math.sin(pitch);
  yawPitch[3] = Math.cos(yaw) * Math.cos(pitch);
}

/** An eye that is not turned as it looks. */
export interface Eye {
  /** Puts the rotation by which it looks over the one in `into`, in the space that is presented. */
  read(into: Float32Array, offset: number): void;
  /** Turns it so that it looks by the rotation in `from`. */
  write(from: Float32Array, offset: number): void;
}

/** Components of a rotation that differ by less are the same: the core computes with floats. */
const SAME = 4e-7;

/** The rotation of an eye in its animation and as it was written last, as the core has them. */
class Memory {
  readonly animated = new Float32Array(4);
  readonly written = new Float32Array(4);
  any = false;

  /** Whether a rotation to be written is the animation, a float's accuracy apart. */
  isAnimated(from: Float32Array, offset: number): boolean {
    for (let at = 0; at < 4; at++) if (Math.abs(this.animated[at]! - from[offset + 3 + at]!) > SAME) return false;
    return true;
  }

  put(kept: Float32Array, into: Float32Array, offset: number): void {
    for (let at = 0; at < 4; at++) into[offset + 3 + at] = kept[at]!;
  }

  keep(kept: Float32Array, from: Float32Array, offset: number): void {
    for (let at = 0; at < 4; at++) kept[at] = from[offset + 3 + at]!;
  }
}

/** An eye bone that turns by the range maps of the file, the maps of each side. */
export class MappedEye implements Eye {
  readonly #bone: Quaternion;
  readonly #isLeft: boolean;
  readonly #sign: number;
  readonly #maps: () => RangeMaps | undefined;
  readonly #memory = new Memory();
  /** The bone in its animation, and as it was written last. */
  readonly #animated: Quaternion;
  readonly #written: Quaternion;
  /** Where the animation looks, degrees. */
  readonly #animatedLook = { yaw: 0, pitch: 0 };

  constructor(bone: Quaternion, isLeft: boolean, sign: number, maps: () => RangeMaps | undefined) {
    this.#bone = bone;
    this.#isLeft = isLeft;
    this.#sign = sign;
    this.#maps = maps;
    this.#animated = bone.clone();
    this.#written = bone.clone();
  }

  read(into: Float32Array, offset: number): void {
    const memory = this.#memory;
    if (memory.any && this.#bone.equals(this.#written)) {
      memory.put(memory.written, into, offset);
      return;
    }
    // Somebody moved it: that is the animation, and stands for a looking angle just as what is written does.
    const { x, y, z, w } = this.#animated.copy(this.#bone);
    this.#map(this.#sign * x, y, this.#sign * z, w, true);
    for (let at = 0; at < 4; at++) into[offset + 3 + at] = turnedEye[at]!;
    this.#animatedLook.yaw = look.yaw;
    this.#animatedLook.pitch = look.pitch;
    memory.keep(memory.animated, into, offset);
    memory.any = false;
  }

  write(from: Float32Array, offset: number): void {
    const memory = this.#memory;
    const sign = this.#sign;
    // Without a correction the very animation, even where the maps do not reach it.
    if (memory.isAnimated(from, offset)) this.#bone.copy(this.#animated);
    else {
      this.#map(from[offset + 3]!, from[offset + 4]!, from[offset + 5]!, from[offset + 6]!, false);
      this.#bone.set(sign * turnedEye[0]!, turnedEye[1]!, sign * turnedEye[2]!, turnedEye[3]!);
    }
    this.#written.copy(this.#bone);
    memory.keep(memory.written, from, offset);
    memory.any = true;
  }

  /** Puts a rotation q = L·R, of which L looks by yaw and pitch, into `turnedEye` with both mapped, or mapped back; the roll R stays. */
  #map(x: number, y: number, z: number, w: number, back: boolean): void {
    const maps = this.#maps();
    lookOf(x, y, z, w);
    rotationOfLook();
    const a = yawPitch[0]!;
    const b = yawPitch[1]!;
    const c = yawPitch[2]!;
    const d = yawPitch[3]!;
    // R = L⁻¹·q
    const i = d * x - a * w - b * z + c * y;
    const j = d * y - b * w - c * x + a * z;
    const k = d * z - c * w - a * y + b * x;
    const l = d * w + a * x + b * y + c * z;
    const outward = this.#isLeft ? look.yaw > 0 : look.yaw < 0;
    const level = outward ? maps?.rangeMapHorizontalOuter : maps?.rangeMapHorizontalInner;
    const upright = look.pitch > 0 ? maps?.rangeMapVerticalDown : maps?.rangeMapVerticalUp;
    const { yaw, pitch } = this.#animatedLook;
    look.yaw = back ? unmapped(level, look.yaw, MOST_YAW_DEG) : mapped(level, look.yaw, yaw);
    look.pitch = back ? unmapped(upright, look.pitch, MOST_PITCH_DEG) : mapped(upright, look.pitch, pitch);
    rotationOfLook();
    const e = yawPitch[0]!;
    const f = yawPitch[1]!;
    const g = yawPitch[2]!;
    const h = yawPitch[3]!;
    turnedEye[0] = h * i + e * l + f * k - g * j;
    turnedEye[1] = h * j + f * l + g * i - e * k;
    turnedEye[2] = h * k + g * l + e * j - f * i;
    turnedEye[3] = h * l - e * i - f * j - g * k;
  }
}

/** Weights of `lookLeft`, `lookRight`, `lookUp`, `lookDown`. */
type Looks = [number, number, number, number];

/** Both eyes of an avatar that looks by expressions, as one between them: both show the same. */
export class ExpressedEye implements Eye {
  readonly #expressions: VRMExpressionManager;
  readonly #maps: () => RangeMaps | undefined;
  readonly #rest: readonly number[];
  readonly #memory = new Memory();
  /** The weights in their animation, and as they were written last. */
  readonly #animated: Looks = [0, 0, 0, 0];
  readonly #written: Looks = [0, 0, 0, 0];
  /** Where the animation looks, degrees. */
  readonly #animatedLook = { yaw: 0, pitch: 0 };

  constructor(expressions: VRMExpressionManager, rest: readonly number[], maps: () => RangeMaps | undefined) {
    this.#expressions = expressions;
    this.#rest = rest;
    this.#maps = maps;
  }

  read(into: Float32Array, offset: number): void {
    for (let at = 0; at < LOCAL; at++) into[offset + at] = this.#rest[at]!;
    const memory = this.#memory;
    if (memory.any && this.#has(this.#written)) {
      memory.put(memory.written, into, offset);
      return;
    }
    this.#get(this.#animated);
    const weights = this.#animated;
    const maps = this.#maps();
    const level = maps?.rangeMapHorizontalOuter;
    look.yaw = unmapped(level, weights[0], MOST_YAW_DEG) - unmapped(level, weights[1], MOST_YAW_DEG);
    look.pitch =
      unmapped(maps?.rangeMapVerticalDown, weights[3], MOST_PITCH_DEG) - unmapped(maps?.rangeMapVerticalUp, weights[2], MOST_PITCH_DEG);
    this.#animatedLook.yaw = look.yaw;
    this.#animatedLook.pitch = look.pitch;
    rotationOfLook();
    for (let at = 0; at < 4; at++) into[offset + 3 + at] = yawPitch[at]!;
    memory.keep(memory.animated, into, offset);
    memory.any = false;
  }

  write(from: Float32Array, offset: number): void {
    const memory = this.#memory;
    const written = this.#written;
    if (memory.isAnimated(from, offset)) for (let at = 0; at < 4; at++) written[at] = this.#animated[at]!;
    else {
      const maps = this.#maps();
      // By the specification both sides have the outer map.
      const level = maps?.rangeMapHorizontalOuter;
      lookOf(from[offset + 3]!, from[offset + 4]!, from[offset + 5]!, from[offset + 6]!);
      const { yaw, pitch } = this.#animatedLook;
      const side = mapped(level, look.yaw, yaw);
      const height = mapped(look.pitch > 0 ? maps?.rangeMapVerticalDown : maps?.rangeMapVerticalUp, look.pitch, pitch);
      written[0] = Math.max(side, 0);
      written[1] = Math.max(-side, 0);
      written[2] = Math.max(-height, 0);
      written[3] = Math.max(height, 0);
    }
    for (let at = 0; at < 4; at++) this.#expressions.setValue(LOOKS[at]!, written[at]!);
    // Weights are clamped, and expressions that are missing have none.
    this.#get(written);
    memory.keep(memory.written, from, offset);
    memory.any = true;
  }

  #get(weights: Looks): void {
    for (let at = 0; at < 4; at++) weights[at] = this.#expressions.getValue(LOOKS[at]!) ?? 0;
  }

  #has(weights: Looks): boolean {
    for (let at = 0; at < 4; at++) if ((this.#expressions.getValue(LOOKS[at]!) ?? 0) !== weights[at]) return false;
    return true;
  }
}
