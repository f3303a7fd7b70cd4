/**
 * Imported before `attach` is called, this has the part for presets inlined, so that nothing is fetched.
 *
 * @module
 */
import { decoded, provide } from "./load.js";
import { base64 } from "./wasm/presets_base64.js";

provide("presets", () => decoded(base64));
