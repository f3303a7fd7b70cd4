// Used by a page that no bundler has seen, and by one with WebAssembly inlined: loads a VRM, lets it look at a point for a
// second, and gives the angle by which its eye misses it, degrees.
export async function run(THREE, { GLTFLoader }, { VRMLoaderPlugin }, attach) {
  const gltf = await new GLTFLoader().register((parser) => new VRMLoaderPlugin(parser)).loadAsync("/vrm1.vrm");
  const { vrm } = gltf.userData;
  gltf.scene.updateMatrixWorld(true);
  const eye = vrm.humanoid.getRawBoneNode("leftEye");
  // VRM 1 faces +Z.
  const forward = new THREE.Vector3(0, 0, 1).applyQuaternion(eye.getWorldQuaternion(new THREE.Quaternion()).invert());
  const target = new THREE.Vector3(0.6, 1.7, 1.5);
  const gaze = await attach(vrm, { target });
  for (let frame = 0; frame < 60; frame += 1) {
    gaze.update(1 / 60);
    vrm.update(1 / 60);
  }
  gltf.scene.updateMatrixWorld(true);
  const looks = forward.applyQuaternion(eye.getWorldQuaternion(new THREE.Quaternion()));
  return (looks.angleTo(target.sub(eye.getWorldPosition(new THREE.Vector3()))) * 180) / Math.PI;
}
