/**
 * Gaze for avatars of `@pixiv/three-vrm`: on the normalised humanoid bones, with the eyes as the file's `lookAt` has them, as bones or
 * as expressions.
 *
 * Each frame in this order: `mixer.update(dt); gaze.update(dt); vrm.update(dt);`
 *
 * @module
 */
import type { VRMCore } from "@pixiv/three-vrm";
import type { Object3D } from "three";

import { attach as attachSkeleton, GazeError } from "./index.js";
import type { AttachOptions, Bone, Gaze, Skeleton } from "./index.js";
import { show } from "./gaze.js";
import { locate } from "./three.js";
import type { Target } from "./three.js";
import { ExpressedEye, LOOKS, MappedEye } from "./vrm-eyes.js";
import type { Eye, RangeMaps } from "./vrm-eyes.js";

export type { Target } from "./three.js";

/**
 * Makes a VRM avatar, version 0 or 1, look at targets.
 *
 * The rig is `"vrm"` unless `options.rig` says otherwise. An avatar whose eyes neither bones nor expressions can turn looks with its
 * head: its rig is measured, which loads the larger module.
 *
 * While attached, `vrm.lookAt` neither follows its own target nor moves the eyes; yaw and pitch that are set on it, by an animation
 * for example, count as the animation of the eyes. `dispose` gives it back as it was.
 */
export async function attach(vrm: VRMCore, options: AttachOptions<Target> = {}): Promise<Gaze<Target>> {
  const avatar = check(vrm);
  const eyes = eyesOf(avatar);
  let { rig = "vrm" } = options;
  if (typeof rig === "object" && "glb" in rig) {
    throw new GazeError(
      "a rig that is measured from a file fits the file's own bones, not the normalised bones of a VRM: leave `rig` out, or attach " +
        "`vrm.scene` with aim-gaze/three and set `vrm.humanoid.autoUpdateHumanBones = false`",
    );
  }
  // The preset needs an eye, and there is none to turn: measured, the rig ends at the head.
  if (rig === "vrm" && eyes === "none") rig = "measure";
  const skeleton = new VrmSkeleton(avatar, eyes, rig === "vrm");
  const gaze = await attachSkeleton<Target>(skeleton, { ...options, rig, locate, trunk: skeleton.trunk });
  skeleton.takeOver();
  return gaze;
}

function check(vrm: unknown): VRMCore {
  const { humanoid, scene, userData } = (vrm ?? {}) as Partial<VRMCore> & { userData?: { vrm?: unknown } };
  if (typeof humanoid?.getNormalizedBoneNode !== "function" || !scene) {
    const hint = userData?.vrm ? "this is the glTF around it" : "load the file with GLTFLoader and VRMLoaderPlugin";
    throw new GazeError(`attach takes a VRM of @pixiv/three-vrm, \`gltf.userData.vrm\`, not ${show(vrm)}: ${hint}`);
  }
  if (!humanoid.autoUpdateHumanBones) {
    throw new GazeError(
      "`vrm.humanoid.autoUpdateHumanBones` is off, so that the normalised bones move nothing: switch it on, or attach `vrm.scene` with " +
        "aim-gaze/three",
    );
  }
  return vrm as VRMCore;
}

type VRMLookAt = NonNullable<VRMCore["lookAt"]>;
type VRMLookAtApplier = VRMLookAt["applier"];
type HumanBone = Parameters<VRMCore["humanoid"]["getNormalizedBoneNode"]>[0];

/** What turns the eyes. */
type EyeKind = "bones" | "expressions" | "none";

function eyesOf({ humanoid, lookAt, expressionManager }: VRMCore): EyeKind {
  const looks = LOOKS.some((name) => expressionManager?.getExpression(name));
  if (looks && lookAt && isOfExpressions(lookAt.applier)) return "expressions";
  return humanoid.getNormalizedBoneNode("leftEye") || humanoid.getNormalizedBoneNode("rightEye") ? "bones" : "none";
}

function isOfExpressions(applier: VRMLookAtApplier): boolean {
  return (applier.constructor as { type?: string }).type === "expression" || "expressions" in applier;
}

class VrmSkeleton implements Skeleton {
  readonly bones: readonly Bone[];
  /** The hips. */
  readonly trunk: number;
  /** For each bone its node; none for an eye that only expressions turn. */
  readonly #nodes: (Object3D | undefined)[] = [];
  readonly #eyes: (Eye | undefined)[] = [];
  /** What the hips hang on. */
  readonly #root: Object3D;
  readonly #lookAt: LookAt | undefined;
  /** −1 for VRM 0, whose characters face −Z: they are presented turned by half a turn about Y, which negates x and z; else 1. */
  readonly #sign: number;

  constructor(vrm: VRMCore, eyes: EyeKind, preset: boolean) {
    const { humanoid, lookAt, scene } = vrm;
    const root = humanoid.normalizedHumanBonesRoot;
    this.#root = root.parent ? root : scene;
    this.#sign = vrm.meta?.metaVersion === "0" ? -1 : 1;
    const named = new Map<Object3D, HumanBone>();
    for (const name of Object.keys(humanoid.normalizedHumanBones) as HumanBone[]) {
      const node = humanoid.getNormalizedBoneNode(name);
      if (node) named.set(node, name);
    }
    const aliases = preset ? aliasesOf(named) : new Map<HumanBone, string>();
    const maps = () => lookAt?.applier && (original(lookAt) as RangeMaps);
    const bones: Bone[] = [];
    const add = (node: Object3D, parent: number): void => {
      const name = named.get(node);
      let here = parent;
      if (name && !(eyes === "expressions" && isEye(name))) {
        const rest = restOf(vrm, name, node);
        here = bones.push({ name: aliases.get(name) ?? String(name), parent, rest: turned(rest, this.#sign) }) - 1;
        this.#nodes[here] = node;
        if (eyes === "bones" && isEye(name) && lookAt && !isOfExpressions(lookAt.applier)) {
          this.#eyes[here] = new MappedEye(node.quaternion, name === "leftEye", this.#sign, maps);
        }
        if (name === "head" && eyes === "expressions" && lookAt && vrm.expressionManager) {
          const virtual = turned(lookAtOrigin(vrm, lookAt), this.#sign);
          const eye = bones.push({ name: "leftEye", parent: here, rest: virtual }) - 1;
          this.#eyes[eye] = new ExpressedEye(vrm.expressionManager, virtual, maps);
        }
      }
      for (const child of node.children) add(child, here);
    };
    add(root, -1);
    this.bones = bones;
    this.trunk = bones.findIndex(({ name }) => name === "hips");
    this.#lookAt = lookAt && new LookAt(lookAt);
  }

  /** Quiets the avatar's own look-at. */
  takeOver(): void {
    this.#lookAt?.take();
  }

  begin(): void {
    this.#lookAt?.apply();
  }

  read(bone: number, into: Float32Array, offset: number): void {
    const sign = this.#sign;
    const node = this.#nodes[bone];
    if (node) {
      const { position, quaternion, scale } = node;
      into[offset] = sign * position.x;
      into[offset + 1] = position.y;
      into[offset + 2] = sign * position.z;
      into[offset + 3] = sign * quaternion.x;
      into[offset + 4] = quaternion.y;
      into[offset + 5] = sign * quaternion.z;
      into[offset + 6] = quaternion.w;
      into[offset + 7] = scale.x;
      into[offset + 8] = scale.y;
      into[offset + 9] = scale.z;
    }
    this.#eyes[bone]?.read(into, offset);
  }

  write(bone: number, from: Float32Array, offset: number): void {
    const sign = this.#sign;
    const node = this.#nodes[bone];
    const eye = this.#eyes[bone];
    if (node) {
      const { position, quaternion } = node;
      const x = sign * from[offset]!;
      const y = from[offset + 1]!;
      const z = sign * from[offset + 2]!;
      // What does not move keeps its double precision.
      if (Math.fround(position.x) !== x || Math.fround(position.y) !== y || Math.fround(position.z) !== z) position.set(x, y, z);
      if (!eye) quaternion.set(sign * from[offset + 3]!, from[offset + 4]!, sign * from[offset + 5]!, from[offset + 6]!);
    }
    eye?.write(from, offset);
  }

  key(bone: number): object | undefined {
    return this.#nodes[bone];
  }

  place(into: Float32Array, offset: number): void {
    const root = this.#root;
    root.updateWorldMatrix(true, false);
    const { elements } = root.matrixWorld;
    for (let at = 0; at < 16; at++) into[offset + at] = elements[at]!;
    if (this.#sign > 0) return;
    for (let at = 0; at < 3; at++) {
      into[offset + at] = -into[offset + at]!;
      into[offset + 8 + at] = -into[offset + 8 + at]!;
    }
  }

  dispose(): void {
    this.#lookAt?.release();
  }
}

function isEye(name: HumanBone): boolean {
  return name === "leftEye" || name === "rightEye";
}

/** The names that stand in for those of bones that the preset needs and a VRM may lack. */
function aliasesOf(named: ReadonlyMap<Object3D, HumanBone>): Map<HumanBone, string> {
  const present = new Set(named.values());
  const aliases = new Map<HumanBone, string>();
  // Each is there, or the next one takes its part: required of a VRM are only hips, spine and head.
  if (!present.has("neck")) aliases.set("head", "neck");
  if (!present.has("upperChest") && !present.has("chest")) aliases.set("spine", "chest");
  if (!present.has("leftEye")) aliases.set("rightEye", "leftEye");
  return aliases;
}

/** The ten numbers of a normalised bone at rest. */
function restOf({ humanoid }: VRMCore, name: HumanBone, { position }: Object3D): number[] {
  const rest = humanoid.normalizedRestPose[name];
  return [...(rest?.position ?? position.toArray()), ...(rest?.rotation ?? [0, 0, 0, 1]), 1, 1, 1];
}

/** The ten numbers of a bone after half a turn of the space about Y for −1. */
function turned([x = 0, y = 0, z = 0, i = 0, j = 0, k = 0, w = 1, ...scale]: number[], sign: number): number[] {
  return [sign * x, y, sign * z, sign * i, j, sign * k, w, ...scale];
}

/** What three-vrm tells of a bone at rest. */
interface Rest {
  readonly rotation?: readonly number[];
}

/** Where `lookAt` looks from, as a bone on the normalised head at rest. */
function lookAtOrigin({ humanoid, scene }: VRMCore, { offsetFromHeadBone }: VRMLookAt): number[] {
  const rests = new Map<Object3D, readonly number[]>();
  for (const [name, rest] of Object.entries<Rest>(humanoid.rawRestPose as Record<string, Rest>)) {
    const node = humanoid.getRawBoneNode(name as HumanBone);
    if (node && rest.rotation) rests.set(node, rest.rotation);
  }
  // The offset is in the space of the raw head, the bone in that of the normalised one, which has the axes of the scene.
  const offset = offsetFromHeadBone.clone();
  for (let node = humanoid.getRawBoneNode("head"); node && node !== scene; node = node.parent) {
    const rest = rests.get(node);
    offset.multiply(node.scale).applyQuaternion(rest ? node.quaternion.clone().fromArray([...rest]) : node.quaternion);
  }
  return [offset.x, offset.y, offset.z, 0, 0, 0, 1, 1, 1, 1];
}

interface Lookers {
  /** Characters that hold it. */
  count: number;
  readonly autoUpdate: boolean;
  readonly applier: VRMLookAtApplier;
}

/** Look-ats that are held. */
const held = new WeakMap<VRMLookAt, Lookers>();

/** What moves the eyes while nobody holds the look-at. */
function original(lookAt: VRMLookAt): VRMLookAtApplier {
  return held.get(lookAt)?.applier ?? lookAt.applier;
}

/** The avatar's own look-at while a gaze has the eyes. */
class LookAt {
  readonly #lookAt: VRMLookAt;
  #yaw: number;
  #pitch: number;
  #holds = false;

  constructor(lookAt: VRMLookAt) {
    this.#lookAt = lookAt;
    this.#yaw = lookAt.yaw;
    this.#pitch = lookAt.pitch;
  }

  take(): void {
    const lookAt = this.#lookAt;
    const { autoUpdate, applier } = lookAt;
    this.#holds = true;
    const holders = held.get(lookAt);
    if (holders) {
      holders.count += 1;
      this.#yaw = lookAt.yaw;
      this.#pitch = lookAt.pitch;
      return;
    }
    held.set(lookAt, { count: 1, autoUpdate, applier });
    lookAt.autoUpdate = false;
    // Where it has looked at its own target that is no animation.
    if (autoUpdate && lookAt.target) {
      lookAt.reset();
      applier.applyYawPitch(0, 0);
    }
    this.#yaw = lookAt.yaw;
    this.#pitch = lookAt.pitch;
    // `vrm.update` applies yaw and pitch after the bones have been written, the first time even unasked: this one moves nothing, and
    // is otherwise the same.
    const nothing = { value: () => {}, configurable: true, writable: true };
    lookAt.applier = Object.create(applier, { applyYawPitch: nothing, lookAt: nothing }) as VRMLookAtApplier;
  }

  /** Moves the eyes where yaw or pitch were set from elsewhere: that is their animation. */
  apply(): void {
    const { yaw, pitch } = this.#lookAt;
    if (!this.#holds || (yaw === this.#yaw && pitch === this.#pitch)) return;
    this.#yaw = yaw;
    this.#pitch = pitch;
    original(this.#lookAt).applyYawPitch(yaw, pitch);
  }

  release(): void {
    const lookAt = this.#lookAt;
    const holders = held.get(lookAt);
    if (!holders || !this.#holds) return;
    this.#holds = false;
    holders.count -= 1;
    if (holders.count > 0) return;
    held.delete(lookAt);
    lookAt.autoUpdate = holders.autoUpdate;
    lookAt.applier = holders.applier;
  }
}
