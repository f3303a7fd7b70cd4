import assert from "node:assert/strict";
import { test } from "node:test";

import { VRMLoaderPlugin, VRMUtils } from "@pixiv/three-vrm";
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

import { GazeError } from "../../dist/index.js";
import { attach } from "../../dist/three-vrm.js";
import { angle, edited, mannequin, median, orbit } from "./support.mjs";

globalThis.self ??= globalThis;

/** three-vrm drops the lookAt of a VRM 1 that has no expressions. */
function withExpressions(glb) {
  return edited(glb, (json) => {
    json.extensions.VRMC_vrm.expressions ??= { preset: {} };
  });
}

const files = { 0: mannequin("--vrm0"), 1: withExpressions(mannequin("--vrm1")) };

async function load(bytes) {
  const loader = new GLTFLoader();
  loader.register((parser) => new VRMLoaderPlugin(parser));
  const gltf = await loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), "");
  return gltf.userData.vrm;
}

/** Judges an eye, or the head, by the world matrix of its raw bone. Made while the character is at rest where it was loaded. */
class Judge {
  constructor(vrm, bone) {
    this.node = vrm.humanoid.getRawBoneNode(bone);
    this.node.updateWorldMatrix(true, false);
    const front = new THREE.Vector3(0, 0, vrm.meta.metaVersion === "0" ? -1 : 1).transformDirection(vrm.scene.matrixWorld);
    this.forward = front.transformDirection(this.node.matrixWorld.clone().invert());
  }

  /** Degrees by which it misses. */
  miss(target) {
    this.node.updateWorldMatrix(true, false);
    const from = new THREE.Vector3().setFromMatrixPosition(this.node.matrixWorld);
    const forward = this.forward.clone().transformDirection(this.node.matrixWorld);
    return angle(forward.toArray(), target.clone().sub(from).toArray());
  }
}

/** Puts an avatar on its target, for three frames: what one has left is read by the next. */
function snapped(gaze, vrm) {
  for (let frame = 0; frame < 3; frame++) {
    gaze.snap();
    gaze.update(1 / 60);
    vrm.update(1 / 60);
  }
}

/** An animation of the normalised bones: the whole trunk sways, and the eyes wander a little. */
function swaying(vrm) {
  const times = Array.from({ length: 41 }, (_, at) => at / 10);
  const tracks = Object.entries({ hips: 0.1, spine: 0.05, chest: 0.06, neck: 0.08, head: 0.1, leftEye: 0.03, rightEye: 0.03 }).flatMap(
    ([name, most], at) => {
      const node = vrm.humanoid.getNormalizedBoneNode(name);
      if (!node) return [];
      const values = times.flatMap((time) => {
        const euler = new THREE.Euler(most * Math.sin(time + at), most * Math.cos(1.7 * time - at), 0.5 * most * Math.sin(2 * time));
        return new THREE.Quaternion().setFromEuler(euler).toArray();
      });
      return [new THREE.QuaternionKeyframeTrack(`${node.name}.quaternion`, times, values)];
    },
  );
  const mixer = new THREE.AnimationMixer(vrm.scene);
  mixer.clipAction(new THREE.AnimationClip("sway", 4, tracks)).play();
  return mixer;
}

const places = {
  "as loaded": () => {},
  "moved, turned and scaled": (scene) => {
    scene.position.set(3, -1, 2);
    scene.rotation.y += 2.2;
    scene.scale.setScalar(1.3);
  },
};

for (const version of [0, 1]) {
  for (const [how, put] of Object.entries(places)) {
    test(`VRM ${version}, ${how}: both eyes meet the target over an animation`, async () => {
      const vrm = await load(files[version]);
      const judges = ["leftEye", "rightEye"].map((bone) => new Judge(vrm, bone));
      const mixer = swaying(vrm);
      if (how === "as loaded" && version === 0) VRMUtils.rotateVRM0(vrm);
      put(vrm.scene);
      // The front is +Z in the world for VRM 1, and for VRM 0 once it is turned as above.
      const space = vrm.scene.clone(false);
      if (version === 0) space.rotateY(Math.PI);
      space.updateMatrixWorld(true);
      const target = new THREE.Object3D();
      const gaze = await attach(vrm, { target });
      const misses = [];
      for (let frame = 0; frame < 240; frame++) {
        target.position.fromArray(orbit(frame / 60)).applyMatrix4(space.matrixWorld);
        mixer.update(1 / 60);
        if (frame === 0) gaze.snap();
        gaze.update(1 / 60);
        vrm.update(1 / 60);
        for (const judge of judges) misses.push(judge.miss(target.position));
      }
      assert.equal(gaze.status, "reached");
      assert.ok(median(misses) <= 0.01, `median ${median(misses)}°`);
      gaze.dispose();
    });
  }
}

test("the other eye is left alone without bothEyes", async () => {
  const vrm = await load(files[1]);
  const judge = new Judge(vrm, "leftEye");
  const gaze = await attach(vrm, { target: new THREE.Vector3(0.1, 1.6, 0.5), bothEyes: false });
  gaze.snap();
  gaze.update(0.1);
  vrm.update(0.1);
  assert.ok(judge.miss(new THREE.Vector3(0.1, 1.6, 0.5)) < 0.01);
});

/** What VRM calls yaw (to the left) and pitch (down) of a rotation of the presented eye, degrees. */
function lookOf(quaternion, version) {
  const front = version === 0 ? -1 : 1;
  const { x, y, z } = new THREE.Vector3(0, 0, front).applyQuaternion(quaternion);
  return { yaw: (Math.atan2(front * x, front * z) * 180) / Math.PI, pitch: (Math.atan2(-y, Math.hypot(x, z)) * 180) / Math.PI };
}

const RANGES = { HorizontalInner: [30, 8], HorizontalOuter: [34, 12], VerticalDown: [22, 6], VerticalUp: [18, 9] };

/** A VRM with range maps of our own. */
function withRanges(version, ranges, kind = "bone") {
  return edited(files[version], (json) => {
    for (const [name, [input, output]] of Object.entries(ranges)) {
      if (version === 1) json.extensions.VRMC_vrm.lookAt[`rangeMap${name}`] = { inputMaxValue: input, outputScale: output };
      else json.extensions.VRM.firstPerson[`lookAt${name}`] = { curve: [0, 0, 0, 1, 1, 1, 1, 0], xRange: input, yRange: output };
    }
    if (kind === "bone") return;
    if (version === 1) {
      json.extensions.VRMC_vrm.lookAt.type = "expression";
      const preset = Object.fromEntries(["lookLeft", "lookRight", "lookUp", "lookDown"].map((name) => [name, {}]));
      json.extensions.VRMC_vrm.expressions = { preset };
    } else {
      json.extensions.VRM.firstPerson.lookAtTypeName = "BlendShape";
      json.extensions.VRM.blendShapeMaster.blendShapeGroups = ["lookleft", "lookright", "lookup", "lookdown"].map((name) => ({
        name,
        presetName: name,
        binds: [],
        materialValues: [],
      }));
    }
  });
}

function map([input, output], degrees) {
  return (output * Math.min(degrees, input)) / input;
}

/** Directions before a character that faces +Z. */
const directions = {
  "left and up": [0.25, 1.75, 0.9],
  "left and down": [0.25, 1.4, 0.9],
  "right and up": [-0.25, 1.75, 0.9],
  "right and down": [-0.25, 1.4, 0.9],
  "far left": [2, 1.6, 0.1],
  near: [0.02, 1.55, 0.25],
};

for (const version of [0, 1]) {
  for (const [where, point] of Object.entries(directions)) {
    const target = new THREE.Vector3(...point);
    if (version === 0) target.applyAxisAngle(new THREE.Vector3(0, 1, 0), Math.PI);

    test(`VRM ${version}: eye bones turn by the range maps of the file, ${where}`, async () => {
      const looks = [];
      for (const bytes of [files[version], withRanges(version, RANGES)]) {
        const vrm = await load(bytes);
        const gaze = await attach(vrm, { target });
        // More than once: what was written is remembered as it was meant.
        snapped(gaze, vrm);
        looks.push(["leftEye", "rightEye"].map((name) => lookOf(vrm.humanoid.getNormalizedBoneNode(name).quaternion, version)));
      }
      const [[...plain], [...mapped]] = looks;
      for (const [at, isLeft] of [[0, true], [1, false]]) {
        const { yaw, pitch } = plain[at];
        assert.ok(Math.abs(yaw) > 0.5 || where === "near", "the eyes look aside");
        const level = (isLeft ? yaw > 0 : yaw < 0) ? RANGES.HorizontalOuter : RANGES.HorizontalInner;
        const upright = pitch > 0 ? RANGES.VerticalDown : RANGES.VerticalUp;
        // The plain file's own maps are the identity up to the eye's range, a float's accuracy apart.
        assert.ok(Math.abs(mapped[at].yaw - Math.sign(yaw) * map(level, Math.abs(yaw))) < 1e-3, `yaw ${yaw} gave ${mapped[at].yaw}`);
        assert.ok(Math.abs(mapped[at].pitch - Math.sign(pitch) * map(upright, Math.abs(pitch))) < 1e-3, `pitch ${pitch}`);
      }
    });

    test(`VRM ${version}: expressions get their weights by the specification, ${where}`, async () => {
      const ranges = { HorizontalInner: [30, 0.3], HorizontalOuter: [40, 0.9], VerticalDown: [25, 0.7], VerticalUp: [20, 0.8] };
      const vrm = await load(withRanges(version, ranges, "expression"));
      assert.equal(vrm.lookAt.applier.constructor.type, "expression");
      const judge = vrm.lookAt.clone();
      const gaze = await attach(vrm, { target });
      snapped(gaze, vrm);
      // Where the target is for the head, from the point that the file says: three-vrm's own measure, in degrees.
      vrm.scene.updateMatrixWorld(true);
      judge.lookAt(target);
      const { yaw, pitch } = judge;
      const reach = { yaw: Math.min(Math.abs(yaw), 35), pitch: Math.min(Math.abs(pitch), pitch > 0 ? 25 : 20) };
      const side = map(ranges.HorizontalOuter, reach.yaw);
      const expected = {
        lookLeft: yaw > 0 ? side : 0,
        lookRight: yaw < 0 ? side : 0,
        lookUp: pitch < 0 ? map(ranges.VerticalUp, reach.pitch) : 0,
        lookDown: pitch > 0 ? map(ranges.VerticalDown, reach.pitch) : 0,
      };
      if (where !== "far left") assert.equal(gaze.status, "reached");
      for (const [name, weight] of Object.entries(expected)) {
        const given = vrm.expressionManager.getValue(name);
        assert.ok(Math.abs(given - weight) < (where === "far left" ? 0.05 : 2e-4), `${name}: ${given}, expected ${weight}`);
      }
      gaze.dispose();
      for (const name of Object.keys(expected)) assert.equal(vrm.expressionManager.getValue(name), 0);
    });
  }
}

test("an input maximum of nothing gives finite angles", async () => {
  const vrm = await load(withRanges(1, RANGES));
  vrm.lookAt.applier.rangeMapHorizontalOuter.inputMaxValue = 0;
  vrm.lookAt.applier.rangeMapVerticalUp.outputScale = 0;
  const gaze = await attach(vrm, { target: new THREE.Vector3(0.3, 1.8, 0.6) });
  for (let frame = 0; frame < 3; frame++) {
    gaze.update(1 / 60);
    vrm.update(1 / 60);
  }
  const eye = vrm.humanoid.getRawBoneNode("leftEye").quaternion.toArray();
  assert.ok(eye.every(Number.isFinite), `${eye}`);
});

for (const kind of ["bone", "expression"]) {
  test(`without a target, or with weight 0, the animation stays to the bit (${kind})`, async () => {
    const vrm = await load(withRanges(1, kind === "bone" ? RANGES : { HorizontalOuter: [40, 0.9] }, kind));
    const gaze = await attach(vrm, { weight: 0, target: new THREE.Vector3(0.5, 1.5, 1) });
    const eye = vrm.humanoid.getNormalizedBoneNode("leftEye");
    const head = vrm.humanoid.getNormalizedBoneNode("head");
    for (let frame = 0; frame < 10; frame++) {
      if (frame === 5) gaze.target = null;
      // The second is more than the maps of the bones give.
      eye.quaternion.setFromEuler(new THREE.Euler(0.1, frame % 2 ? 0.5 : 0.05, 0.02));
      head.quaternion.set(0, Math.fround(0.6), 0, Math.fround(0.8));
      vrm.expressionManager.setValue("lookLeft", 0.3);
      const before = eye.quaternion.toArray();
      gaze.update(1 / 60);
      vrm.update(1 / 60);
      if (kind === "bone") assert.deepEqual(eye.quaternion.toArray(), before);
      assert.deepEqual(head.quaternion.toArray(), [0, Math.fround(0.6), 0, Math.fround(0.8)]);
      if (kind === "expression") assert.equal(vrm.expressionManager.getValue("lookLeft"), 0.3);
    }
    gaze.dispose();
  });
}

test("an eye that is animated beyond its maps comes back without a jump", async () => {
  for (const point of [[0.1, 1.6, 1], [-0.4, 1.4, 1]]) {
    const vrm = await load(withRanges(1, RANGES));
    const eye = vrm.humanoid.getNormalizedBoneNode("leftEye");
    const gaze = await attach(vrm, { weight: 0, target: new THREE.Vector3(...point) });
    const yaws = [];
    for (let frame = 0; frame <= 100; frame++) {
      eye.quaternion.setFromEuler(new THREE.Euler(0.05, 0.5, 0.02));
      gaze.weight = frame / 100;
      gaze.snap();
      gaze.update(1 / 60);
      vrm.update(1 / 60);
      yaws.push(lookOf(eye.quaternion, 1).yaw);
    }
    assert.ok(Math.abs(yaws[0] - 0.5 * (180 / Math.PI)) < 0.1);
    const steps = yaws.slice(1).map((yaw, at) => Math.abs(yaw - yaws[at]));
    assert.ok(Math.max(...steps) < 2, `a step of ${Math.max(...steps)}°`);
  }
});

test("corrections do not add up on bones that nothing animates", async () => {
  const vrm = await load(withRanges(1, RANGES));
  const gaze = await attach(vrm, { target: new THREE.Vector3(0.4, 1.6, 1) });
  gaze.snap();
  gaze.update(1 / 60);
  vrm.update(1 / 60);
  const bones = ["leftEye", "rightEye", "neck", "upperChest"].map((name) => vrm.humanoid.getNormalizedBoneNode(name));
  const first = bones.map((bone) => bone.quaternion.toArray());
  for (let frame = 0; frame < 200; frame++) {
    gaze.update(1 / 60);
    vrm.update(1 / 60);
  }
  bones.forEach((bone, at) => bone.quaternion.toArray().forEach((number, i) => assert.ok(Math.abs(number - first[at][i]) < 1e-3)));
  gaze.dispose();
  for (const bone of bones) assert.deepEqual(bone.quaternion.toArray(), [0, 0, 0, 1]);
});

test("the avatar's own look-at rests while attached, and comes back", async () => {
  const vrm = await load(files[1]);
  const { applier } = vrm.lookAt;
  vrm.lookAt.target = new THREE.Object3D();
  const judge = new Judge(vrm, "leftEye");
  const target = new THREE.Vector3(0.3, 1.6, 1);
  const gaze = await attach(vrm, { target });
  assert.equal(vrm.lookAt.autoUpdate, false);
  gaze.snap();
  gaze.update(1 / 60);
  // The first one applies yaw 0 and pitch 0, unasked.
  vrm.update(1 / 60);
  assert.ok(judge.miss(target) < 0.01);
  gaze.dispose();
  assert.equal(vrm.lookAt.autoUpdate, true);
  assert.equal(vrm.lookAt.applier, applier);
});

test("where the avatar's own look-at has turned the eyes before counts for nothing", async () => {
  const vrm = await load(files[1]);
  vrm.lookAt.target = new THREE.Object3D();
  vrm.lookAt.target.position.set(1, 1.6, 1);
  vrm.scene.updateMatrixWorld(true);
  vrm.update(1 / 60);
  const eye = vrm.humanoid.getNormalizedBoneNode("leftEye").quaternion;
  assert.ok(Math.abs(eye.y) > 0.05);
  const gaze = await attach(vrm);
  gaze.update(1 / 60);
  vrm.update(1 / 60);
  assert.ok(Math.abs(eye.y) < 1e-9);
  gaze.dispose();
  vrm.update(1 / 60);
  assert.ok(Math.abs(eye.y) > 0.05);
});

test("two gazes on one avatar give its look-at back, whichever ends first", async () => {
  const vrm = await load(files[1]);
  const { applier } = vrm.lookAt;
  const [first, second] = await Promise.all([attach(vrm), attach(vrm)]);
  first.dispose();
  assert.equal(vrm.lookAt.autoUpdate, false);
  second.dispose();
  assert.equal(vrm.lookAt.autoUpdate, true);
  assert.equal(vrm.lookAt.applier, applier);
});

test("yaw and pitch set on the look-at count as the animation of the eyes", async () => {
  const plain = await load(files[1]);
  plain.lookAt.yaw = 12;
  plain.lookAt.pitch = -7;
  plain.update(0);
  const expected = plain.humanoid.getNormalizedBoneNode("leftEye").quaternion.toArray();
  const vrm = await load(files[1]);
  const gaze = await attach(vrm, { weight: 0, target: new THREE.Vector3(-1, 1.6, 1) });
  vrm.lookAt.yaw = 12;
  vrm.lookAt.pitch = -7;
  gaze.update(1 / 60);
  vrm.update(1 / 60);
  assert.deepEqual(vrm.humanoid.getNormalizedBoneNode("leftEye").quaternion.toArray(), expected);
});

test("raw bones may have any axes", async () => {
  for (const kind of ["bone", "expression"]) {
    const { 1: plain } = files;
    try {
      files[1] = withExpressions(mannequin("--vrm1", "+X", "-Z", "+Y"));
      const target = new THREE.Vector3(0.3, 1.7, 0.9);
      const vrm = await load(kind === "bone" ? files[1] : withRanges(1, {}, kind));
      const direction = vrm.lookAt.clone();
      const judge = new Judge(vrm, "rightEye");
      const gaze = await attach(vrm, { target });
      snapped(gaze, vrm);
      vrm.scene.updateMatrixWorld(true);
      if (kind === "bone") assert.ok(judge.miss(target) < 0.01, `misses by ${judge.miss(target)}°`);
      else {
        // As the file has it, 35° of the mannequin give a weight of 35, which is clamped: the direction shows in scaled maps only.
        for (const map of ["rangeMapHorizontalOuter", "rangeMapVerticalUp"]) {
          Object.assign(Object.getPrototypeOf(vrm.lookAt.applier)[map], { inputMaxValue: 90, outputScale: 0.9 });
        }
        gaze.snap();
        gaze.update(1 / 60);
        vrm.scene.updateMatrixWorld(true);
        direction.lookAt(target);
        const [left, up] = ["lookLeft", "lookUp"].map((name) => vrm.expressionManager.getValue(name));
        assert.ok(Math.abs(left - direction.yaw / 100) < 2e-4, `${left} for ${direction.yaw}°`);
        assert.ok(Math.abs(up + direction.pitch / 100) < 2e-4, `${up} for ${direction.pitch}°`);
      }
    } finally {
      files[1] = plain;
    }
  }
});

/** A VRM 1 without some bones. */
function without(...names) {
  return edited(files[1], (json) => {
    for (const name of names) delete json.extensions.VRMC_vrm.humanoid.humanBones[name];
  });
}

for (const [lacks, judged] of [
  [["neck"], "leftEye"],
  [["upperChest"], "leftEye"],
  [["upperChest", "chest"], "leftEye"],
  [["neck", "upperChest", "chest"], "leftEye"],
  [["leftEye"], "rightEye"],
  [["rightEye"], "leftEye"],
  [["leftEye", "rightEye"], "head"],
]) {
  test(`an avatar without ${lacks.join(", ")} looks`, async () => {
    const vrm = await load(without(...lacks));
    const judge = new Judge(vrm, judged);
    const target = new THREE.Vector3(0.4, 1.6, 1);
    const gaze = await attach(vrm, { target });
    gaze.snap();
    gaze.update(1 / 60);
    vrm.update(1 / 60);
    assert.equal(gaze.status, "reached");
    assert.ok(judge.miss(target) < 0.01, `misses by ${judge.miss(target)}°`);
    gaze.dispose();
  });
}

test("wrong input says what to do", async () => {
  await assert.rejects(attach(undefined), GazeError);
  await assert.rejects(attach({}), GazeError);
  await assert.rejects(attach({ userData: { vrm: {} }, scene: {} }), (error) => error instanceof GazeError && /userData\.vrm/.test(error.message));
  const vrm = await load(files[1]);
  vrm.humanoid.autoUpdateHumanBones = false;
  await assert.rejects(attach(vrm), (error) => error instanceof GazeError && /autoUpdateHumanBones/.test(error.message));
  vrm.humanoid.autoUpdateHumanBones = true;
  await assert.rejects(attach(vrm, { rig: { glb: files[1] } }), GazeError);
});
