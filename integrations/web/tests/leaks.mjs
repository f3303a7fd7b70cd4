// Memory: node --expose-gc --test tests/leaks.mjs, in a folder that has the package installed.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { setTimeout } from "node:timers/promises";
import { pathToFileURL } from "node:url";
import { attach } from "aim-gaze";
import { attach as attachThree } from "aim-gaze/three";
import { app, load, skeleton } from "./node.mjs";

// Not public: of the modules that are loaded, the bytes of their memories, and of those the bytes that are allocated.
const { usage } = await import(pathToFileURL(join(app, "node_modules/aim-gaze/dist/load.js")));
const HEAP = 64 * 1024;

assert.equal(typeof globalThis.gc, "function", "node needs --expose-gc");
/** After a forced collection, and what finalizers do after it. */
async function settled() {
  for (let round = 0; round < 4; round += 1) {
    globalThis.gc();
    await setTimeout(5);
  }
  return { heap: process.memoryUsage().heapUsed, ...usage() };
}

/**
 * Nothing is left of what is done once more after it was done often enough to be compiled. Node's heap grows for reasons of its
 * own now and then: a leak grows in each of three rounds.
 */
async function leavesNothing(name, warmUp, run) {
  await warmUp();
  await warmUp();
  const heaps = [];
  for (let round = 0; round < 3 && !heaps.some((heap) => heap <= HEAP); round += 1) {
    const before = await settled();
    await run();
    const after = await settled();
    heaps.push(after.heap - before.heap);
    console.log(`  ${name}: ${before.bytes} → ${after.bytes} bytes of WebAssembly, ${before.live} → ${after.live} of them allocated, ` +
      `heap ${after.heap - before.heap} bytes more`);
    assert.ok(before.bytes > 0 && before.live > 0, "nothing is counted");
    assert.equal(after.bytes, before.bytes, "the memory of WebAssembly grows");
    assert.equal(after.live, before.live, "what was allocated is left");
  }
  assert.ok(heaps.some((heap) => heap <= HEAP), `${heaps} bytes of the heap are left, round by round`);
}

// One that lives on, so that something is always allocated.
const bystander = await attach(skeleton(), { rig: "vrm" });

const target = { x: 0, y: 1.6, z: 2 };
function follow(gaze, updates) {
  for (let i = 0; i < updates; i += 1) {
    target.x = Math.sin(0.02 * i);
    gaze.update(1 / 60);
  }
}

test("100 000 updates, with all that is read of a gaze", async () => {
  const gaze = await attach(skeleton(), { rig: "vrm", target });
  let heard = 0;
  const off = gaze.on("reached", () => { heard += 1; });
  const run = (updates) => async () => {
    for (let i = 0; i < updates; i += 1000) {
      follow(gaze, 1000);
      // Read by users in every frame, and settings set to what they are.
      for (let j = 0; j < 10; j += 1) void [gaze.status, gaze.remaining, gaze.bodyTurn, gaze.outOfReachFor, gaze.joints.length];
      gaze.weight = 0.5;
      gaze.weight = 1;
      gaze.targets = [{ target, weight: 1 }, { target: { x: 1, y: 1.5, z: 2 }, weight: 1 }];
      follow(gaze, 10);
      gaze.target = target;
      gaze.snap();
    }
  };
  await leavesNothing("updates", run(20_000), run(100_000));
  off();
  gaze.dispose();
});

test("1 000 times attach and dispose", async () => {
  const run = (times) => async () => {
    for (let i = 0; i < times; i += 1) {
      const gaze = await attach(skeleton(), { rig: "vrm", target });
      gaze.on("reached", () => {});
      follow(gaze, 3);
      gaze.dispose();
    }
  };
  await leavesNothing("attach and dispose", run(300), run(1000));
});

test("measured characters, and what cannot be attached", async () => {
  const gltf = await load("mannequin.glb");
  const place = gltf.scene.position.clone().set(0.2, 1.6, 2);
  const run = (times) => async () => {
    for (let i = 0; i < times; i += 1) {
      const gaze = await attachThree(gltf, { rig: "measure", target: place });
      gaze.update(1 / 60);
      gaze.dispose();
      await assert.rejects(attachThree(gltf, { rig: { toml: "name = " } }));
    }
  };
  await leavesNothing("measure and dispose", run(10), run(40));
});

test("the one that lived on still does", () => {
  bystander.update(1 / 60);
  assert.equal(bystander.status, "no_target");
  bystander.dispose();
});
