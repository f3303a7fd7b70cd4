// The package in headless Chromium, as its users have it: three.js and three-vrm, bundled by esbuild, from a static server.
//
// node --test tests/browser.mjs, in a folder that has the package installed; AIM_MODELS is a folder of characters, each with
// what the `aim` command says of it (NAME.toml by `aim rig`, NAME.json by `aim bake --report`), AIM_PICTURES is where
// pictures go, CHROMIUM the browser. What is right is said here; page.ts measures it.
import assert from "node:assert/strict";
import { cpSync, createReadStream, existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, resolve, sep } from "node:path";
import { after, before, test } from "node:test";
import { build } from "esbuild";
import { chromium } from "playwright-core";

const app = resolve(import.meta.dirname, "..");
const models = resolve(process.env.AIM_MODELS ?? join(app, "models"));
const pictures = resolve(process.env.AIM_PICTURES ?? join(app, "pictures"));
const site = join(app, "site");
const inPackage = join(app, "node_modules/aim-gaze/dist");

/** Of a target that moves, by three's own matrices. */
const MEDIAN_DEG = 0.01;
/** Of a head that looks by itself: it is slower than an eye, and the animation moves it. */
const MEDIAN_OF_HEADS_DEG = 0.1;
/** What `aim bake` holds to be bearable of a person. */
const BEARABLE = {
  headToChest: 80, headRoll: 15, headSpeed: 300, headAcceleration: 3000, reversals: 2, eyeHeading: 36, eyePitch: 27,
};
/** Of an animal; its head is what looks. */
const OF_ANIMALS = { headToChest: 130, headRoll: 25, headSpeed: 420, headAcceleration: Infinity, reversals: 2, eyeHeading: 1, eyePitch: 1 };

const mannequin = { eye: "left_eye", head: "head", chest: "spine3", clip: "walk", swing: [30, 4], picture: true };
const characters = {
  "GLB, measured from its skeleton": { ...mannequin, url: "mannequin.glb", kind: "glb", front: [0, 0, 1], rig: "measure" },
  "GLB, by default": { ...mannequin, url: "mannequin.glb", kind: "glb", front: [0, 0, 1], picture: false },
  "GLB, measured from its bytes": { ...mannequin, url: "mannequin.glb", kind: "glb", front: [0, 0, 1], rig: "bytes", picture: false },
  "GLB, by a rig file": { ...mannequin, url: "mannequin.glb", kind: "glb", front: [0, 0, 1], rig: "toml", picture: false },
  "VRM 0": { ...mannequin, url: "vrm0.vrm", kind: "vrm", front: [0, 0, -1] },
  "VRM 1": { ...mannequin, url: "vrm1.vrm", kind: "vrm", front: [0, 0, 1] },
};
const rigs = {
  dude: {
    url: "dude.glb", eye: "L_eyeBall_joint2", head: "Head", chest: "Spine3", clip: "Take 001", swing: [25, 4],
  },
  "the Rocketbox figure": {
    url: "rocketbox_female_adult_01.glb", eye: "Bip01 LEye", head: "Bip01 Head", chest: "Bip01 Spine2",
    clip: "f_idle_neutral_01", swing: [30, 4],
  },
  "the fox": { url: "khronos_fox.glb", eye: "b_Head_05", head: "b_Head_05", chest: "b_Spine02_03", clip: "Walk", swing: [20, 12] },
};
for (const [name, rig] of Object.entries(rigs)) {
  if (!existsSync(join(models, rig.url))) {
    console.log(`NOT TESTED: ${name}, for there is no ${rig.url} in ${models}.`);
    continue;
  }
  // What is to meet the target is as the command has measured it.
  const { forward } = JSON.parse(readFileSync(join(models, `${rig.url}.json`), "utf8")).effector;
  characters[`${name}, measured from its skeleton`] = { ...rig, kind: "glb", forward, rig: "measure", picture: name !== "the fox" };
  characters[`${name}, measured from its bytes`] = { ...rig, kind: "glb", forward, rig: "bytes" };
}

/**
 * Ranges of a rig file within which corrections stay, by the names of its joints: degrees. A range that counts from the
 * bind pose contains the animation, too; a correction from one end to the other is as long as the range.
 */
function rangesOf(toml) {
  const ranges = {};
  for (const joint of toml.split("[[joint]]").slice(1)) {
    const name = /^name = "(.*)"$/m.exec(joint)[1];
    const range = (angle) => {
      const found = new RegExp(`^${angle} = \\["(.*?)deg", "(.*?)deg"\\]`, "m").exec(joint);
      const [low, high] = found ? [Number(found[1]), Number(found[2])] : [0, 0];
      return /^limits_from = "bind_pose"$/m.test(joint) ? [low - high, high - low] : [low, high];
    };
    ranges[name] = { heading: range("heading"), pitch: range("pitch") };
  }
  return ranges;
}

const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm" };
const requests = [];
/** Serves the site, then the characters, then the packages. */
const server = createServer((request, response) => {
  const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname).replace(/\/$/, "/index.html");
  requests.push(path);
  const file = [site, models, app].map((folder) => join(folder, path)).find(
    (one) => one.startsWith(app + sep) || one.startsWith(models + sep) ? existsSync(one) && statSync(one).isFile() : false,
  );
  if (!file) {
    response.writeHead(404).end();
    return;
  }
  response.writeHead(200, { "content-type": types[extname(file)] ?? "application/octet-stream" });
  createReadStream(file).pipe(response);
});

let browser;
let address;
const trouble = [];
async function open(path) {
  const page = await browser.newPage({ viewport: { width: 640, height: 640 } });
  page.on("pageerror", (error) => trouble.push(`${path}: ${error}`));
  page.on("console", (message) => {
    if (message.type() === "error") trouble.push(`${path}: ${message.text()}`);
  });
  trouble.length = 0;
  requests.length = 0;
  await page.goto(`${address}/${path}`);
  return page;
}
const noTrouble = () => { assert.deepEqual(trouble, []); };

/** A page that has one script. */
const html = (script, head = "") =>
  `<!doctype html><meta charset="utf-8"><title>aim-gaze</title><link rel="icon" href="data:,">${head}<body>${script}</body>`;

before(async () => {
  mkdirSync(site, { recursive: true });
  mkdirSync(pictures, { recursive: true });
  await build({
    entryPoints: { page: join(app, "tests/page.ts"), inlined: join(app, "tests/inlined.js") },
    outdir: site, bundle: true, splitting: true, minify: true, format: "esm", target: "es2022", logLevel: "warning",
  });
  // Bundles look for them beside themselves, as load.js says: esbuild copies none.
  cpSync(join(inPackage, "wasm"), join(site, "wasm"), { recursive: true, filter: (path) => !path.endsWith(".js") });
  writeFileSync(join(site, "index.html"), html('<script type="module" src="page.js"></script>'));
  writeFileSync(join(site, "inlined.html"), html('<script type="module" src="inlined.js"></script>'));
  // No bundler: the browser finds three by the map.
  const map = {
    imports: { three: "/node_modules/three/build/three.module.js", "three/addons/": "/node_modules/three/examples/jsm/" },
  };
  writeFileSync(join(site, "single.html"), html(
    `<script type="module">
      import * as THREE from "three";
      import * as loader from "three/addons/loaders/GLTFLoader.js";
      import * as vrm from "/node_modules/@pixiv/three-vrm/lib/three-vrm.module.js";
      import { attachVrm } from "/node_modules/aim-gaze/dist/single.js";
      import { run } from "/tests/single.js";
      globalThis.acceptance = { run: () => run(THREE, loader, vrm, attachVrm) };
    </script>`,
    `<script type="importmap">${JSON.stringify(map)}</script>`,
  ));
  await new Promise((done) => { server.listen(0, "127.0.0.1", done); });
  address = `http://127.0.0.1:${server.address().port}`;
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
      "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
    ],
  });
});
after(async () => {
  await browser?.close();
  server.close();
});

const image = (name, url) => {
  const file = join(pictures, `${name.toLowerCase().replace(/[^a-z0-9]+/g, "-")}.png`);
  writeFileSync(file, Buffer.from(url.split(",")[1], "base64"));
};

for (const [name, character] of Object.entries(characters)) {
  test(name, { timeout: 60_000 }, async () => {
    const page = await open("");
    await page.waitForFunction(() => "acceptance" in globalThis);
    const toml = readFileSync(join(models, character.kind === "vrm" ? "vrm.toml" : `${character.url}.toml`), "utf8");
    const found = await page.evaluate(
      (one) => globalThis.acceptance.look(one),
      { ...character, rig: character.rig === "toml" ? { toml } : character.rig },
    );
    await page.close();
    const { median, p90, worst, statuses, looks, turned, microseconds } = found;
    const rounded = Object.fromEntries(Object.entries(looks).map(([key, value]) => [key, Number(value.toFixed(2))]));
    console.log(`  ${name}: median ${median.toExponential(1)}°, p90 ${p90.toExponential(1)}°, worst ${worst.toExponential(1)}°; ` +
      `${microseconds.toFixed(1)} µs an update; ${JSON.stringify(statuses)}; ${JSON.stringify(rounded)}`);
    if (found.pictures) {
      image(`${name} before`, found.pictures.before);
      image(`${name} after`, found.pictures.after);
    }

    noTrouble();
    assert.ok(turned > 15, `the target is where the animation looks, ${turned}° at most: nothing is tested`);
    const most = character.eye === character.head ? MEDIAN_OF_HEADS_DEG : MEDIAN_DEG;
    assert.ok(median <= most, `half of all frames are more than ${median}° off, at most ${most}°`);
    assert.ok(!("behind" in statuses || "degenerate" in statuses || "no_target" in statuses), JSON.stringify(statuses));
    const declared = rangesOf(toml);
    assert.ok(Object.keys(found.joints).length > 1, "the gaze tells its joints");
    for (const [joint, range] of Object.entries(found.joints)) {
      assert.ok(joint in declared, `${joint} is no joint of ${Object.keys(declared)}`);
      for (const angle of ["heading", "pitch"]) {
        const [[least, most], [low, high]] = [range[angle], declared[joint][angle]];
        assert.ok(least >= low - 0.01 && most <= high + 0.01, `${joint}: ${angle} ${least}°…${most}°, declared ${low}°…${high}°`);
      }
    }
    for (const [key, bearable] of Object.entries(name.startsWith("the fox") ? OF_ANIMALS : BEARABLE)) {
      assert.ok(looks[key] <= bearable, `${key}: ${looks[key]}, at most ${bearable}`);
    }
    if (character.picture) {
      const { changed, colours } = found.pictures;
      console.log(`  ${name}: ${(100 * changed).toFixed(1)} % of the head's pixels changed, ${colours} colours`);
      assert.ok(colours > 60, "the picture is blank");
      assert.ok(changed > 0.003, "the picture of the head shows no gaze");
    }
  });
}

// Of a VRM that has expressions: three-vrm gives others no look-at.
test("what a frame costs, against three-vrm's look-at", { timeout: 60_000 }, async () => {
  const page = await open("");
  await page.waitForFunction(() => "acceptance" in globalThis);
  const { gaze, lookAt, joints } = await page.evaluate((one) => globalThis.acceptance.time(one), characters["VRM 0"]);
  await page.close();
  console.log(`  ${joints} joints: ${gaze.toFixed(2)} µs an update; three-vrm's look-at of the eyes alone: ` +
    `${lookAt.toFixed(2)} µs; ratio ${(gaze / lookAt).toFixed(2)}`);
  noTrouble();
});

for (const [name, path] of [["the single file, without a bundler", "single.html"], ["aim-gaze/inline, bundled", "inlined.html"]]) {
  test(name, { timeout: 60_000 }, async () => {
    const page = await open(path);
    await page.waitForFunction(() => "acceptance" in globalThis, undefined, { timeout: 10_000 }).catch(() => noTrouble());
    const off = await page.evaluate(() => globalThis.acceptance.run());
    await page.close();
    console.log(`  ${name}: ${off.toExponential(1)}° off`);
    noTrouble();
    assert.ok(off <= MEDIAN_DEG, `${off}° off`);
    assert.deepEqual(requests.filter((one) => one.endsWith(".wasm")), [], "nothing of WebAssembly is fetched");
  });
}

// As serve.mjs has written them.
const examples = process.env.AIM_EXAMPLES;
if (examples) {
  for (const name of readdirSync(examples).filter((one) => one.endsWith(".html") && one !== "index.html")) {
    test(`the example ${name}`, { timeout: 60_000 }, async () => {
      const page = await open(`examples-site/${name}`);
      await page.waitForSelector("canvas");
      for (let i = 0; i < 10; i += 1) {
        await page.mouse.move(300 + 5 * i, 200 + 5 * i);
        await page.waitForTimeout(30);
      }
      // The one for react shows no status.
      if (!name.startsWith("react")) {
        await page.waitForFunction(
          () => ["reached", "on_the_way"].includes(document.querySelector("output")?.value), undefined, { timeout: 15_000 },
        ).catch(async () => {
          assert.fail(`status "${await page.locator("output").textContent()}"; ${trouble.join("; ")}`);
        });
      } else {
        await page.waitForTimeout(2000);
      }
      await page.screenshot({ path: join(pictures, `example-${name.replace(".html", "")}.png`) });
      await page.close();
      noTrouble();
    });
  }
}
