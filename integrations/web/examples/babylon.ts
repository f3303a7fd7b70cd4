// Babylon.js, in its usual left-handed scene: a character walks on the spot and looks at a ball that circles it.
import { attach } from "aim-gaze/babylon";
import { ArcRotateCamera } from "@babylonjs/core/Cameras/arcRotateCamera.js";
import { Engine } from "@babylonjs/core/Engines/engine.js";
import { HemisphericLight } from "@babylonjs/core/Lights/hemisphericLight.js";
import { LoadAssetContainerAsync } from "@babylonjs/core/Loading/sceneLoader.js";
import { StandardMaterial } from "@babylonjs/core/Materials/standardMaterial.js";
import { Color3, Color4 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { CreateSphere } from "@babylonjs/core/Meshes/Builders/sphereBuilder.js";
import { Scene } from "@babylonjs/core/scene.js";
import "@babylonjs/loaders/glTF/2.0/index.js";

const canvas = document.createElement("canvas");
document.body.append(canvas);
const engine = new Engine(canvas, true);
const scene = new Scene(engine);
scene.clearColor = new Color4(0.85, 0.87, 0.83, 1);
const light = new HemisphericLight("light", new Vector3(0.4, 1, 0.6), scene);
light.intensity = 1.2;

const file = new URLSearchParams(location.search).get("model") ?? "models/mannequin.glb";
const character = await LoadAssetContainerAsync(file, scene);
character.addAllToScene();
character.animationGroups.forEach((group) => group.stop());
(character.animationGroups.find(({ name }) => name === "walk") ?? character.animationGroups[0])?.start(true);

// In a left-handed scene a glTF character faces +Z as well: its root mirrors it. The camera stands in front.
const camera = new ArcRotateCamera("camera", Math.PI / 2, 1.5, 2.4, new Vector3(0, 1.5, 0), scene);
camera.fov = 0.55;
camera.minZ = 0.05;
camera.attachControl(canvas, true);

const ball = CreateSphere("ball", { diameter: 0.06 }, scene);
const red = new StandardMaterial("red", scene);
red.diffuseColor = new Color3(0.8, 0.2, 0.1);
ball.material = red;

const gaze = await attach(character, { target: ball });
gaze.behind = "release"; // behind its back the ball is let go, and taken up again on the other side

const status = document.querySelector("output");
let seconds = 0;
scene.onBeforeAnimationsObservable.add(() => {
  seconds += engine.getDeltaTime() / 1000;
  ball.position.set(0.8 * Math.sin(0.7 * seconds), 1.6 + 0.25 * Math.sin(1.1 * seconds), 0.8 * Math.cos(0.7 * seconds));
});
// After the animation, before bones are handed to the meshes.
scene.onAfterAnimationsObservable.add(() => {
  gaze.update(engine.getDeltaTime() / 1000);
  if (status) status.value = gaze.status;
});
engine.runRenderLoop(() => scene.render());
addEventListener("resize", () => engine.resize());
