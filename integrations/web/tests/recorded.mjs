// Plays characters that were aimed natively through the package, and compares every bit: node recorded.mjs RECORDED.json [DIST]
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [recorded, dist = "dist"] = process.argv.slice(2);
const { attach } = await import(pathToFileURL(resolve(dist, "index.js")));
const { file, toml, cases } = JSON.parse(readFileSync(recorded, "utf8"));

const BEHINDS = ["clip", "off", "plane", "hold", "release"];
const STATUSES = ["no_target", "reached", "on_the_way", "at_limit", "behind", "degenerate"];

/** FNV-1a of the bits of single-precision numbers. */
class Hash {
  value = 0xcbf29ce484222325n;
  #bytes = new DataView(new ArrayBuffer(4));
  add(number) {
    this.#bytes.setFloat32(0, number, true);
    for (let at = 0; at < 4; at++) {
      this.value = BigInt.asUintN(64, (this.value ^ BigInt(this.#bytes.getUint8(at))) * 0x100000001b3n);
    }
  }
}

function floats(hex) {
  const bytes = Uint8Array.from(Buffer.from(hex, "hex"));
  return new Float32Array(bytes.buffer);
}

async function play({ rig, bothEyes, bones, used, input }) {
  const numbers = floats(input);
  const each = 3 + 21 + 8 + 10 * used.length;
  const hash = new Hash();
  let frame;
  const skeleton = {
    bones: bones.map(([name, parent, node, rest]) => ({ name, parent, node, rest: floats(rest) })),
    read(bone, into, offset) {
      const at = 32 + 10 * used.indexOf(bone);
      into.set(frame.subarray(at, at + 10), offset);
    },
    write(bone, from, offset) {
      for (let at = 0; at < 7; at++) hash.add(from[offset + at]);
    },
    place(into, offset) {
      into.set(frame.subarray(3, 19), offset);
    },
  };
  const given = { file: { glb: Uint8Array.from(Buffer.from(file, "hex")) }, toml: { toml } }[rig] ?? rig;
  const gaze = await attach(skeleton, { rig: given, bothEyes });
  for (let start = 0; start < numbers.length; start += each) {
    frame = numbers.subarray(start, start + each);
    const [dt, count, snaps] = frame;
    [gaze.weight, gaze.attention, gaze.patience, gaze.tolerance] = frame.subarray(19, 23);
    gaze.behind = BEHINDS[frame[23]];
    gaze.targets = [24, 28].slice(0, count).map((at) => {
      const [x, y, z, weight] = frame.subarray(at, at + 4);
      return { target: { x, y, z }, weight };
    });
    if (snaps) gaze.snap();
    gaze.update(dt);
    [STATUSES.indexOf(gaze.status), gaze.remaining, gaze.bodyTurn, gaze.outOfReachFor].forEach((number) => hash.add(number));
    for (const { heading, pitch } of gaze.joints) [heading, pitch].forEach((number) => hash.add(number));
  }
  return hash.value.toString(16).padStart(16, "0");
}

let wrong = cases.length === 0;
for (const recording of cases) {
  const hash = await play(recording);
  wrong ||= hash !== recording.hash;
  console.log(`${hash === recording.hash ? "same bits" : `OTHER BITS (${hash}, natively ${recording.hash})`}: ${recording.name}`);
}
process.exit(wrong ? 1 : 0);
