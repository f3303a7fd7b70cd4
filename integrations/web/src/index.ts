/**
 * Characters that look at things, whatever engine they are in. Adapters for engines are `aim-gaze/three`, `aim-gaze/three-vrm`,
 * `aim-gaze/react` and `aim-gaze/babylon`.
 *
 * @module
 */
import { GazeError } from "./error.js";
import { Gaze, quoted, show, writePoint } from "./gaze.js";
import type { Behind, Locate, Point, WeightedTarget } from "./gaze.js";
import { load } from "./load.js";
import type { Part, RawBones, RawCharacter, Engine } from "./load.js";
import { LOCAL } from "./skeleton.js";
import type { Skeleton } from "./skeleton.js";

export { GazeError } from "./error.js";
export { Gaze } from "./gaze.js";
export type { Behind, GazeEvent, GazeJoint, Locate, Point, Status, WeightedTarget } from "./gaze.js";
export type { Bone, Skeleton } from "./skeleton.js";

/** The rigs that come with the package, by the tradition that names a skeleton's bones. */
export type Preset = "vrm" | "mixamo" | "rocketbox" | "rigify";

const PRESETS: readonly Preset[] = ["vrm", "mixamo", "rocketbox", "rigify"];

/**
 * Which bones turn, about which axes and how far.
 *
 * - A {@link Preset}: found by the names of bones.
 * - `"measure"`: measured from the skeleton: the names of its bones, how they stand, and its skin.
 * - `{ glb }`: measured from the bytes of the character's file, GLB or VRM, which tell more.
 * - `{ toml }`: declared in a file that `aim rig hero.glb` writes; `file` is what its mistakes are told for.
 */
export type Rig = Preset | "measure" | { readonly glb: Uint8Array | ArrayBuffer } | { readonly toml: string; readonly file?: string };

/** Options of `attach`. */
export interface AttachOptions<P = Point> {
  /** Which bones turn, and how. */
  readonly rig?: Rig;
  /** What the character looks at first. */
  readonly target?: P | null;
  /** Several targets, by weights, instead of one. */
  readonly targets?: readonly WeightedTarget<P>[];
  /** {@link Gaze.weight} to begin with. */
  readonly weight?: number;
  /** {@link Gaze.attention} to begin with. */
  readonly attention?: number;
  /** {@link Gaze.patience} to begin with. */
  readonly patience?: number;
  /** {@link Gaze.tolerance} to begin with. */
  readonly tolerance?: number;
  /** {@link Gaze.behind} to begin with. */
  readonly behind?: Behind;
  /** True (the default) if both eyes are aimed, each by itself; else the one turns as the other does. */
  readonly bothEyes?: boolean;
}

/** Options of the core's {@link attach}. */
export interface CoreOptions<P> extends AttachOptions<P> {
  /** Where a target is in the world; without it targets are {@link Point}s. */
  readonly locate?: Locate<P>;
  /** The index of the bone that tells how the character stands: its hips. Without it the character's up is +Y of its own space. */
  readonly trunk?: number;
}

/**
 * Makes the character of a skeleton look at things.
 *
 * @throws {@link GazeError} if the rig does not fit the skeleton, or a part of the package cannot be loaded
 */
export async function attach<P = Point>(skeleton: Skeleton, options: CoreOptions<P> = {}): Promise<Gaze<P>> {
  if (typeof options !== "object" || options === null) throw new GazeError(`the options of attach are an object, not ${show(options)}`);
  const isSkeleton = Array.isArray(skeleton?.bones) && [skeleton.read, skeleton.write, skeleton.place].every((way) => typeof way === "function");
  if (!isSkeleton) {
    throw new GazeError(
      `attach takes a skeleton { bones, read, write, place }, not ${show(skeleton)}; for characters of three.js, VRM or Babylon.js ` +
        `import it from "aim-gaze/three", "aim-gaze/three-vrm" or "aim-gaze/babylon"`,
    );
  }
  if (skeleton.bones.length === 0) throw new GazeError("the character has no bones: attach it when it is loaded");
  const unknown = Object.keys(options).find((name) => !(OPTIONS as readonly string[]).includes(name));
  if (unknown !== undefined) throw new GazeError(`attach has no option "${unknown}": there are ${OPTIONS.join(", ")}`);
  const { rig = "measure", target, targets, weight, attention, patience, tolerance, behind } = options;
  const [part, make] = way(rig, options.bothEyes ?? true);
  const engine = await load(part);
  const character = made(engine, skeleton, options.trunk, make);
  const gaze = new Gaze<P>(engine, character, skeleton, options.locate ?? (locatePoint as Locate<unknown> as Locate<P>));
  try {
    if ("target" in options) gaze.target = target as P | null;
    if (targets !== undefined) gaze.targets = targets;
    if (weight !== undefined) gaze.weight = weight;
    if (attention !== undefined) gaze.attention = attention;
    if (patience !== undefined) gaze.patience = patience;
    if (tolerance !== undefined) gaze.tolerance = tolerance;
    if (behind !== undefined) gaze.behind = behind;
  } catch (error) {
    character.free();
    throw error;
  }
  return gaze;
}

const OPTIONS = [
  "rig",
  "target",
  "targets",
  "weight",
  "attention",
  "patience",
  "tolerance",
  "behind",
  "bothEyes",
  "locate",
  "trunk",
] as const satisfies readonly (keyof CoreOptions<unknown>)[];

type Make = (engine: Engine, bones: RawBones) => RawCharacter;

/** The part of the package that a rig needs, and how to make a character of it. */
function way(rig: Rig, bothEyes: boolean): [Part, Make] {
  if (rig === "measure") return ["measure", ({ Character }, bones) => Character.measured(bones, bothEyes)];
  if (typeof rig === "string") {
    if (!PRESETS.includes(rig)) throw unknownRig(rig);
    return ["presets", ({ Character }, bones) => Character.preset(bones, rig, bothEyes)];
  }
  if (typeof rig === "object" && rig !== null) {
    if ("glb" in rig && (rig.glb instanceof Uint8Array || rig.glb instanceof ArrayBuffer)) {
      const bytes = rig.glb instanceof Uint8Array ? rig.glb : new Uint8Array(rig.glb);
      return ["measure", ({ Character }, bones) => Character.ofFile(bones, bytes, bothEyes)];
    }
    if ("toml" in rig && typeof rig.toml === "string") {
      const { toml, file = "rig.toml" } = rig;
      if (typeof file !== "string") throw new GazeError(`\`file\` is the name of the rig file, a text, not ${show(file)}`);
      return ["declare", ({ Character }, bones) => Character.declared(bones, file, toml, bothEyes)];
    }
  }
  throw unknownRig(rig);
}

function unknownRig(rig: unknown): GazeError {
  return new GazeError(`\`rig\` is one of ${quoted(PRESETS)}, "measure", { glb: the file's bytes } or { toml: the rig file's text }, not ${show(rig)}`);
}

const REST = new Float32Array(LOCAL);

function made(engine: Engine, skeleton: Skeleton, trunk: number | undefined, make: Make): RawCharacter {
  const bones = new engine.Bones();
  try {
    skeleton.bones.forEach((bone, index) => {
      const { name, parent, rest, inverseBind, node } = bone ?? {};
      if (typeof name !== "string" || !Number.isInteger(parent)) {
        throw new GazeError(`bone ${index} of the skeleton has to be { name, parent }, a text and the index of a bone or -1, not ${show(bone)}`);
      }
      if (rest) REST.set(numbers(rest, LOCAL, "rest", name));
      else skeleton.read(index, REST, 0);
      bones.add(name, parent, REST);
      if (inverseBind) bones.bind(Float32Array.from(numbers(inverseBind, 16, "inverseBind", name)));
      if (node !== undefined) bones.node(node);
    });
    if (trunk !== undefined && trunk >= 0) bones.trunk(trunk);
    return make(engine, bones);
  } catch (error) {
    throw failed(error);
  } finally {
    free(bones);
  }
}

/** Lets go of bones, unless a mistake still holds them. */
function free(bones: RawBones): void {
  try {
    bones.free();
  } catch {
    // What failed is told already.
  }
}

/** What is told of an error: the solvers' own say what to do, and come as plain errors. */
function failed(error: unknown): GazeError {
  if (error instanceof GazeError) return error;
  if (error instanceof Error && error.constructor === Error) return new GazeError(error.message);
  return new GazeError("the character could not be attached because of a mistake in aim-gaze, or in the skeleton's `read`; please report it", {
    cause: error,
  });
}

function numbers(given: ArrayLike<number>, count: number, what: string, bone: string): ArrayLike<number> {
  if (given.length !== count) throw new GazeError(`\`${what}\` of the bone "${bone}" takes ${count} numbers, not ${show(given.length)}`);
  return given;
}

function locatePoint(target: Point, into: Float32Array, offset: number): void {
  writePoint(target, "a point { x, y, z }", into, offset);
}
