import { GazeError } from "./error.js";
import type { Engine, RawCharacter } from "./load.js";
import { LOCAL } from "./skeleton.js";
import type { Skeleton } from "./skeleton.js";

/** A point in the world. */
export interface Point {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

/** Writes where a target is in the world into `into`, x y z from `offset` on; throws what a target should have been if it is none. */
export type Locate<P> = (target: P, into: Float32Array, offset: number) => void;

/** One of several targets. Both properties are read each frame. */
export interface WeightedTarget<P> {
  readonly target: P;
  /** Its share of the gaze, 0…1; shares that add up to less than 1 leave the rest to the animation. */
  readonly weight: number;
}

/**
 * Whether the target is reached, and if not, why.
 *
 * - `no_target`: there is nothing to look at; the character returns to its animation, or has
 * - `reached`
 * - `on_the_way`: within reach, as soon as the speeds of the joints allow
 * - `at_limit`: out of reach of the ranges of motion
 * - `behind`: behind the character and out of reach; {@link Gaze.behind} says what becomes of it
 * - `degenerate`: the pose or a target is not finite, or lies on the eye; the character stays as it is
 */
export type Status = "no_target" | "reached" | "on_the_way" | "at_limit" | "behind" | "degenerate";

const STATUSES: readonly Status[] = ["no_target", "reached", "on_the_way", "at_limit", "behind", "degenerate"];

/**
 * What becomes of a target behind the character.
 *
 * - `clip`: looked at as far to the side as goes
 * - `off`: as any other, whichever way round
 * - `plane`: what is in front of a plane counts
 * - `hold`: the character stays as it is
 * - `release`: the character returns to its animation
 */
export type Behind = "clip" | "off" | "plane" | "hold" | "release";

const BEHINDS: readonly Behind[] = ["clip", "off", "plane", "hold", "release"];

/** A change that a gaze tells of; see {@link Gaze.on}. */
export type GazeEvent = "reached" | "lost" | "outofreach" | "turnbody";

const EVENTS: readonly GazeEvent[] = ["reached", "lost", "outofreach", "turnbody"];

/** A joint of the rig. */
export interface GazeJoint {
  /** Its name in the rig, such as `neck`. */
  readonly name: string;
  /** The index of its bone in the skeleton. */
  readonly bone: number;
  /** By how much it is turned to the character's left beyond its animation, radians. */
  readonly heading: number;
  /** By how much it is turned up beyond its animation, radians. */
  readonly pitch: number;
}

/** The gaze that turns a bone, by what stands for the bone in the engine. */
const owners = new WeakMap<object, WeakRef<Gaze<never>>>();

/** 0.1°. */
const TOLERANCE = 0.1 * (Math.PI / 180);

/**
 * A character that looks at things.
 *
 * Targets are kept as they are given and located anew each frame: those that move are followed.
 */
export class Gaze<P = Point> {
  /** How far the character goes from its animation to the target, 0…1. */
  weight = 1;
  /** How far the head takes over from the eyes beyond what people do without thinking, 0…1. */
  attention = 0;
  /** For how long the character stays with a target that is out of reach, seconds; then it returns to its animation. */
  patience = Infinity;
  /** The angle up to which the target counts as reached, radians. */
  tolerance = TOLERANCE;
  /** The joints, from the eye inward. */
  readonly joints: readonly GazeJoint[];

  readonly #engine: Engine;
  readonly #skeleton: Skeleton;
  readonly #locate: Locate<P>;
  /** `undefined` once the gaze is disposed of. */
  #character: RawCharacter | undefined;
  /** The engine's numbers; made anew where its memory has grown. */
  #block: Float32Array;
  readonly #address: number;
  readonly #length: number;
  readonly #at: { place: number; settings: number; outcome: number; targets: number; mostTargets: number; bones: number };
  /** For each bone of the block its index in the skeleton. */
  readonly #bones: Uint32Array;
  /** The bones of the block that are written. */
  readonly #written: Uint32Array;
  #targets: readonly WeightedTarget<P>[] = [];
  #behind = 0;
  #snaps = false;
  /** Whether the bones are known to be this gaze's alone. */
  #owns = false;
  /** Frames of more than a second, one after the other. */
  #longFrames = 0;
  #status: Status = "no_target";
  #turns = false;
  readonly #listeners: Record<GazeEvent, ((gaze: this) => void)[]> = { reached: [], lost: [], outofreach: [], turnbody: [] };

  /** @internal */
  constructor(engine: Engine, character: RawCharacter, skeleton: Skeleton, locate: Locate<P>) {
    this.#engine = engine;
    this.#character = character;
    this.#skeleton = skeleton;
    this.#locate = locate;
    const [place, settings, outcome, targets, mostTargets, bones] = engine.layout() as unknown as Six;
    this.#at = { place, settings, outcome, targets, mostTargets, bones };
    this.#address = character.block();
    this.#length = character.blockLength();
    this.#block = this.#view();
    this.#bones = character.bones();
    this.#written = character.written();
    const angles = bones + LOCAL * this.#bones.length;
    const angle = (at: number) => this.#numbers()[angles + at]!;
    this.joints = Array.from(character.joints(), (bone, joint) => ({
      name: character.jointName(joint),
      bone: this.#bones[bone]!,
      get heading() {
        return angle(2 * joint);
      },
      get pitch() {
        return angle(2 * joint + 1);
      },
    }));
  }

  /** What the character looks at; `null` for nothing. Of several targets the first. */
  get target(): P | null {
    return this.#targets[0]?.target ?? null;
  }

  set target(target: P | null) {
    if (target === undefined) throw new GazeError("the target is undefined: was it found? Nothing to look at is `null`");
    this.targets = target === null ? [] : [{ target, weight: 1 }];
  }

  /** What the character looks at, by weights. */
  get targets(): readonly WeightedTarget<P>[] {
    return this.#targets;
  }

  set targets(targets: readonly WeightedTarget<P>[]) {
    this.#living();
    const most = this.#at.mostTargets;
    if (!Array.isArray(targets)) throw new GazeError("`targets` takes an array of { target, weight }; a single one is set as `target`");
    if (targets.length > most) throw new GazeError(`a gaze has ${most} targets at most, these are ${targets.length}: leave out the lightest`);
    for (const given of targets) {
      const { target, weight } = given ?? {};
      if (typeof weight !== "number") throw new GazeError("each of several targets takes a weight of 0…1: { target, weight: 0.5 }");
      this.#locate(target, new Float32Array(3), 0);
    }
    this.#targets = Object.freeze([...targets]);
  }

  /** What becomes of a target behind the character. */
  get behind(): Behind {
    return BEHINDS[this.#behind]!;
  }

  set behind(behind: Behind) {
    const index = BEHINDS.indexOf(behind);
    if (index < 0) throw new GazeError(`\`behind\` takes one of ${quoted(BEHINDS)}, not ${show(behind)}`);
    this.#behind = index;
  }

  /** Whether the target was reached by the last {@link update}, and if not, why. */
  get status(): Status {
    return this.#status;
  }

  /** The angle that remains to the target, radians; 0 without one. */
  get remaining(): number {
    return this.#numbers()[this.#at.outcome + 1]!;
  }

  /** The turn, radians to the left, that the body would have to make for the target to come into reach; 0 where it is. */
  get bodyTurn(): number {
    return this.#numbers()[this.#at.outcome + 2]!;
  }

  /** For how long the target has been out of reach, seconds. */
  get outOfReachFor(): number {
    return this.#numbers()[this.#at.outcome + 3]!;
  }

  /**
   * Turns the bones to the target: one frame of `dt` seconds, after the animation has set them and before they are drawn.
   *
   * A bone that nothing has moved since the last call counts as it was before that call, so turns do not add up. Frames of 0 seconds
   * hold the gaze; those of more than 0.1 seconds count as 0.1.
   */
  update(dt: number): void {
    const character = this.#living();
    if (typeof dt !== "number" || Number.isNaN(dt)) {
      throw new GazeError(`update takes the seconds since the last frame, not ${show(dt)}`);
    }
    this.#suspect(dt);
    const skeleton = this.#skeleton;
    if (!this.#owns) this.#own();
    const { place, settings, targets: points } = this.#at;
    skeleton.begin?.();
    const block = this.#read();
    skeleton.place(block, place);
    block[settings] = this.weight;
    block[settings + 1] = this.attention;
    block[settings + 2] = this.patience;
    block[settings + 3] = this.tolerance;
    block[settings + 4] = this.#behind;
    const targets = this.#targets;
    for (let at = 0; at < targets.length; at++) {
      const { target, weight } = targets[at]!;
      this.#locate(target, block, points + 4 * at);
      block[points + 4 * at + 3] = weight;
    }
    try {
      character.update(dt, targets.length, this.#snaps);
    } catch (error) {
      throw this.#broken(error);
    }
    if (targets.length > 0) this.#snaps = false;
    const moved = this.#numbers();
    this.#write(moved);
    skeleton.end?.();
    this.#tell(STATUSES[moved[this.#at.outcome]!]!);
  }

  /**
   * Puts the bones back as they are animated, until the next {@link update}, which goes on where the last one was. To be called before a
   * mixer starts, fades or stops actions: it takes what the bones have then for the pose without a clip.
   */
  restore(): void {
    const character = this.#living();
    this.#skeleton.begin?.();
    this.#read();
    character.restore();
    this.#write(this.#numbers());
  }

  /** Has the next {@link update} put the character on its target at once, whatever the speeds of its joints: after a spawn or a cut. */
  snap(): void {
    this.#living();
    this.#snaps = true;
  }

  /**
   * Calls `listener` when something changes, in {@link update}; returns what takes it off again.
   *
   * - `reached`: the target is reached
   * - `lost`: it is not any more: it moves too fast, is out of reach, or gone
   * - `outofreach`: it has come out of reach
   * - `turnbody`: the character can follow only if its body turns; {@link bodyTurn} says by how much
   */
  on(event: GazeEvent, listener: (gaze: this) => void): () => void {
    if (!EVENTS.includes(event)) throw new GazeError(`there are the events ${quoted(EVENTS)}, not ${show(event)}`);
    if (typeof listener !== "function") throw new GazeError(`on("${event}", …) takes a function, not ${show(listener)}`);
    const listeners = this.#listeners[event];
    listeners.push(listener);
    return () => {
      const at = listeners.indexOf(listener);
      if (at >= 0) listeners.splice(at, 1);
    };
  }

  /** Puts the bones back to their animation and lets go of the character. Nothing but a second `dispose` may be called afterwards. */
  dispose(): void {
    const character = this.#character;
    if (!character) return;
    this.#read();
    character.restore();
    this.#write(this.#numbers());
    this.#skeleton.dispose?.();
    this.#character = undefined;
    this.#targets = [];
    this.#status = "no_target";
    character.free();
  }

  /** Reads the bones as they are into the block. */
  #read(): Float32Array {
    const block = this.#numbers();
    const { bones } = this.#at;
    for (let at = 0; at < this.#bones.length; at++) this.#skeleton.read(this.#bones[at]!, block, bones + LOCAL * at);
    return block;
  }

  #write(block: Float32Array): void {
    const { bones } = this.#at;
    for (let at = 0; at < this.#written.length; at++) {
      const bone = this.#written[at]!;
      this.#skeleton.write(this.#bones[bone]!, block, bones + LOCAL * bone);
    }
  }

  /** Makes the bones this gaze's, unless another one turns them: corrections of the one would be the animation of the other. */
  #own(): void {
    for (let at = 0; at < this.#written.length; at++) {
      const bone = this.#bones[this.#written[at]!]!;
      const key = this.#skeleton.key?.(bone);
      const owner = key && owners.get(key)?.deref();
      if (owner && (owner as unknown) !== this && owner.#character) {
        throw new GazeError(
          `the bone "${this.#skeleton.bones[bone]!.name}" is turned by another gaze: dispose of that one first, or give it the new target`,
        );
      }
      if (key) owners.set(key, new WeakRef(this as unknown as Gaze<never>));
    }
    this.#owns = true;
  }

  /** Tells, once, what goes wrong most often. */
  #suspect(dt: number): void {
    this.#longFrames = dt > 1 ? this.#longFrames + 1 : 0;
    if (this.#longFrames === 30) console.warn("aim-gaze: 30 frames of more than a second: `update` takes seconds, not milliseconds");
  }

  #tell(status: Status): void {
    const was = this.#status;
    this.#status = status;
    const turns = status !== "no_target" && this.bodyTurn !== 0;
    const turned = this.#turns;
    this.#turns = turns;
    if (was === "reached" && status !== "reached") this.#dispatch("lost");
    if (was !== "reached" && status === "reached") this.#dispatch("reached");
    if (isOutOfReach(status) && !isOutOfReach(was)) this.#dispatch("outofreach");
    if (turns && !turned) this.#dispatch("turnbody");
  }

  #dispatch(event: GazeEvent): void {
    // A listener may take itself off, or dispose of the gaze.
    for (const listener of [...this.#listeners[event]]) if (this.#character) listener(this);
  }

  #living(): RawCharacter {
    if (!this.#character) throw new GazeError("this gaze has been disposed of: attach the character again");
    return this.#character;
  }

  #numbers(): Float32Array {
    this.#living();
    // The old view is of length 0 where the memory has grown.
    if (this.#block.length === 0) this.#block = this.#view();
    return this.#block;
  }

  #view(): Float32Array {
    return new Float32Array(this.#engine.memory.buffer, this.#address, this.#length);
  }

  #broken(cause: unknown): GazeError {
    // What stopped half-way must not run again, and cannot be freed.
    this.#character = undefined;
    this.#skeleton.dispose?.();
    return new GazeError("the gaze has failed because of a mistake in aim-gaze; attach the character again, and please report it", { cause });
  }
}

type Six = readonly [number, number, number, number, number, number];

function isOutOfReach(status: Status): boolean {
  return status === "at_limit" || status === "behind";
}

/** Writes the coordinates of a point into `into`; where it is none, throws that a target is `expected`. */
export function writePoint(point: unknown, expected: string, into: Float32Array, offset: number): void {
  const { x, y, z } = (point ?? {}) as Partial<Point>;
  if (typeof x !== "number" || typeof y !== "number" || typeof z !== "number") {
    throw new GazeError(`a target is ${expected} in the world, not ${show(point)}`);
  }
  into[offset] = x;
  into[offset + 1] = y;
  into[offset + 2] = z;
}

/** Words for a list, in a message. */
export function quoted(words: readonly string[]): string {
  return words.map((word) => `"${word}"`).join(", ");
}

/** A value, in a message. */
export function show(value: unknown): string {
  if (typeof value === "string") return `"${value}"`;
  if (typeof value === "object" && value !== null) return `an object of class ${value.constructor?.name ?? "Object"}`;
  return String(value);
}
