// Takes pictures of the viewer's window and looks at them: node view-screens.mjs AIM OUT RIGS [--bless]
//
// The mannequin's are compared with docs/screens by a perceptual metric (pixelmatch's colour distance in YIQ, edges
// aside), those of real characters in the folder RIGS by content: not blank, the target where it is said to be, and the
// gaze rays drawn from the eyes to it. --bless writes the references anew.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const require = createRequire(import.meta.url);
const { PNG } = require("pngjs");
const pixelmatch = (await import(require.resolve("pixelmatch"))).default;
const [aim, out, rigs, bless] = process.argv.slice(2);
const references = "docs/screens";
mkdirSync(out, { recursive: true });

/// More of the pixels than this may not differ from a reference.
const SAME = 0.001;

const scene = ["--size", "640x400", "--show", "gaze"];
const mannequin = {
  look: scene,
  gizmos: ["--size", "640x400", "--show", "axes,limits,gaze,trail", "--path", "eight", "--frames", "100"],
  solvers: [...scene, "--solver", "all", "--path", "noise"],
  shown: ["--size", "640x400", "--show", "gaze,boxes,lamp,slope", "--frames", "60"],
  panel: ["--size", "1120x700", "--show", "gaze,limits,trail,plots,panel", "--path", "eight", "--frames", "200"],
};
// Heads with inertia lag behind what the clips of two of them do in jerks: these are looked at as they follow without.
const real = {
  dude: ["dude.glb", "--rig", "rigs/thug.toml"],
  rocketbox: ["rocketbox_female_adult_01.glb"],
  fox: ["khronos_fox.glb", "--solver", "exact"],
  robot: ["quaternius_robot.glb", "--clip", "Robot_Dance"],
  arnaud: ["pab_arnaud.glb", "--solver", "exact"],
  horse: ["quaternius_horse.glb", "--clip", "Armature|Idle"],
  cesium: ["cesium_man.gltf"],
};

let failed = 0;
const complain = (name, problem) => {
  console.error(`${name}: ${problem}`);
  failed += 1;
};

const take = (name, options) => {
  const file = join(out, `${name}.png`);
  const told = execFileSync(aim, ["view", ...options, "--screenshot", file, "--json"], { encoding: "utf8" });
  return { actors: JSON.parse(told), image: PNG.sync.read(readFileSync(file)) };
};
const colour = ({ data, width, height }, [x, y]) => {
  const at = 4 * (Math.min(Math.max(Math.round(y), 0), height - 1) * width + Math.min(Math.max(Math.round(x), 0), width - 1));
  return [data[at], data[at + 1], data[at + 2]];
};
/// Whether the colour is seen within two pixels of a point.
const shows = (image, [x, y], is) => {
  for (let dy = -2; dy <= 2; dy += 1) {
    for (let dx = -2; dx <= 2; dx += 1) if (is(...colour(image, [x + dx, y + dy]))) return true;
  }
  return false;
};
const isTarget = (r, g, b) => r > 110 && r > 1.6 * g && r > 2.5 * b;
const isReached = (r, g, b) => g > 70 && g > 2 * r && g > 1.15 * b;

/// Not blank; the target is where it is said to be; each gaze ends there, and its ray is drawn.
const look = (name, { actors, image }) => {
  const colours = new Set();
  for (let at = 0; at < image.data.length; at += 4) {
    colours.add(((image.data[at] >> 3) << 10) | ((image.data[at + 1] >> 3) << 5) | (image.data[at + 2] >> 3));
  }
  if (colours.size < 150) complain(name, `has ${colours.size} colours: it looks blank`);
  for (const { solver, status, error_deg, target_seen, gazes_seen } of actors) {
    const who = `${name}, ${solver}`;
    if (status !== "Reached" || error_deg > 0.15) complain(who, `${status}, ${error_deg}° off the target`);
    if (!shows(image, target_seen, isTarget)) complain(who, `no target at ${target_seen}: ${colour(image, target_seen)}`);
    for (const [from, to] of gazes_seen) {
      const miss = Math.hypot(to[0] - target_seen[0], to[1] - target_seen[1]);
      if (miss > 3) complain(who, `a gaze ends ${miss.toFixed(1)} pixels from the target`);
      // Between the face and the ball.
      const along = [0.4, 0.5, 0.6, 0.7].map((share) => from.map((c, i) => c + (to[i] - c) * share));
      const drawn = along.filter((at) => shows(image, at, isReached)).length;
      if (drawn < 3) complain(who, `its ray is seen at ${drawn} of 4 points from ${from} to ${to}`);
    }
  }
};

for (const [name, options] of Object.entries(mannequin)) {
  const taken = take(name, options);
  if (name === "look" || name === "gizmos") look(name, taken);
  const reference = join(references, `${name}.png`);
  if (bless) {
    mkdirSync(references, { recursive: true });
    writeFileSync(reference, readFileSync(join(out, `${name}.png`)));
    continue;
  }
  const known = PNG.sync.read(readFileSync(reference));
  const { width, height } = known;
  if (taken.image.width !== width || taken.image.height !== height) {
    complain(name, `is ${taken.image.width}x${taken.image.height}, its reference ${width}x${height}`);
    continue;
  }
  const difference = new PNG({ width, height });
  const share = pixelmatch(known.data, taken.image.data, difference.data, width, height, { threshold: 0.15 }) / (width * height);
  console.log(`${name}: ${(100 * share).toFixed(3)} % of the pixels differ from the reference`);
  if (share > SAME) {
    writeFileSync(join(out, `${name}-difference.png`), PNG.sync.write(difference));
    complain(name, `differs from ${reference}; look at ${join(out, `${name}-difference.png`)}`);
  }
}
if (rigs && existsSync(rigs)) {
  for (const [name, [file, ...options]] of Object.entries(real)) {
    look(name, take(name, [join(rigs, file), ...options, ...scene, "--frames", "90"]));
    console.log(`${name}: looked at`);
  }
} else {
  console.log(`NOT TESTED: there is no folder of real characters${rigs ? ` ${rigs}` : ""}.`);
}
process.exit(failed > 0 ? 1 : 0);
