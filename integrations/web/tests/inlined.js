// Bundled with the WebAssembly inlined: nothing is fetched but the character.
import "aim-gaze/inline";
import { attach } from "aim-gaze/three-vrm";
import * as vrm from "@pixiv/three-vrm";
import * as THREE from "three";
import * as loader from "three/addons/loaders/GLTFLoader.js";
import { run } from "./single.js";

globalThis.acceptance = { run: () => run(THREE, loader, vrm, attach) };
