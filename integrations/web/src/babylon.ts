/**
 * Gaze for characters of Babylon.js that were loaded from glTF, in left-handed and in right-handed scenes.
 *
 * Each frame after the animation and before rendering: `scene.onAfterAnimationsObservable.add(() => gaze.update(dt))`.
 *
 * @module
 */
import type { Camera } from "@babylonjs/core/Cameras/camera.js";
import type { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import type { TransformNode } from "@babylonjs/core/Meshes/transformNode.js";
import type { Node } from "@babylonjs/core/node.js";

import { attach as attachSkeleton, GazeError } from "./index.js";
import type { AttachOptions, Bone, Gaze, Skeleton } from "./index.js";
import { show, writePoint } from "./gaze.js";
import { LOCAL } from "./skeleton.js";

/** What a character of Babylon.js looks at: a node (a mesh, a camera, …), or a point in the world that may move. */
export type Target = TransformNode | Camera | Vector3;

/** A bone of a Babylon.js skeleton, as far as it is needed. */
interface SkinBone {
  getTransformNode(): TransformNode | null;
  getAbsoluteInverseBindMatrix(): { readonly m: ArrayLike<number> };
  getIndex(): number;
}

interface Skin {
  readonly bones: readonly SkinBone[];
}

/** What holds a character: `AssetContainer`, the result of `ImportMeshAsync`, or that of `instantiateModelsToScene`. */
export interface Loaded {
  readonly meshes?: readonly Node[];
  readonly transformNodes?: readonly Node[];
  readonly rootNodes?: readonly Node[];
  readonly skeletons?: readonly Skin[];
}

/** What can be attached: the root node of a character, or what holds one. */
export type Source = TransformNode | Loaded;

/**
 * Makes a character look at targets.
 *
 * Its bones are the transform nodes below the file's `__root__`. They count as at rest as they are when this is called, so call it
 * right after loading. The rig is measured unless `options.rig` says otherwise.
 */
export async function attach(source: Source, options: AttachOptions<Target> = {}): Promise<Gaze<Target>> {
  const root = rootOf(source);
  const skeleton = new NodeSkeleton(root, skinsOf(source, root));
  return await attachSkeleton<Target>(skeleton, { ...options, rig: options.rig ?? "measure", locate });
}

/** Writes where a target is in the world, in this frame. */
function locate(target: Target, into: Float32Array, offset: number): void {
  if (isNode(target)) {
    const { m } = target.computeWorldMatrix(true);
    into[offset] = m[12]!;
    into[offset + 1] = m[13]!;
    into[offset + 2] = m[14]!;
    return;
  }
  writePoint(target, "a TransformNode, a mesh, a camera, or a Vector3", into, offset);
}

function isNode(thing: unknown): thing is TransformNode | Camera {
  return typeof (thing as Partial<Node> | null)?.computeWorldMatrix === "function";
}

function isTransformNode(thing: unknown): thing is TransformNode {
  const { position, scaling } = (thing ?? {}) as Partial<TransformNode>;
  return isNode(thing) && position !== undefined && scaling !== undefined;
}

/** What the glTF loader calls the node that it makes above a file's. */
const ROOT = "__root__";

function isRoot(node: Node): boolean {
  return node.name.endsWith(ROOT);
}

/** The node whose space is that of the character's file. */
function rootOf(source: unknown): TransformNode {
  const expected =
    "attach takes the root node of a character, or what loading it gave (an AssetContainer, or the result of ImportMeshAsync or " +
    "instantiateModelsToScene)";
  if (isTransformNode(source)) {
    const [root, other] = isRoot(source) ? [source] : source.getDescendants(false, isRoot);
    if (other) throw new GazeError(`there is more than one character below "${source.name}": give the root node of one`);
    return isTransformNode(root) ? root : source;
  }
  if (typeof source !== "object" || source === null) throw new GazeError(`${expected}, not ${show(source)}`);
  const { meshes = [], transformNodes = [], rootNodes = [] } = source as Loaded;
  const all = [...rootNodes, ...meshes, ...transformNodes];
  const nodes = all.filter((node, at): node is TransformNode => isTransformNode(node) && all.indexOf(node) === at);
  const tops = nodes.filter(({ parent }) => !parent || !nodes.includes(parent as TransformNode));
  const roots = nodes.filter(isRoot);
  const [root, other] = roots.length > 0 ? roots : tops;
  if (!root) throw new GazeError(`${expected}; ${show(source)} holds no nodes: attach it when it is loaded`);
  if (other) {
    throw new GazeError(`attach takes one character, and there are "${root.name}" and "${other.name}": give the root node of one`);
  }
  return root;
}

/** The skins of a character: those at hand, and those of its meshes. */
function skinsOf(source: Source, root: TransformNode): Set<Skin> {
  const skins = new Set<Skin>((source as Loaded).skeletons);
  for (const mesh of root.getChildMeshes(false)) if (mesh.skeleton) skins.add(mesh.skeleton as Skin);
  return skins;
}

class NodeSkeleton implements Skeleton {
  readonly bones: readonly Bone[];
  readonly #nodes: readonly TransformNode[];
  readonly #root: TransformNode;
  /** Whether the root is a bone itself. */
  readonly #isBone: boolean;

  constructor(root: TransformNode, skins: Iterable<Skin>) {
    this.#root = root;
    const inverseBinds = new Map<TransformNode, ArrayLike<number>>();
    let unlinked = 0;
    for (const { bones } of skins) {
      for (const bone of bones) {
        const node = bone.getTransformNode();
        if (!node) unlinked += 1;
        // Bones that only connect joints have no place in the skin: their matrices tell nothing.
        else if (bone.getIndex() !== -1) inverseBinds.set(node, Float32Array.from(bone.getAbsoluteInverseBindMatrix().m));
      }
    }
    if (unlinked > 0 && inverseBinds.size === 0) {
      throw new GazeError(
        "the skeleton's bones are not linked to transform nodes, as those of a .babylon file: load the character from glTF or GLB",
      );
    }
    const nodes: TransformNode[] = [];
    const bones: Bone[] = [];
    // A clone's names have what its root's has in front: "Clone of __root__".
    const prefix = isRoot(root) ? root.name.slice(0, -ROOT.length) : "";
    const add = (node: Node, parent: number): void => {
      let here = parent;
      if (isTransformNode(node)) {
        here = nodes.push(node) - 1;
        const rest = new Float32Array(LOCAL);
        readNode(node, rest, 0);
        const index = indexOf(node);
        const inverseBind = inverseBinds.get(node);
        bones.push({
          name: node.name.startsWith(prefix) ? node.name.slice(prefix.length) : node.name,
          parent,
          rest,
          ...(inverseBind && { inverseBind }),
          ...(index !== undefined && { node: index }),
        });
      }
      for (const child of node.getChildren()) add(child, here);
    };
    // A root that moves a skin by itself is a bone like the others; else the character's root is what its bones hang on.
    this.#isBone = inverseBinds.has(root);
    if (this.#isBone) add(root, -1);
    else for (const child of root.getChildren()) add(child, -1);
    if (nodes.length === 0) throw new GazeError(`there is nothing below "${root.name}": give the root node of a character`);
    this.#nodes = nodes;
    this.bones = bones;
  }

  read(bone: number, into: Float32Array, offset: number): void {
    readNode(this.#nodes[bone]!, into, offset);
  }

  write(bone: number, from: Float32Array, offset: number): void {
    const node = this.#nodes[bone]!;
    const { position } = node;
    const x = from[offset]!;
    const y = from[offset + 1]!;
    const z = from[offset + 2]!;
    // What does not move keeps its double precision.
    if (Math.fround(position.x) !== x || Math.fround(position.y) !== y || Math.fround(position.z) !== z) position.copyFromFloats(x, y, z);
    // Once: nodes of a glTF have a quaternion already.
    const quaternion = (node.rotationQuaternion ??= node.rotation.toQuaternion());
    quaternion.copyFromFloats(from[offset + 3]!, from[offset + 4]!, from[offset + 5]!, from[offset + 6]!);
  }

  key(bone: number): object | undefined {
    return this.#nodes[bone];
  }

  place(into: Float32Array, offset: number): void {
    const above = this.#isBone ? this.#root.parent : this.#root;
    const m = above?.computeWorldMatrix(true).m;
    // Row vectors in rows: in memory the same as columns of a column-major matrix.
    for (let at = 0; at < 16; at++) into[offset + at] = m ? m[at]! : at % 5 === 0 ? 1 : 0;
  }
}

function readNode({ position, rotation, rotationQuaternion, scaling }: TransformNode, into: Float32Array, offset: number): void {
  into[offset] = position.x;
  into[offset + 1] = position.y;
  into[offset + 2] = position.z;
  if (rotationQuaternion) {
    into[offset + 3] = rotationQuaternion.x;
    into[offset + 4] = rotationQuaternion.y;
    into[offset + 5] = rotationQuaternion.z;
    into[offset + 6] = rotationQuaternion.w;
  } else {
    // About y, then x, then z, as Babylon.js composes Euler angles.
    const a = Math.sin(rotation.x / 2);
    const b = Math.cos(rotation.x / 2);
    const c = Math.sin(rotation.y / 2);
    const d = Math.cos(rotation.y / 2);
    const e = Math.sin(rotation.z / 2);
    const f = Math.cos(rotation.z / 2);
    into[offset + 3] = d * a * f + c * b * e;
    into[offset + 4] = c * b * f - d * a * e;
    into[offset + 5] = d * b * e - c * a * f;
    into[offset + 6] = d * b * f + c * a * e;
  }
  into[offset + 7] = scaling.x;
  into[offset + 8] = scaling.y;
  into[offset + 9] = scaling.z;
}

/** The number of a node in its glTF file, where the loader has left it. */
function indexOf(node: TransformNode): number | undefined {
  const { _internalMetadata } = node as unknown as { _internalMetadata?: { gltf?: { pointers?: readonly string[] } } };
  for (const pointer of _internalMetadata?.gltf?.pointers ?? []) {
    const [, index] = /^\/nodes\/(\d+)$/.exec(pointer) ?? [];
    if (index !== undefined) return Number(index);
  }
  return undefined;
}
