// A VRM avatar in a conversation: it looks at the one who speaks, at you, or between the two others.
import { attach, type Target } from "aim-gaze/three-vrm";
import { VRMLoaderPlugin, VRMUtils } from "@pixiv/three-vrm";
import type { VRM } from "@pixiv/three-vrm";
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

const renderer = new THREE.WebGLRenderer({ antialias: true });
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x26323f);
const lamp = new THREE.DirectionalLight(0xfff1df, 2.5);
lamp.position.set(-2, 3, 4);
scene.add(new THREE.HemisphereLight(0xe8f0ff, 0x806a55, 2), lamp);
const camera = new THREE.PerspectiveCamera(30, 1, 0.1, 20);
camera.position.set(0, 1.6, 2.3);
camera.lookAt(0, 1.5, 0);

const loader = new GLTFLoader();
loader.register((parser) => new VRMLoaderPlugin(parser));
const file = new URLSearchParams(location.search).get("model") ?? "models/mannequin.vrm";
const vrm = (await loader.loadAsync(file)).userData.vrm as VRM;
VRMUtils.rotateVRM0(vrm); // VRM 0 avatars face −Z
scene.add(vrm.scene);
const gaze = await attach(vrm);

/** One of the two others: a ball at the height of a face. */
function speaker(x: number, color: number): THREE.Mesh {
  const ball = new THREE.Mesh(new THREE.SphereGeometry(0.06), new THREE.MeshStandardMaterial({ color }));
  ball.position.set(x, 1.65, 0.5);
  scene.add(ball);
  return ball;
}
const [left, right] = [speaker(0.48, 0xe8a33d), speaker(-0.48, 0x4aa3df)];

/** Who speaks, and what is looked at meanwhile: of several targets the mean of their directions, by weight. */
const turns: { speaks?: THREE.Mesh; at: { target: Target; weight: number }[] }[] = [
  { speaks: left, at: [{ target: left, weight: 1 }] },
  { at: [{ target: camera, weight: 1 }] },
  { speaks: right, at: [{ target: right, weight: 1 }] },
  { at: [{ target: left, weight: 0.5 }, { target: right, weight: 0.5 }] },
];

/** Arms down and breath, in place of a clip: seconds since the start. */
function idle(time: number): void {
  const bone = (name: Parameters<typeof vrm.humanoid.getNormalizedBoneNode>[0]) => vrm.humanoid.getNormalizedBoneNode(name);
  const down = vrm.meta.metaVersion === "0" ? 1.3 : -1.3;
  bone("leftUpperArm")?.rotation.set(0, 0, down);
  bone("rightUpperArm")?.rotation.set(0, 0, -down);
  bone("spine")?.rotation.set(0.015 * Math.sin(1.6 * time), 0, 0);
  // A quarter of a second every four seconds.
  vrm.expressionManager?.setValue("blink", Math.max(0, 1 - Math.abs((time % 4) - 3.5) / 0.12));
}

function resize(): void {
  renderer.setPixelRatio(devicePixelRatio);
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.fov = camera.aspect < 1 ? 55 : 30; // both speakers are in view
  camera.updateProjectionMatrix();
}
addEventListener("resize", resize);
resize();

const status = document.querySelector("output");
const timer = new THREE.Timer();
renderer.setAnimationLoop(() => {
  timer.update();
  const { speaks, at } = turns[Math.floor(timer.getElapsed() / 2.5) % turns.length]!;
  for (const ball of [left, right]) ball.scale.setScalar(ball === speaks ? 1 + 0.2 * Math.abs(Math.sin(11 * timer.getElapsed())) : 1);
  idle(timer.getElapsed()); // or mixer.update(…)
  gaze.targets = at;
  gaze.update(timer.getDelta());
  vrm.update(timer.getDelta());
  renderer.render(scene, camera);
  if (status) status.value = gaze.status;
});
