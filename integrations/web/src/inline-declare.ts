/**
 * Imported before `attach` is called, this has the part for rig files inlined, so that nothing is fetched.
 *
 * @module
 */
import { decoded, provide } from "./load.js";
import { base64 } from "./wasm/declare_base64.js";

provide("declare", () => decoded(base64));
