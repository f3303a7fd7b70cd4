/**
 * The package in one file, with the presets in it: for a `<script type="module">` and an import map that has three.js.
 *
 * @module
 */
import "./inline.js";

export * from "./index.js";
export { attach as attachThree } from "./three.js";
export { attach as attachVrm } from "./three-vrm.js";
