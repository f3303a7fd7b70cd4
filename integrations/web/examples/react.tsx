// react-three-fiber: two characters walk on the spot and look at the pointer, or at the camera while the box is ticked.
import { useGaze } from "aim-gaze/react";
import { Canvas, useFrame, useLoader, useThree } from "@react-three/fiber";
import { useMemo, useState } from "react";
import { createRoot } from "react-dom/client";
import { AnimationMixer, Plane, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { clone } from "three/addons/utils/SkeletonUtils.js";

/** The plane on which the pointer moves: upright, 0.6 m in front of the characters, which face +Z. */
const plane = new Plane(new Vector3(0, 0, 1), -0.6);

function Character({ x, point }: { readonly x: number; readonly point: Vector3 }) {
  const { scene, animations } = useLoader(GLTFLoader, "models/mannequin.glb");
  const body = useMemo(() => clone(scene), [scene]);
  const mixer = useMemo(() => new AnimationMixer(body), [body]);
  useMemo(() => {
    const walk = animations.find(({ name }) => name === "walk");
    if (walk) mixer.clipAction(walk).play();
  }, [mixer, animations]);
  // In this order: what is called first in a component runs first in a frame, and the gaze goes over the animation.
  useFrame((_, delta) => void mixer.update(delta));
  useGaze(body, { target: point });
  return <primitive object={body} position-x={x} />;
}

function Scene({ atCamera }: { readonly atCamera: boolean }) {
  const { camera, raycaster, pointer } = useThree();
  const point = useMemo(() => new Vector3(0, 1.5, 2), []);
  useFrame(() => {
    raycaster.setFromCamera(pointer, camera);
    if (atCamera) point.copy(camera.position);
    else raycaster.ray.intersectPlane(plane, point);
  });
  return (
    <>
      <hemisphereLight args={[0xffffff, 0x9a8f80, 2]} />
      <directionalLight position={[-2, 4, 4]} intensity={2} />
      <Character x={-0.32} point={point} />
      <Character x={0.32} point={point} />
    </>
  );
}

function App() {
  const [atCamera, setAtCamera] = useState(false);
  return (
    <>
      <Canvas
        camera={{ position: [0, 1.6, 2.4], fov: innerWidth < innerHeight ? 55 : 30 }}
        onCreated={({ camera }) => camera.lookAt(0, 1.5, 0)}
      >
        <color attach="background" args={[0xe3ddd3]} />
        <Scene atCamera={atCamera} />
      </Canvas>
      <label className="over">
        <input type="checkbox" checked={atCamera} onChange={({ target }) => setAtCamera(target.checked)} /> at the camera
      </label>
    </>
  );
}

const root = document.body.appendChild(document.createElement("main"));
createRoot(root).render(<App />);
