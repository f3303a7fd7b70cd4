import { GazeError } from "./error.js";

/** A part of the package that is loaded when it is first needed: a module with the solvers and one way to come by a rig. */
export type Part = "presets" | "measure" | "declare";

/** The classes of a loaded part. */
export interface Engine {
  readonly memory: WebAssembly.Memory;
  readonly Bones: new () => RawBones;
  readonly Character: Characters;
  layout(): Uint32Array;
  liveBytes(): number;
}

/** The bones of a character, as they are handed over one by one. */
export interface RawBones {
  add(name: string, parent: number, rest: Float32Array): void;
  bind(matrix: Float32Array): void;
  node(node: number): void;
  trunk(bone: number): void;
  free(): void;
}

/** Ways to make a character; each part has its own. */
export interface Characters {
  preset(bones: RawBones, name: string, bothEyes: boolean): RawCharacter;
  measured(bones: RawBones, bothEyes: boolean): RawCharacter;
  ofFile(bones: RawBones, bytes: Uint8Array, bothEyes: boolean): RawCharacter;
  declared(bones: RawBones, file: string, text: string, bothEyes: boolean): RawCharacter;
}

/** A character that aims: it shares a block of numbers. */
export interface RawCharacter {
  block(): number;
  blockLength(): number;
  bones(): Uint32Array;
  written(): Uint32Array;
  joints(): Uint32Array;
  jointName(joint: number): string;
  update(dt: number, targets: number, snap: boolean): void;
  restore(): void;
  free(): void;
}

interface Glue {
  default(input: { module_or_path: BufferSource | URL }): Promise<{ memory: WebAssembly.Memory }>;
}

const parts: Record<Part, { glue(): Promise<unknown>; bytes: URL }> = {
  // Written out, so that bundlers see each file.
  presets: { glue: () => import("./wasm/presets.js"), bytes: new URL("./wasm/presets_bg.wasm", import.meta.url) },
  measure: { glue: () => import("./wasm/measure.js"), bytes: new URL("./wasm/measure_bg.wasm", import.meta.url) },
  declare: { glue: () => import("./wasm/declare.js"), bytes: new URL("./wasm/declare_bg.wasm", import.meta.url) },
};

const provided = new Map<Part, () => Uint8Array>();
const loading = new Map<Part, Promise<Engine>>();
const loaded = new Map<Part, Engine>();

/** Has a part made of these bytes when it is first needed, so that nothing is fetched. */
export function provide(part: Part, bytes: () => Uint8Array): void {
  provided.set(part, bytes);
}

/** The bytes of a text in base64. */
export function decoded(base64: string): Uint8Array {
  return Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
}

/** Loads a part, once. */
export function load(part: Part): Promise<Engine> {
  let engine = loading.get(part);
  if (!engine) {
    engine = start(part);
    loading.set(part, engine);
    // What could not be had may be had later.
    engine.catch(() => loading.delete(part));
  }
  return engine;
}

async function start(part: Part): Promise<Engine> {
  const { glue, bytes } = parts[part];
  let engine: Engine;
  try {
    const module = (await glue()) as Glue & Omit<Engine, "memory">;
    const { memory } = await module.default({ module_or_path: source(part, bytes) });
    const { Bones, Character, layout, liveBytes } = module;
    engine = { memory, Bones, Character, layout, liveBytes };
  } catch (error) {
    throw new GazeError(advice(part, bytes, error), { cause: error });
  }
  loaded.set(part, engine);
  return engine;
}

/** What to do about a part that cannot be loaded. */
function advice(part: Part, { href }: URL, error: unknown): string {
  const why = error instanceof Error ? error.message : String(error);
  const inline = `import "aim-gaze/inline${part === "presets" ? "" : `-${part}`}"`;
  const cure = href.includes("/.vite/")
    ? `Vite before 8 leaves it out of its cache: set optimizeDeps: { exclude: ["aim-gaze"] } in vite.config.js, or ${inline} first`
    : `serve the package's folder dist/wasm at ${href.slice(0, href.lastIndexOf("/") + 1)}, or ${inline} in the same bundle`;
  return `the part "${part}" of aim-gaze could not be loaded from ${href} (${why}): ${cure}`;
}

/** The bytes where they are at hand; else where to fetch them. */
function source(part: Part, url: URL): BufferSource | URL {
  const inlined = provided.get(part);
  if (inlined) return inlined() as Uint8Array<ArrayBuffer>;
  // Node fetches no files.
  const fs = url.protocol === "file:" ? node()?.getBuiltinModule?.("node:fs") : undefined;
  return fs ? fs.readFileSync(url) : url;
}

interface Node {
  getBuiltinModule?(name: "node:fs"): { readFileSync(path: URL): Uint8Array<ArrayBuffer> };
}

function node(): Node | undefined {
  return (globalThis as { process?: Node }).process;
}

/** What the loaded parts use: the size of their memories and the bytes that are allocated in them. For tests. */
export function usage(): { bytes: number; live: number } {
  let [bytes, live] = [0, 0];
  for (const engine of loaded.values()) {
    bytes += engine.memory.buffer.byteLength;
    live += engine.liveBytes();
  }
  return { bytes, live };
}
