import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { before, test } from "node:test";

import { VRMLoaderPlugin } from "@pixiv/three-vrm";
import { act, Component, createElement, useState } from "react";
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { clone } from "three/addons/utils/SkeletonUtils.js";

import { GazeError } from "../../dist/index.js";
import { usage } from "../../dist/load.js";
import { angle, mannequin } from "./support.mjs";

globalThis.self ??= globalThis;
globalThis.IS_REACT_ACT_ENVIRONMENT = true;

// react-three-fiber keeps the console's function when it is loaded.
let isQuiet = false;
const { error } = console;
console.error = (...words) => isQuiet || error(...words);
const { createRoot, flushSync } = await import("@react-three/fiber");
const { useGaze } = await import("../../dist/react.js");

let original;
before(async () => {
  const bytes = mannequin();
  original = (await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), "")).scene;
});

const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** A root of react-three-fiber without a screen; `frame` runs one frame. */
async function stage() {
  const canvas = { style: {}, addEventListener() {}, removeEventListener() {}, getBoundingClientRect: () => ({}), width: 64, height: 64 };
  const gl = {
    render() {},
    setPixelRatio() {},
    setSize() {},
    dispose() {},
    forceContextLoss() {},
    shadowMap: {},
    xr: { addEventListener() {}, removeEventListener() {}, setAnimationLoop() {} },
    domElement: canvas,
  };
  const root = createRoot(canvas);
  let store;
  await root.configure({
    gl: () => gl,
    size: { width: 64, height: 64, top: 0, left: 0 },
    frameloop: "never",
    onCreated: (state) => {
      store = state;
    },
  });
  let time = 0;
  return {
    render: (element) => act(async () => void root.render(element)),
    unmount: () => act(async () => void root.unmount()),
    /** Until `is` gives something true, which it soon does. */
    async until(is) {
      for (const end = Date.now() + 20_000; !is() && Date.now() < end; ) await act(() => pause(20));
    },
    /** For long enough that everything is attached that is going to be. */
    settle: () => act(() => pause(300)),
    frame: () => act(async () => void store.advance((time += 1 / 60))),
  };
}

/** What the hook gave in each rendering. */
function probe() {
  const seen = [];
  function Probe({ source, options }) {
    seen.push(useGaze(source, options));
    return null;
  }
  return { Probe, seen, get last() { return seen.at(-1); } };
}

function eyeOf(scene) {
  let eye;
  scene.traverse((node) => {
    if (/eye/i.test(node.name)) eye ??= node;
  });
  return eye;
}

/** Degrees by which an eye that faced +Z at rest misses. */
function judgeOf(scene) {
  const eye = eyeOf(scene);
  eye.updateWorldMatrix(true, false);
  const forward = new THREE.Vector3(0, 0, 1).transformDirection(eye.matrixWorld.clone().invert());
  return (target) => {
    eye.updateWorldMatrix(true, false);
    const from = new THREE.Vector3().setFromMatrixPosition(eye.matrixWorld);
    return angle(forward.clone().transformDirection(eye.matrixWorld).toArray(), target.clone().sub(from).toArray());
  };
}

const isDisposed = (gaze) => {
  try {
    gaze.update(0);
    return false;
  } catch (error) {
    assert.ok(error instanceof GazeError);
    return true;
  }
};

test("attaches, runs each frame, and lets go on unmounting", async () => {
  const scene = clone(original);
  const miss = judgeOf(scene);
  const target = new THREE.Vector3(0.3, 1.6, 1.2);
  const { render, until, frame, unmount } = await stage();
  const hook = probe();
  await render(createElement(hook.Probe, { source: null, options: { target } }));
  assert.equal(hook.last, null);
  await frame();
  await render(createElement(hook.Probe, { source: scene, options: { target } }));
  await until(() => hook.last);
  const gaze = hook.last;
  assert.ok(gaze);
  gaze.snap();
  await frame();
  assert.ok(miss(target) < 0.01, `misses by ${miss(target)}°`);
  await unmount();
  assert.ok(isDisposed(gaze));
});

test("sets target, weight and attention without attaching anew", async () => {
  const scene = clone(original);
  const { render, until, settle, frame, unmount } = await stage();
  const hook = probe();
  const first = new THREE.Vector3(0.3, 1.6, 1.2);
  const ref = { current: new THREE.Object3D() };
  ref.current.position.set(-0.2, 1.5, 1);
  const show = (options) => render(createElement(hook.Probe, { source: scene, options }));
  await show({ target: first, weight: 0.5, rig: "measure" });
  await until(() => hook.last);
  const gaze = hook.last;
  assert.equal(gaze.target, first);
  assert.equal(gaze.weight, 0.5);
  await show({ target: ref, weight: 1, attention: 0.25, rig: "measure" });
  await frame();
  assert.equal(hook.last, gaze);
  assert.equal(gaze.target, ref.current);
  assert.equal(gaze.weight, 1);
  assert.equal(gaze.attention, 0.25);
  ref.current = new THREE.Object3D();
  await frame();
  assert.equal(gaze.target, ref.current);
  await show({ target: null });
  await settle();
  assert.equal(hook.last.target, null);
  // By hand it stays as it is while the option does not change.
  hook.last.weight = 0.125;
  await show({ target: null });
  await frame();
  assert.equal(hook.last.weight, 0.125);
  await unmount();
});

test("a rig that is written out in rendering is not another one each time", async () => {
  const toml = readFileSync(new URL("../../../../rigs/mannequin.toml", import.meta.url), "utf8");
  const scene = clone(original);
  const { render, until, settle, unmount } = await stage();
  const hook = probe();
  await render(createElement(hook.Probe, { source: scene, options: { rig: { toml } } }));
  await until(() => hook.last);
  const gaze = hook.last;
  await render(createElement(hook.Probe, { source: scene, options: { rig: { toml } } }));
  await settle();
  assert.ok(gaze);
  assert.equal(hook.last, gaze);
  await unmount();
});

test("attaches a VRM on its normalised bones", async () => {
  const bytes = mannequin("--vrm1");
  const loader = new GLTFLoader();
  loader.register((parser) => new VRMLoaderPlugin(parser));
  const gltf = await loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), "");
  const { vrm } = gltf.userData;
  const miss = judgeOf(vrm.scene);
  const target = new THREE.Vector3(0.3, 1.6, 1.2);
  const { render, until, frame, unmount } = await stage();
  const hook = probe();
  await render(createElement(hook.Probe, { source: vrm, options: { target } }));
  await until(() => hook.last);
  hook.last.snap();
  await frame();
  vrm.update(0);
  assert.ok(miss(target) < 0.01, `misses by ${miss(target)}°`);
  await unmount();
});

test("attaches anew when the source or the rig changes, and lets the old one go", async () => {
  const [one, other] = [clone(original), clone(original)];
  const { render, until, frame, unmount } = await stage();
  const hook = probe();
  await render(createElement(hook.Probe, { source: one }));
  await until(() => hook.last);
  const first = hook.last;
  await render(createElement(hook.Probe, { source: other }));
  await frame();
  await until(() => hook.last && hook.last !== first);
  const second = hook.last;
  assert.ok(second && second !== first);
  assert.ok(isDisposed(first));
  await render(createElement(hook.Probe, { source: null }));
  await frame();
  assert.equal(hook.last, null);
  assert.ok(isDisposed(second));
  await unmount();
});

test("what is let go while it is being attached leaves nothing behind", async () => {
  const scene = clone(original);
  const eye = eyeOf(scene);
  const rest = eye.quaternion.toArray();
  const { live } = usage();
  const { render, until, settle, frame, unmount } = await stage();
  const hook = probe();
  const options = { target: new THREE.Vector3(0.2, 1.6, 1) };
  let show;
  function Switch() {
    const [source, setSource] = useState(null);
    show = (source) => flushSync(() => setSource(source));
    return createElement(hook.Probe, { source, options });
  }
  await render(createElement(Switch));
  // Effects run at once, and attaching takes longer: on and off, and then, as in StrictMode, on, off and on.
  await act(async () => {
    show(scene);
    show(null);
  });
  await settle();
  await frame();
  assert.ok(hook.seen.every((gaze) => gaze === null));
  assert.deepEqual(eye.quaternion.toArray(), rest);
  assert.equal(usage().live, live, "memory is freed");
  await act(async () => {
    show(scene);
    show(null);
    show(scene);
  });
  await until(() => hook.last);
  await settle();
  await frame();
  const gazes = new Set(hook.seen.filter(Boolean));
  assert.equal(gazes.size, 1);
  assert.ok(!isDisposed(hook.last));
  await unmount();
  assert.ok(isDisposed(hook.last));
  assert.equal(usage().live, live, "memory is freed");
});

test("what attaching throws reaches an error boundary", async () => {
  let caught;
  class Boundary extends Component {
    state = {};
    static getDerivedStateFromError = (error) => ({ error });
    componentDidCatch(error) {
      caught = error;
    }
    render() {
      return this.state.error ? null : this.props.children;
    }
  }
  const { render, until, unmount } = await stage();
  const hook = probe();
  isQuiet = true;
  try {
    await render(createElement(Boundary, null, createElement(hook.Probe, { source: new THREE.Object3D() })));
    await until(() => caught);
  } finally {
    isQuiet = false;
  }
  assert.ok(caught instanceof GazeError);
  await unmount();
});
