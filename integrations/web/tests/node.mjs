// Characters in plain Node, for the tests that need no browser.
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

export const app = resolve(import.meta.dirname, "..");
const models = resolve(process.env.AIM_MODELS ?? join(app, "models"));

/** The bytes of a character, as a buffer of its own. */
export function bytesOf(name) {
  const bytes = readFileSync(join(models, name));
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
}

/** A GLB without pictures, as three holds it. */
export async function load(name) {
  const gltf = await new GLTFLoader().parseAsync(bytesOf(name), "");
  gltf.scene.updateMatrixWorld(true);
  return gltf;
}

/** A skeleton of the core with the names of VRM, upright, in plain numbers. */
export function skeleton() {
  const bones = [];
  const locals = [];
  const add = (name, parent, x, y, z) => {
    bones.push({ name, parent });
    locals.push(Float32Array.of(x, y, z, 0, 0, 0, 1, 1, 1, 1));
    return bones.length - 1;
  };
  const hips = add("hips", -1, 0, 1, 0);
  const chest = add("chest", add("spine", hips, 0, 0.1, 0), 0, 0.1, 0);
  const upper = add("upperChest", chest, 0, 0.12, 0);
  const head = add("head", add("neck", upper, 0, 0.15, 0), 0, 0.1, 0);
  add("leftEye", head, 0.03, 0.06, 0.08);
  add("rightEye", head, -0.03, 0.06, 0.08);
  const place = Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  return {
    bones,
    locals,
    read: (bone, into, offset) => { into.set(locals[bone], offset); },
    write: (bone, from, offset) => { for (let i = 0; i < 7; i += 1) locals[bone][i] = from[offset + i]; },
    place: (into, offset) => { into.set(place, offset); },
  };
}
