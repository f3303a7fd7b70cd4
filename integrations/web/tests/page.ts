/**
 * What runs in the browser: loads a character, lets it look at a target that swings to and fro in front of it, and judges by
 * three's own world matrices. `browser.mjs` says which characters, and what is right.
 */
import type { Gaze } from "aim-gaze";
import { attach as attachThree, type Target } from "aim-gaze/three";
import { attach as attachVrm } from "aim-gaze/three-vrm";
import { VRMLoaderPlugin, type VRM, type VRMHumanBoneName } from "@pixiv/three-vrm";
import * as THREE from "three";
import { GLTFLoader, type GLTF } from "three/addons/loaders/GLTFLoader.js";
import { inSpaceOf, Judge, offDeg, origin, quantile, type Landmarks, type Looks, type Vec3 } from "./judge";

export interface Character {
  readonly url: string;
  readonly kind: "glb" | "vrm";
  /** "bytes" stands for `{ glb }` with the file's own. */
  readonly rig?: "vrm" | "measure" | "bytes" | { readonly toml: string };
  readonly clip: string;
  /** Names of nodes in the file. */
  readonly eye: string;
  readonly head: string;
  readonly chest: string;
  /** Where the character faces in the file's rest pose; or where the eye looks, in the eye's own space. */
  readonly front?: Vec3;
  readonly forward?: Vec3;
  /** How far the target swings to either side, degrees, and how long it takes, seconds. */
  readonly swing: readonly [degrees: number, seconds: number];
  readonly picture?: boolean;
}

export interface Found {
  median: number;
  p90: number;
  worst: number;
  /** Frames with each status. */
  statuses: Record<string, number>;
  /** Smallest and largest, degrees. */
  joints: Record<string, { heading: [number, number]; pitch: [number, number] }>;
  looks: Looks;
  /** How far the eye turns in the world by the gaze at most, degrees: a character that does nothing is not judged right by luck. */
  turned: number;
  microseconds: number;
  pictures?: { before: string; after: string; changed: number; colours: number };
}

const FRAMES = 240;
const DT = 1 / 60;
const DEG = 180 / Math.PI;

/** A character that plays its clip, with or without a gaze. */
interface Actor {
  readonly scene: THREE.Object3D;
  readonly gltf: GLTF;
  readonly vrm: VRM | undefined;
  readonly mixer: THREE.AnimationMixer;
  readonly nodes: Readonly<Record<keyof Landmarks, THREE.Object3D>>;
}

async function load(character: Character, bytes: ArrayBuffer): Promise<Actor> {
  const loader = new GLTFLoader();
  if (character.kind === "vrm") loader.register((parser) => new VRMLoaderPlugin(parser));
  const gltf = await loader.parseAsync(bytes, "");
  const vrm = gltf.userData["vrm"] as VRM | undefined;
  if (character.kind === "vrm" && !vrm) throw new Error(`${character.url} is no VRM`);
  // Loaders change names: the file's own are asked for by index.
  const byName = async (name: string): Promise<THREE.Object3D> => {
    const nodes = (gltf.parser.json as { nodes: { name?: string }[] }).nodes;
    const index = nodes.findIndex((node) => node.name === name);
    if (index < 0) throw new Error(`${character.url} has no node ${name}`);
    return (await gltf.parser.getDependency("node", index)) as THREE.Object3D;
  };
  const clip = gltf.animations.find(({ name }) => name === character.clip);
  if (!clip) throw new Error(`${character.url} has no clip ${character.clip}`);
  gltf.scene.updateMatrixWorld(true);
  const mixer = new THREE.AnimationMixer(gltf.scene);
  const played = vrm ? overNormalisedBones(clip, vrm) : clip;
  if (played.tracks.length < 5) throw new Error(`${character.clip} turns next to nothing`);
  mixer.clipAction(played).play();
  const [eye, head, chest] = await Promise.all([character.eye, character.head, character.chest].map(byName));
  if (!eye || !head || !chest) throw new Error("no landmarks");
  // Characters seldom stand at the origin.
  const scene = new THREE.Group();
  scene.position.set(0.3, 0.1, -0.2);
  scene.rotation.y = 0.7;
  scene.add(gltf.scene);
  scene.updateMatrixWorld(true);
  return { scene, gltf, vrm, mixer, nodes: { eye, head, chest } };
}

/**
 * A clip of a VRM's own nodes as one of its normalised bones, which have no rotation at rest: three-vrm overwrites the
 * nodes with these.
 */
function overNormalisedBones(clip: THREE.AnimationClip, vrm: VRM): THREE.AnimationClip {
  const tracks: THREE.KeyframeTrack[] = [];
  for (const bone of Object.keys(vrm.humanoid.humanBones) as VRMHumanBoneName[]) {
    const [raw, normalised] = [vrm.humanoid.getRawBoneNode(bone), vrm.humanoid.getNormalizedBoneNode(bone)];
    const track = clip.tracks.find(({ name }) => name === `${raw?.name ?? ""}.quaternion`);
    if (!raw?.parent || !normalised || !track) continue;
    const parent = raw.parent.getWorldQuaternion(new THREE.Quaternion());
    const [invParent, invRest] = [parent.clone().invert(), raw.quaternion.clone().invert()];
    const values = Float32Array.from(track.values);
    for (let at = 0; at < values.length; at += 4) {
      const q = new THREE.Quaternion().fromArray(track.values, at);
      q.premultiply(parent).multiply(invRest).multiply(invParent).toArray(values, at);
    }
    tracks.push(new THREE.QuaternionKeyframeTrack(`${normalised.name}.quaternion`, [...track.times], [...values]));
  }
  return new THREE.AnimationClip(clip.name, clip.duration, tracks);
}

const landmarks = ({ nodes }: Actor): Landmarks => ({
  eye: nodes.eye.matrixWorld.elements.slice(),
  head: nodes.head.matrixWorld.elements.slice(),
  chest: nodes.chest.matrixWorld.elements.slice(),
});

/** A frame in the order that the package asks for. */
function step(actor: Actor, dt: number, gaze?: Gaze<Target>): void {
  actor.mixer.update(dt);
  gaze?.update(dt);
  actor.vrm?.update(dt);
  actor.scene.updateMatrixWorld(true);
}

function attach(actor: Actor, { rig }: Character, bytes: ArrayBuffer, target: Target): Promise<Gaze<Target>> {
  const options = {
    target,
    ...(rig === undefined ? {} : { rig: rig === "bytes" ? { glb: bytes.slice(0) } : rig }),
  };
  return actor.vrm ? attachVrm(actor.vrm, options) : attachThree(actor.gltf, options);
}

async function look(character: Character): Promise<Found> {
  const bytes = await (await fetch(character.url)).arrayBuffer();
  const [actor, alone] = [await load(character, bytes), await load(character, bytes)];
  const rest = landmarks(actor);
  const front = frontOf(character, actor, rest);
  const forward = character.forward ?? inSpaceOf(rest.eye, front);
  const judge = new Judge(rest, front);

  const world = new THREE.Scene();
  const target = new THREE.Mesh(new THREE.SphereGeometry(0.02), new THREE.MeshBasicMaterial({ color: 0xd03020 }));
  world.add(actor.scene, target);
  const eye = new THREE.Vector3(...origin(rest.eye));
  // As far away as the eye is above the ground.
  const distance = eye.y - actor.scene.position.y;
  const [degrees, seconds] = character.swing;
  const place = (t: number): void => {
    const along = new THREE.Vector3(...front).applyAxisAngle(
      new THREE.Vector3(0, 1, 0), (degrees / DEG) * Math.sin((2 * Math.PI * t) / seconds),
    );
    target.position.copy(eye).addScaledVector(along, distance);
    target.position.y += 0.12 * distance * Math.sin((2 * Math.PI * t) / (1.4 * seconds));
  };

  place(0);
  const gaze = await attach(actor, character, bytes, target);
  gaze.snap();
  const off: number[] = [];
  const found: Found = {
    median: 0, p90: 0, worst: 0, statuses: {}, joints: {}, looks: judge.looks, turned: 0, microseconds: 0,
  };
  for (let frame = 0; frame < FRAMES; frame += 1) {
    const t = frame * DT;
    place(t);
    step(actor, frame === 0 ? 0 : DT, gaze);
    step(alone, frame === 0 ? 0 : DT);
    const [aimed, animated] = [landmarks(actor), landmarks(alone)];
    const point = target.position.toArray() as unknown as Vec3;
    off.push(offDeg(aimed.eye, forward, point));
    found.turned = Math.max(found.turned, offDeg(animated.eye, forward, point));
    judge.push(t, DT, aimed, animated);
    found.statuses[gaze.status] = (found.statuses[gaze.status] ?? 0) + 1;
    for (const { name, heading, pitch } of gaze.joints) {
      const range = (found.joints[name] ??= { heading: [Infinity, -Infinity], pitch: [Infinity, -Infinity] });
      for (const [key, angle] of [["heading", heading * DEG], ["pitch", pitch * DEG]] as const) {
        range[key] = [Math.min(range[key][0], angle), Math.max(range[key][1], angle)];
      }
    }
    // Where the target is far to the side.
    if (character.picture && frame === Math.round((0.25 * seconds) / DT)) {
      found.pictures = photograph(world, actor, alone, target, front, distance);
    }
  }
  [found.median, found.p90, found.worst] = [quantile(off, 0.5), quantile(off, 0.9), Math.max(...off)];
  const began = performance.now();
  for (let i = 0; i < 2000; i += 1) {
    place(i * DT);
    gaze.update(DT);
  }
  found.microseconds = ((performance.now() - began) * 1000) / 2000;
  gaze.dispose();
  return found;
}

function frontOf({ front, forward }: Character, { scene }: Actor, rest: Landmarks): Vec3 {
  const way = new THREE.Vector3();
  if (front) way.set(...front).applyQuaternion(scene.quaternion);
  else if (forward) way.set(...forward).transformDirection(new THREE.Matrix4().fromArray(rest.eye));
  way.setY(0).normalize();
  return [way.x, way.y, way.z];
}

let renderer: THREE.WebGLRenderer | undefined;
const SIZE = 640;

/** The head fills the middle of the picture: with the animation alone, and with the gaze. */
function photograph(
  world: THREE.Scene, actor: Actor, alone: Actor, target: THREE.Object3D, front: Vec3, height: number,
): NonNullable<Found["pictures"]> {
  renderer ??= new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
  renderer.setSize(SIZE, SIZE);
  world.background = new THREE.Color(0xd9dee3);
  const light = new THREE.DirectionalLight(0xffffff, 2);
  light.position.set(front[0] + 1, 2, front[2]);
  const sky = new THREE.HemisphereLight(0xffffff, 0x9a8f80, 2);
  world.add(light, sky);
  const head = new THREE.Vector3(...origin(landmarks(alone).eye));
  const camera = new THREE.PerspectiveCamera(30, 1, 0.01 * height, 10 * height);
  camera.position.copy(head).addScaledVector(new THREE.Vector3(...front), 0.38 * height);
  camera.lookAt(head);
  const shoot = (): { url: string; pixels: Uint8Array } => {
    renderer?.render(world, camera);
    const gl = renderer?.getContext();
    if (!renderer || !gl) throw new Error("no WebGL");
    const pixels = new Uint8Array(4 * SIZE * SIZE);
    gl.readPixels(0, 0, SIZE, SIZE, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return { url: renderer.domElement.toDataURL("image/png"), pixels };
  };
  target.visible = false;
  const unmarked = shoot();
  target.visible = true;
  const after = shoot();
  target.visible = false;
  world.remove(actor.scene);
  world.add(alone.scene);
  const before = shoot();
  world.remove(alone.scene, light, sky);
  world.add(actor.scene);
  target.visible = true;

  let changed = 0;
  const colours = new Set<number>();
  const [from, to] = [SIZE / 4, (3 * SIZE) / 4];
  for (let y = from; y < to; y += 1) {
    for (let x = from; x < to; x += 1) {
      const at = 4 * (y * SIZE + x);
      let change = 0;
      let colour = 0;
      for (let i = 0; i < 3; i += 1) {
        const [a, b] = [unmarked.pixels[at + i] ?? 0, before.pixels[at + i] ?? 0];
        change += Math.abs(a - b);
        colour = 32 * colour + (a >> 3);
      }
      changed += change > 24 ? 1 : 0;
      colours.add(colour);
    }
  }
  return { before: before.url, after: after.url, changed: changed / (to - from) ** 2, colours: colours.size };
}

/** Microseconds that an update costs, warm: of the gaze with the rig "vrm", and of three-vrm's own look-at. */
async function time(character: Character): Promise<{ gaze: number; lookAt: number; joints: number }> {
  const bytes = await (await fetch(character.url)).arrayBuffer();
  const [actor, other] = [await load(character, bytes), await load(character, bytes)];
  const target = new THREE.Object3D();
  const gaze = await attach(actor, { ...character, rig: "vrm" }, bytes, target);
  const lookAt = other.vrm?.lookAt;
  if (!lookAt) throw new Error("no look-at");
  lookAt.target = target;
  const measure = (update: () => void): number => {
    let best = Infinity;
    for (let round = 0; round < 4; round += 1) {
      const began = performance.now();
      for (let i = 0; i < 10_000; i += 1) {
        target.position.set(0.5 * Math.sin(0.02 * i), 1.6, 2);
        target.updateMatrixWorld();
        update();
      }
      best = Math.min(best, (performance.now() - began) / 10);
    }
    return best;
  };
  const result = {
    gaze: measure(() => { gaze.update(DT); }),
    lookAt: measure(() => { lookAt.update(DT); }),
    joints: gaze.joints.length,
  };
  gaze.dispose();
  return result;
}

Object.assign(globalThis, { acceptance: { look, time } });
