/**
 * Gaze for characters of three.js.
 *
 * Each frame in this order: `mixer.update(dt); gaze.update(dt); renderer.render(scene, camera);`
 *
 * @module
 */
import type { Object3D, SkinnedMesh, Vector3 } from "three";

import { attach as attachSkeleton, GazeError } from "./index.js";
import type { AttachOptions, Bone, Gaze, Skeleton } from "./index.js";
import { show, writePoint } from "./gaze.js";

/** What a character of three.js looks at: an object, or a point in the world that may move. */
export type Target = Object3D | Vector3;

/** What `GLTFLoader` loads. */
export interface Loaded {
  readonly scene: Object3D;
  readonly parser?: { readonly associations: Map<unknown, { readonly nodes?: number }> };
}

/**
 * Makes a character look at targets: what `GLTFLoader` has loaded, or an object with bones below it, whatever it was loaded from.
 *
 * The rig is measured unless `options.rig` names another. Attach the character when it is loaded, before it is animated: how it
 * stands then is its rest pose.
 */
export async function attach(source: Loaded | Object3D, options: AttachOptions<Target> = {}): Promise<Gaze<Target>> {
  const { root, parser } = rootOf(source);
  return attachSkeleton<Target>(new ObjectSkeleton(root, parser), { ...options, locate });
}

interface MaybeVrm {
  readonly humanoid?: unknown;
  readonly userData?: { readonly vrm?: { readonly humanoid?: { readonly autoUpdateHumanBones?: boolean } } };
}

function rootOf(source: unknown): { root: Object3D; parser?: Loaded["parser"] } {
  const { scene, parser, humanoid, userData } = (source ?? {}) as Partial<Loaded> & MaybeVrm;
  if (humanoid) throw new GazeError('this is a VRM: import attach from "aim-gaze/three-vrm"');
  if (userData?.vrm?.humanoid?.autoUpdateHumanBones) {
    throw new GazeError('this is the glTF of a VRM, whose `vrm.update` sets these bones: give `gltf.userData.vrm` to attach of "aim-gaze/three-vrm"');
  }
  if (isObject3D(source)) return { root: source };
  if (isObject3D(scene)) return { root: scene, parser };
  throw new GazeError(`attach takes what GLTFLoader has loaded, or an Object3D with bones below it, not ${show(source)}`);
}

/** True of objects of three.js, whichever copy of it they come from. */
export function isObject3D(value: unknown): value is Object3D {
  return (value as Partial<Object3D> | null | undefined)?.isObject3D === true;
}

/** Where a target is in the world, in this frame. */
export function locate(target: Target, into: Float32Array, offset: number): void {
  if (isObject3D(target)) {
    target.updateWorldMatrix(true, false);
    const { elements } = target.matrixWorld;
    into[offset] = elements[12]!;
    into[offset + 1] = elements[13]!;
    into[offset + 2] = elements[14]!;
    return;
  }
  writePoint(target, "an Object3D or a Vector3", into, offset);
}

class ObjectSkeleton implements Skeleton {
  readonly bones: readonly Bone[];
  readonly #root: Object3D;
  readonly #nodes: Object3D[] = [];

  constructor(root: Object3D, parser: Loaded["parser"]) {
    this.#root = root;
    const inverseBinds = inverseBindsOf(root);
    const bones: Bone[] = [];
    const add = (node: Object3D, parent: number): void => {
      const index = this.#nodes.push(node) - 1;
      const inverseBind = inverseBinds.get(node);
      const number = parser?.associations.get(node)?.nodes;
      bones.push({
        name: nameOf(node),
        parent,
        ...(inverseBind && { inverseBind }),
        ...(number !== undefined && { node: number }),
      });
      for (const child of node.children) add(child, index);
    };
    for (const child of root.children) add(child, -1);
    this.bones = bones;
  }

  read(bone: number, into: Float32Array, offset: number): void {
    const { position, quaternion, scale } = this.#nodes[bone]!;
    into[offset] = position.x;
    into[offset + 1] = position.y;
    into[offset + 2] = position.z;
    into[offset + 3] = quaternion.x;
    into[offset + 4] = quaternion.y;
    into[offset + 5] = quaternion.z;
    into[offset + 6] = quaternion.w;
    into[offset + 7] = scale.x;
    into[offset + 8] = scale.y;
    into[offset + 9] = scale.z;
  }

  write(bone: number, from: Float32Array, offset: number): void {
    const node = this.#nodes[bone]!;
    const { position, quaternion } = node;
    const x = from[offset]!;
    const y = from[offset + 1]!;
    const z = from[offset + 2]!;
    // What does not move keeps its double precision.
    if (Math.fround(position.x) !== x || Math.fround(position.y) !== y || Math.fround(position.z) !== z) position.set(x, y, z);
    quaternion.set(from[offset + 3]!, from[offset + 4]!, from[offset + 5]!, from[offset + 6]!);
    if (!node.matrixAutoUpdate) node.updateMatrix();
  }

  key(bone: number): object {
    return this.#nodes[bone]!;
  }

  place(into: Float32Array, offset: number): void {
    this.#root.updateWorldMatrix(true, false);
    const { elements } = this.#root.matrixWorld;
    for (let at = 0; at < 16; at++) into[offset + at] = elements[at]!;
  }
}

/** The name in the file, which loaders of glTF and FBX keep where they have had to change it. */
function nameOf({ name, userData }: Object3D): string {
  const kept: unknown = userData["name"] ?? userData["originalName"];
  return typeof kept === "string" ? kept : name;
}

/** For the bones of skins what leads from the space in which their mesh was bound to their own. */
function inverseBindsOf(root: Object3D): Map<Object3D, number[]> {
  const found = new Map<Object3D, number[]>();
  root.traverse((object) => {
    const { isSkinnedMesh, skeleton, bindMatrix } = object as Partial<SkinnedMesh>;
    if (!isSkinnedMesh || !skeleton || !bindMatrix) return;
    skeleton.bones.forEach((bone, index) => {
      const inverse = skeleton.boneInverses[index];
      if (inverse && !found.has(bone)) found.set(bone, inverse.clone().multiply(bindMatrix).toArray());
    });
  });
  return found;
}
