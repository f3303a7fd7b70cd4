import assert from "node:assert/strict";
import { test } from "node:test";

import { AnimationClip, AnimationMixer, Object3D, Quaternion, QuaternionKeyframeTrack, Vector3 } from "three";

import { GazeError } from "../../dist/index.js";
import { attach } from "../../dist/three.js";

/** A figure with a neck and eyes, which faces +Z. */
function figure({ joint = (name) => ({ name }) } = {}) {
  const root = new Object3D();
  let on = root;
  for (const [name, height] of [["Hips", 1], ["Spine2", 0.3], ["Neck", 0.25], ["LeftEye", 0.15]]) {
    const bone = Object.assign(new Object3D(), joint(name));
    bone.position.y = height;
    on.add(bone);
    if (name !== "LeftEye") on = bone;
  }
  const right = Object.assign(new Object3D(), joint("RightEye"));
  right.position.set(-0.06, 0.15, 0);
  on.add(right);
  on.children[0].position.x = 0;
  return root;
}

const bone = (root, name) => root.getObjectByName(name);
const aside = new Vector3(2, 1.6, 1.5);

test("a mixer that starts and stops actions leaves no correction behind, if the bones are restored first", async () => {
  const root = figure();
  const neck = bone(root, "Neck");
  const gaze = await attach(root, { rig: "mixamo", target: aside });
  const mixer = new AnimationMixer(root);
  const nod = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), 0.1).toArray();
  const clip = new AnimationClip("nod", 1, [new QuaternionKeyframeTrack("Neck.quaternion", [0, 1], [...nod, ...nod])]);
  let turned = 0;
  for (let round = 0; round < 6; round += 1) {
    for (let frame = 0; frame < 90; frame += 1) {
      gaze.restore();
      if (frame === 0) mixer.clipAction(clip).reset().fadeIn(0.2).play();
      if (frame === 60) mixer.clipAction(clip).fadeOut(0.2);
      if (frame === 80) mixer.clipAction(clip).stop();
      mixer.update(1 / 60);
      gaze.update(1 / 60);
    }
    const angle = neck.quaternion.angleTo(new Quaternion());
    if (round > 0) assert.ok(Math.abs(angle - turned) < 0.01, `${angle} after ${turned} in round ${round}`);
    turned = angle;
  }
  assert.ok(turned > 0.1, "it looks aside");
  gaze.dispose();
  assert.ok(neck.quaternion.angleTo(new Quaternion()) < 1e-6);
});

test("of two gazes on one character the second is refused when it would turn", async () => {
  const root = figure();
  const first = await attach(root, { rig: "mixamo", target: aside });
  first.update(1 / 60);
  const second = await attach(root, { rig: "mixamo", target: new Vector3(-2, 1.6, 1.5) });
  assert.throws(() => second.update(1 / 60), (error) => error instanceof GazeError && /another gaze.*dispose/.test(error.message));
  first.dispose();
  second.update(1 / 60);
  second.dispose();
});

test("names of files count where loaders have changed them", async () => {
  for (const key of ["name", "originalName"]) {
    const root = figure({ joint: (name) => ({ name: `mixamorig${name}`, userData: { [key]: `mixamorig:${name}` } }) });
    const gaze = await attach(root, { rig: "mixamo", target: aside });
    assert.equal(gaze.joints.length, 3);
    gaze.dispose();
  }
});

test("a preset whose names fit, and whose axes do not, is refused", async () => {
  const root = figure();
  // As if it looked along +X at rest: the neck is turned, and the eyes are not.
  bone(root, "Neck").quaternion.setFromAxisAngle(new Vector3(0, 1, 0), 1.4);
  bone(root, "LeftEye").quaternion.setFromAxisAngle(new Vector3(0, 1, 0), -1.4);
  await assert.rejects(attach(root, { rig: "mixamo" }), /other axes.*"measure"/);
});

test("a target that is no place holds the character, and is not reached", async () => {
  const root = figure();
  const gaze = await attach(root, { rig: "mixamo", target: aside.clone() });
  for (let frame = 0; frame < 60; frame += 1) gaze.update(1 / 60);
  assert.equal(gaze.status, "reached");
  const before = bone(root, "Neck").quaternion.toArray();
  let reached = 0;
  gaze.on("reached", () => (reached += 1));
  gaze.target = new Vector3(NaN, 0, 0);
  gaze.update(1 / 60);
  assert.equal(gaze.status, "degenerate");
  assert.deepEqual(bone(root, "Neck").quaternion.toArray(), before);
  assert.equal(reached, 0);
  assert.throws(() => (gaze.target = undefined), GazeError);
  gaze.dispose();
});

test("a chain is as long as the solvers have room for", async () => {
  const root = new Object3D();
  let on = root;
  for (let at = 0; at < 40; at += 1) {
    const next = Object.assign(new Object3D(), { name: at < 30 ? `spine${at}` : at < 39 ? `neck${at}` : "head" });
    next.position.y = 0.1;
    on.add(next);
    on = next;
  }
  const gaze = await attach(root, { rig: "measure", target: new Vector3(1, 4, 8) });
  assert.ok(gaze.joints.length <= 16, `${gaze.joints.length} joints`);
  for (let frame = 0; frame < 120; frame += 1) gaze.update(1 / 60);
  assert.equal(gaze.status, "reached");
  const toml = ["name = 'Snake'", "axes = { up = '+Y', forward = '+Z' }"];
  for (let at = 0; at < 17; at += 1) toml.push(`[[joint]]\nname = 'j${at}'\nbone = 'spine${29 - at}'\nheading = ['-5deg', '5deg']\nrate = '9deg'`);
  await assert.rejects(attach(root, { rig: { toml: toml.join("\n") } }), /17 joints.*16 at most/);
  await assert.rejects(attach(root, { rig: { toml: "", file: 7 } }), GazeError);
});
