// What the tests of the adapters share: characters, and judges that know the engines' own matrices only.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

/** The mannequin's bytes; `flags` as its example takes them: `--moves`, `--vrm0`, `--vrm1`. */
export function mannequin(...flags) {
  const root = fileURLToPath(new URL("../../../..", import.meta.url));
  const target = process.env.CARGO_TARGET_DIR ?? join(root, "target");
  const built = ["debug", "release"].map((profile) => join(target, profile, "examples", "mannequin"));
  const program = [process.env.AIM_MANNEQUIN, ...built].find((path) => path && existsSync(path));
  if (!program) throw new Error("no mannequin: run `cargo build -p aim-character --example mannequin` first");
  const folder = mkdtempSync(join(tmpdir(), "aim-gaze-"));
  try {
    const file = join(folder, "mannequin.glb");
    execFileSync(program, [file, ...flags]);
    return new Uint8Array(readFileSync(file));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** A GLB with its JSON changed by `edit`. */
export function edited(glb, edit) {
  const view = new DataView(glb.buffer, glb.byteOffset, glb.byteLength);
  const length = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + length)));
  edit(json);
  let text = JSON.stringify(json);
  text += " ".repeat((4 - (new TextEncoder().encode(text).length % 4)) % 4);
  const chunk = new TextEncoder().encode(text);
  const rest = glb.subarray(20 + length);
  const made = new Uint8Array(20 + chunk.length + rest.length);
  const out = new DataView(made.buffer);
  out.setUint32(0, view.getUint32(0, true), true);
  out.setUint32(4, 2, true);
  out.setUint32(8, made.length, true);
  out.setUint32(12, chunk.length, true);
  out.setUint32(16, view.getUint32(16, true), true);
  made.set(chunk, 20);
  made.set(rest, 20 + chunk.length);
  return made;
}

export function median(numbers) {
  const sorted = [...numbers].sort((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)];
}

/** The angle between two directions, degrees. */
export function angle([a, b, c], [x, y, z]) {
  const cross = Math.hypot(b * z - c * y, c * x - a * z, a * y - b * x);
  return (Math.atan2(cross, a * x + b * y + c * z) * 180) / Math.PI;
}

/** Where the target is at a time, seconds, before a character of 1.7 m that stands at the origin and faces +Z. */
export function orbit(time) {
  return [0.45 * Math.sin(1.3 * time), 1.5 + 0.2 * Math.sin(2.1 * time + 1), 1.3 + 0.2 * Math.cos(0.9 * time)];
}
