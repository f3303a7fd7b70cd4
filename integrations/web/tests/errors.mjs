// What a caller may do wrong, in plain Node: node --test tests/errors.mjs, in a folder that has the package installed.
//
// Each either throws a GazeError that says what was expected, in words of the web, or does no harm.
import assert from "node:assert/strict";
import { test } from "node:test";

// Before the package: importing it must fetch nothing, nor load WebAssembly.
const fetched = [];
const [realFetch, realCompile] = [globalThis.fetch, WebAssembly.instantiate];
globalThis.fetch = (...all) => {
  fetched.push(String(all[0]));
  return realFetch(...all);
};
WebAssembly.instantiate = (...all) => {
  fetched.push("WebAssembly.instantiate");
  return realCompile(...all);
};
const core = await import("aim-gaze");
const three = await import("aim-gaze/three");
const vrm = await import("aim-gaze/three-vrm");
const babylon = await import("aim-gaze/babylon");
const atImport = [...fetched];

const { bytesOf, load, skeleton } = await import("./node.mjs");
const { Bone, Object3D, Vector3 } = await import("three");
const { GazeError } = core;

/** Words of the language that the package is written in, and of engines that ran into something. */
const FOREIGN = [
  /panic|unwrap|RuntimeError|unreachable|\brust\b|0x[0-9a-f]+|\bpointer\b|wasm/i,
  // Not the English words.
  /\b(Option|Result|Some|None|Err|Vec|f32|usize)\b/,
  /undefined is|null is|is not a function|Cannot read|\[object|not iterable/,
];

/** The error's words are for its reader. */
function assertPlain(error) {
  assert.ok(error instanceof GazeError, `${error?.name}: ${error?.message}\n${error?.stack}`);
  assert.ok(error instanceof Error, "a GazeError is an Error");
  assert.equal(error.name, "GazeError");
  console.log(`  ${error.message.replaceAll("\n", "\n    ")}`);
  for (const foreign of FOREIGN) assert.doesNotMatch(error.message, foreign);
  // Long enough to say what was expected or what to do.
  assert.ok(error.message.length >= 25, `too short: ${error.message}`);
  assert.match(
    error.message,
    /\b(expect|expects|expected|must|needs?|use|pass|give|gives|has to|have to|should|one of|at most|at least|load|check|set|attach|takes|export|choose|is not|is no|are no|has no|not a)\b|, not /i,
  );
}
const plain = (error) => {
  assertPlain(error);
  return true;
};
const rejects = (act, name) => assert.rejects(async () => act(), plain, name);
const throws = (act) => { assert.throws(act, plain); };

test("importing fetches nothing and starts nothing", () => {
  assert.deepEqual(atImport, []);
  for (const module of [three, vrm, babylon, core]) assert.equal(typeof module.attach, "function");
});

test("sources that are no character", async () => {
  for (const { attach } of [core, three, vrm, babylon]) {
    for (const source of [null, undefined, {}, [], 7, "mannequin.glb", () => {}]) await rejects(() => attach(source, {}));
  }
  await rejects(() => three.attach(new Object3D()));
  await rejects(() => core.attach({ ...skeleton(), bones: [] }, { rig: "vrm" }));
});

test("skeletons that are none", async () => {
  const neck = skeleton().bones.findIndex(({ name }) => name === "neck");
  const broken = [
    // No such bone, itself, what hangs on it, and what is no index.
    { parent: 99 }, { parent: neck }, { parent: neck + 1 }, { parent: -7 }, { parent: NaN }, { parent: 0.5 }, { parent: "hips" },
    { parent: undefined }, { rest: [1, 2] }, { rest: 7 }, { inverseBind: [1, 2] },
  ];
  for (const change of broken) {
    const bones = skeleton().bones.map((bone, index) => (index === neck ? { ...bone, ...change } : bone));
    await rejects(() => core.attach({ ...skeleton(), bones }, { rig: "vrm" }), JSON.stringify(change));
  }
  for (const none of [null, undefined, 7]) {
    await rejects(() => core.attach({ ...skeleton(), bones: [...skeleton().bones, none] }, { rig: "vrm" }), `bone ${none}`);
  }
  for (const part of ["read", "write", "place"]) {
    await rejects(() => core.attach({ ...skeleton(), [part]: undefined }, { rig: "vrm" }), `without ${part}`);
  }
});

test("a skeleton without a head", async () => {
  const root = new Object3D();
  const bone = new Bone();
  bone.name = "lid";
  root.add(bone);
  await rejects(() => three.attach(root, { rig: "measure" }));
  await rejects(() => three.attach(root, { rig: "vrm" }));
  await rejects(() => three.attach(root));
});

test("rigs that are none", async () => {
  const gltf = await load("mannequin.glb");
  for (const rig of ["vrmm", "", 7, {}, [], { toml: 7 }, { glb: "mannequin.glb" }, { glb: null }]) {
    await rejects(() => three.attach(gltf, { rig }));
  }
  // A preset whose bones this character has not.
  await rejects(() => three.attach(gltf, { rig: "mixamo" }));
  const broken = ["", "name = ", "[[joint]]", "\u0000", "name = \"A\"\n[[joint]]\nname = \"eye\"\nbone = \"nowhere\"\n"];
  for (const toml of broken) await rejects(() => three.attach(gltf, { rig: { toml, file: "my.toml" } }));
});

test("files that are broken", async () => {
  const gltf = await load("mannequin.glb");
  const whole = bytesOf("mannequin.glb");
  for (const length of [0, 3, 12, 20, 1000, whole.byteLength >> 1, whole.byteLength - 1]) {
    await rejects(() => three.attach(gltf, { rig: { glb: whole.slice(0, length) } }));
  }
  await rejects(() => three.attach(gltf, { rig: { glb: new Uint8Array(1000).fill(120) } }));
  // Another character's file.
  const other = new TextEncoder().encode("glTF");
  await rejects(() => three.attach(gltf, { rig: { glb: other } }));
});

test("options that are wrong", async () => {
  for (const options of [{ behind: "sideways" }, { target: 7 }, { target: "me" }, { target: {} }]) {
    await rejects(() => core.attach(skeleton(), { rig: "vrm", ...options }));
  }
});

/** All bones, to see whether anything happened to them. */
const numbers = ({ locals }) => locals.flatMap((local) => [...local]);
const isFinite = (body) => numbers(body).every(Number.isFinite);

test("settings that are wrong are refused, and harm nothing", async () => {
  const body = skeleton();
  const gaze = await core.attach(body, { rig: "vrm", target: { x: 0.5, y: 1.5, z: 2 } });
  gaze.update(1 / 60);
  throws(() => { gaze.behind = "sideways"; });
  throws(() => { gaze.target = {}; });
  throws(() => { gaze.target = 7; });
  throws(() => { gaze.targets = 7; });
  throws(() => { gaze.targets = [{ target: { x: 0, y: 0, z: 1 }, weight: "half" }]; });
  throws(() => { gaze.targets = [null]; });
  throws(() => { gaze.targets = [{ weight: 1 }]; });
  throws(() => { gaze.targets = Array.from({ length: 17 }, () => ({ target: { x: 0, y: 1.5, z: 1 }, weight: 1 })); });
  throws(() => { gaze.on("arrived", () => {}); });
  throws(() => { gaze.on("reached", 7); });
  // Plain numbers, read in each frame.
  for (const [setting, was] of [["weight", 1], ["attention", 0], ["patience", Infinity]]) {
    for (const value of [NaN, -7, 1e9, "much", undefined, null]) {
      try {
        gaze[setting] = value;
        for (let i = 0; i < 5; i += 1) gaze.update(1 / 60);
      } catch (error) {
        assertPlain(error);
      }
      assert.ok(isFinite(body), `bones stay numbers with ${setting} ${value}`);
    }
    gaze[setting] = was;
  }
  for (const weight of [NaN, -1, Infinity]) {
    try {
      gaze.targets = [{ target: { x: 0.5, y: 1.5, z: 2 }, weight }];
      gaze.update(1 / 60);
    } catch (error) {
      assertPlain(error);
    }
    assert.ok(isFinite(body), `bones stay numbers with a target of weight ${weight}`);
  }
  gaze.target = { x: 0.5, y: 1.5, z: 2 };
  for (let i = 0; i < 120; i += 1) gaze.update(1 / 60);
  assert.ok(["reached", "on_the_way"].includes(gaze.status), gaze.status);
  gaze.targets = Array.from({ length: 16 }, () => ({ target: { x: 0, y: 1.5, z: 1 }, weight: 1 }));
  gaze.update(1 / 60);
  gaze.dispose();
});

test("times and places that are no numbers do no harm", async () => {
  const body = skeleton();
  const target = { x: 0.5, y: 1.5, z: 2 };
  const gaze = await core.attach(body, { rig: "vrm", target });
  const harmless = (act) => {
    try {
      act();
    } catch (error) {
      assertPlain(error);
    }
    assert.ok(isFinite(body), "bones stay numbers");
  };
  for (const dt of [NaN, -1, Infinity, -Infinity, undefined, null, "soon", 0, 1e9]) harmless(() => { gaze.update(dt); });
  for (const x of [NaN, Infinity, 1e30, undefined]) {
    target.x = x;
    harmless(() => { gaze.update(1 / 60); });
  }
  target.x = 0.5;
  // An animation that is broken for a frame.
  body.locals[5][3] = NaN;
  try {
    gaze.update(1 / 60);
  } catch (error) {
    assertPlain(error);
  }
  body.locals.forEach((local) => { local.set([0, 0, 0, 1], 3); });
  for (let i = 0; i < 120; i += 1) gaze.update(1 / 60);
  assert.ok(isFinite(body), "bones are numbers again");
  assert.equal(gaze.status, "reached");
  gaze.dispose();
});

test("callbacks that throw: their errors reach the caller, and the gaze goes on", async () => {
  const body = skeleton();
  let broken = false;
  const read = (...all) => {
    if (broken) throw new RangeError("mine");
    skeletonRead(...all);
  };
  const skeletonRead = body.read;
  const gaze = await core.attach({ ...body, read }, { rig: "vrm", target: { x: 0.5, y: 1.5, z: 2 } });
  broken = true;
  assert.throws(() => gaze.update(1 / 60), /mine/);
  broken = false;
  for (let i = 0; i < 60; i += 1) gaze.update(1 / 60);
  assert.equal(gaze.status, "reached");
  // From inside of a listener, a gaze can be disposed of.
  const off = gaze.on("lost", () => { gaze.dispose(); });
  assert.equal(typeof off, "function");
  gaze.target = null;
  for (let i = 0; i < 120; i += 1) {
    try {
      gaze.update(1 / 60);
    } catch (error) {
      assertPlain(error);
      break;
    }
  }
});

test("after dispose, calls say so, and bones are as the animation had them", async () => {
  const body = skeleton();
  const before = numbers(body);
  const gaze = await core.attach(body, { rig: "vrm", target: { x: 0.5, y: 1.5, z: 2 } });
  for (let i = 0; i < 30; i += 1) gaze.update(1 / 60);
  assert.notDeepEqual(numbers(body), before);
  gaze.dispose();
  assert.deepEqual(numbers(body), before);
  throws(() => { gaze.update(1 / 60); });
  throws(() => { gaze.snap(); });
  throws(() => { gaze.target = { x: 0, y: 0, z: 1 }; });
  throws(() => void gaze.remaining);
  try {
    gaze.dispose();
  } catch (error) {
    assertPlain(error);
  }
  assert.deepEqual(numbers(body), before);
});

test("targets of three that are none", async () => {
  const gltf = await load("mannequin.glb");
  for (const target of [{}, 7, "camera", { x: 1 }, [1, 2, 3]]) await rejects(() => three.attach(gltf, { target }));
  const gaze = await three.attach(gltf, { target: new Vector3(0, 1.6, 2) });
  throws(() => { gaze.target = {}; });
  gaze.update(1 / 60);
  gaze.dispose();
});
