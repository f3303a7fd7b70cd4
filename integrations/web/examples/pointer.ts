// A character of a GLB file walks on the spot and looks at the pointer.
import { attach } from "aim-gaze/three";
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

// The plane on which the pointer moves: upright, this far in front of the character, in metres. glTF characters face +Z.
const plane = new THREE.Plane(new THREE.Vector3(0, 0, 1), -0.45);

const renderer = new THREE.WebGLRenderer({ antialias: true });
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xd9dee3);
const sun = new THREE.DirectionalLight(0xffffff, 2);
sun.position.set(-2, 4, 4);
scene.add(new THREE.HemisphereLight(0xffffff, 0x9a8f80, 2), sun);
const camera = new THREE.PerspectiveCamera(30, 1, 0.1, 20);
camera.position.set(0, 1.6, 2);
camera.lookAt(0, 1.57, 0);

const file = new URLSearchParams(location.search).get("model") ?? "models/mannequin.glb";
const gltf = await new GLTFLoader().loadAsync(file);
scene.add(gltf.scene);
const mixer = new THREE.AnimationMixer(gltf.scene);
const clip = THREE.AnimationClip.findByName(gltf.animations, "walk") ?? gltf.animations[0];
if (clip) mixer.clipAction(clip).play();

// Without a rig in the options the character is measured: which bones are eyes, neck and spine, and which way they face.
const gaze = await attach(gltf);

// The gaze follows this point; a ball shows where it is.
const ball = new THREE.Mesh(new THREE.SphereGeometry(0.02), new THREE.MeshStandardMaterial({ color: 0xd6452b }));
ball.visible = false;
scene.add(ball);

const raycaster = new THREE.Raycaster();
addEventListener("pointermove", ({ clientX, clientY }) => {
  const onScreen = new THREE.Vector2((2 * clientX) / innerWidth - 1, 1 - (2 * clientY) / innerHeight);
  raycaster.setFromCamera(onScreen, camera);
  ball.visible = raycaster.ray.intersectPlane(plane, ball.position) !== null;
  gaze.target = ball.visible ? ball : null;
});
// Without a pointer the character looks where its animation looks.
document.documentElement.addEventListener("pointerleave", () => {
  ball.visible = false;
  gaze.target = null;
});

function resize(): void {
  renderer.setPixelRatio(devicePixelRatio);
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener("resize", resize);
resize();

const status = document.querySelector("output");
const timer = new THREE.Timer();
renderer.setAnimationLoop(() => {
  timer.update();
  mixer.update(timer.getDelta());
  gaze.update(timer.getDelta());
  renderer.render(scene, camera);
  if (status) status.value = gaze.status;
});
