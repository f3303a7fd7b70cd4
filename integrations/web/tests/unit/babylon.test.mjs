import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { NullEngine } from "@babylonjs/core/Engines/nullEngine.js";
import { ImportMeshAsync, LoadAssetContainerAsync } from "@babylonjs/core/Loading/sceneLoader.js";
import { Matrix, Quaternion, Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { TransformNode } from "@babylonjs/core/Meshes/transformNode.js";
import { Logger } from "@babylonjs/core/Misc/logger.js";
import { Scene } from "@babylonjs/core/scene.js";
import "@babylonjs/loaders/glTF/2.0/index.js";

import { attach } from "../../dist/babylon.js";
import { GazeError } from "../../dist/index.js";
import { angle, mannequin, median, orbit } from "./support.mjs";

Logger.LogLevels = Logger.WarningLogLevel | Logger.ErrorLogLevel;

const glb = mannequin("--moves");
const toml = readFileSync(new URL("../../../../rigs/mannequin.toml", import.meta.url), "utf8");

/** A scene of either handedness with the mannequin. */
async function load(isRightHanded, { isContainer = true } = {}) {
  const scene = new Scene(new NullEngine());
  scene.useRightHandedSystem = isRightHanded;
  new FreeCamera("camera", new Vector3(0, 1.5, 3), scene);
  const options = { pluginExtension: ".glb" };
  const source = `data:;base64,${Buffer.from(glb).toString("base64")}`;
  const loaded = isContainer ? await LoadAssetContainerAsync(source, scene, options) : await ImportMeshAsync(source, scene, options);
  return { scene, loaded };
}

const nodeOf = (nodes, end) => nodes.find(({ name }) => name.endsWith(end));

/** Judges an eye by the world matrix of its node. Made while the character is at rest: it faces +Z in both handednesses. */
class Judge {
  constructor(node) {
    this.node = node;
    this.forward = Vector3.TransformNormal(new Vector3(0, 0, 1), Matrix.Invert(this.node.computeWorldMatrix(true)));
  }

  /** Degrees by which it misses. */
  miss(target) {
    const world = this.node.computeWorldMatrix(true);
    const forward = Vector3.TransformNormal(this.forward, world);
    return angle(forward.asArray(), target.subtract(world.getTranslation()).asArray());
  }
}

function eyesOf(root) {
  const nodes = root.getDescendants();
  const eyes = nodes.filter(({ name }) => /eye/i.test(name) && nodes.length > 0);
  assert.equal(eyes.length, 2, `two eyes: ${eyes.map(({ name }) => name)}`);
  return eyes;
}

const places = {
  "as loaded": () => Matrix.Identity(),
  "below a node that is moved, turned and scaled": (root, scene) => {
    const above = new TransformNode("above", scene);
    above.position.set(2, -1, 3);
    above.rotation.set(0, 1.9, 0);
    above.scaling.setAll(0.6);
    root.parent = above;
    return above.computeWorldMatrix(true).clone();
  },
};

for (const isRightHanded of [false, true]) {
  for (const [how, put] of Object.entries(places)) {
    test(`${isRightHanded ? "right" : "left"}-handed, ${how}: both eyes meet the target over an animation`, async () => {
      const { scene, loaded } = await load(isRightHanded);
      loaded.addAllToScene();
      const root = loaded.rootNodes.find(({ name }) => name === "__root__");
      const judges = eyesOf(root).map((eye) => new Judge(eye));
      const space = put(root, scene);
      const target = new TransformNode("target", scene);
      const gaze = await attach(loaded, { target });
      const group = loaded.animationGroups.find(({ name }) => name === "walk");
      group.start(true);
      group.pause();
      let frame = 0;
      scene.onAfterAnimationsObservable.add(() => {
        if (frame === 0) gaze.snap();
        gaze.update(1 / 60);
      });
      const misses = [];
      for (; frame < 240; frame++) {
        group.goToFrame(group.from + ((group.to - group.from) * (frame % 60)) / 60);
        Vector3.TransformCoordinatesToRef(Vector3.FromArray(orbit(frame / 60)), space, target.position);
        scene.render();
        for (const judge of judges) misses.push(judge.miss(target.position));
      }
      assert.equal(gaze.status, "reached");
      assert.ok(median(misses) <= 0.01, `median ${median(misses)}°`);
      gaze.dispose();
    });
  }
}

for (const isRightHanded of [false, true]) {
  test(`${isRightHanded ? "right" : "left"}-handed: the skin tells how it stands, where it is attached while it moves`, async () => {
    const { scene, loaded } = await load(isRightHanded);
    loaded.addAllToScene();
    const judge = new Judge(eyesOf(loaded.rootNodes[0])[0]);
    const group = loaded.animationGroups.find(({ name }) => name === "walk");
    group.start(true);
    group.goToFrame((group.from + group.to) / 3);
    group.pause();
    scene.render();
    const target = new Vector3(0.3, 1.5, 1.5);
    const gaze = await attach(loaded, { target });
    const misses = [];
    scene.onAfterAnimationsObservable.add(() => {
      gaze.snap();
      gaze.update(1 / 60);
    });
    for (let frame = 0; frame < 60; frame++) {
      group.goToFrame(group.from + ((group.to - group.from) * frame) / 60);
      scene.render();
      misses.push(judge.miss(target));
    }
    assert.ok(median(misses) <= 0.01, `median ${median(misses)}°`);
  });
}

for (const [how, sourceOf] of Object.entries({
  "what ImportMeshAsync gives": ({ loaded }) => loaded,
  "its root": ({ loaded }) => loaded.meshes[0],
  "a node above it": ({ loaded, scene }) => {
    const above = new TransformNode("above", scene);
    above.rotation.y = 0.4;
    loaded.meshes[0].parent = above;
    return above;
  },
})) {
  test(`attaches ${how}; targets may be meshes, cameras and points`, async () => {
    const given = await load(false, { isContainer: false });
    const { scene, loaded } = given;
    loaded.animationGroups.forEach((group) => group.stop());
    const judge = new Judge(eyesOf(loaded.meshes[0])[0]);
    const gaze = await attach(sourceOf(given));
    const camera = scene.activeCamera;
    camera.position.set(-0.2, 1.6, 2);
    for (const target of [camera, new Vector3(0.3, 1.5, 1.5)]) {
      gaze.target = target;
      gaze.snap();
      gaze.update(1 / 60);
      assert.ok(judge.miss(target.position ?? target) < 0.01, `misses by ${judge.miss(target.position ?? target)}°`);
    }
    gaze.dispose();
  });
}

test("attaches a clone of a container's character, whose names have a prefix", async () => {
  const { scene, loaded } = await load(false);
  for (const rename of [undefined, (name) => `second ${name}`]) {
    const clone = loaded.instantiateModelsToScene(rename);
    const judge = new Judge(eyesOf(clone.rootNodes[0])[0]);
    const target = new Vector3(0.3, 1.5, 1.5);
    // Declared rigs find bones by their full names.
    const gaze = await attach(clone, { target, rig: { toml } });
    gaze.snap();
    gaze.update(1 / 60);
    assert.equal(gaze.status, "reached");
    assert.ok(judge.miss(target) < 0.01, `misses by ${judge.miss(target)}°`);
    assert.ok(scene.meshes.length > 0);
  }
});

test("nodes with Euler angles are read as they turn", async () => {
  const { loaded } = await load(true);
  loaded.addAllToScene();
  const [root] = loaded.rootNodes;
  const nodes = root.getDescendants();
  const neck = nodeOf(nodes, "neck");
  const judge = new Judge(eyesOf(root)[0]);
  const target = new Vector3(0.3, 1.5, 1.5);
  const gaze = await attach(loaded);
  const animated = neck.rotationQuaternion.multiply(Quaternion.FromEulerAngles(0.1, 0.2, -0.15));
  neck.rotation = animated.toEulerAngles();
  assert.equal(neck.rotationQuaternion, null);
  gaze.update(1 / 60);
  const { x, y, z, w } = neck.rotationQuaternion ?? neck.rotation.toQuaternion();
  const sign = Math.sign(w * animated.w);
  [x, y, z, w].forEach((number, at) => assert.ok(Math.abs(sign * number - animated.asArray()[at]) < 1e-5, "kept without a target"));
  neck.rotation = animated.toEulerAngles();
  gaze.target = target;
  gaze.snap();
  gaze.update(1 / 60);
  assert.ok(judge.miss(target) < 0.01, `misses by ${judge.miss(target)}°`);
});

test("dispose puts the bones back", async () => {
  const { loaded } = await load(false);
  loaded.addAllToScene();
  const nodes = loaded.rootNodes[0].getDescendants().filter(({ rotationQuaternion }) => rotationQuaternion);
  const before = nodes.map(({ rotationQuaternion }) => rotationQuaternion.asArray().map(Math.fround));
  const gaze = await attach(loaded, { target: new Vector3(0.3, 1.5, 1.5) });
  for (let frame = 0; frame < 20; frame++) gaze.update(1 / 60);
  const during = nodes.map(({ rotationQuaternion }) => rotationQuaternion.asArray().map(Math.fround));
  assert.notDeepEqual(during, before);
  gaze.dispose();
  const after = nodes.map(({ rotationQuaternion }) => rotationQuaternion.asArray().map(Math.fround));
  assert.deepEqual(after, before);
});

test("wrong input says what to do", async () => {
  await assert.rejects(attach(null), GazeError);
  await assert.rejects(attach({}), GazeError);
  const { scene, loaded } = await load(false);
  await assert.rejects(attach(new TransformNode("nothing", scene)), GazeError);
  const [one, two] = [loaded.instantiateModelsToScene(), loaded.instantiateModelsToScene()];
  await assert.rejects(attach({ meshes: [...one.rootNodes, ...two.rootNodes] }), (error) => error instanceof GazeError && /one/.test(error.message));
  const above = new TransformNode("above", scene);
  one.rootNodes[0].parent = above;
  two.rootNodes[0].parent = above;
  await assert.rejects(attach(above), GazeError);
  const gaze = await attach(one, { target: /** @type {any} */ ({}) }).catch((error) => error);
  if (gaze instanceof Error) assert.ok(gaze instanceof GazeError);
  else assert.throws(() => gaze.update(1 / 60), GazeError);
});
