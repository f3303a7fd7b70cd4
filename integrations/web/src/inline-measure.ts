/**
 * Imported before `attach` is called, this has the part for measured rigs inlined, so that nothing is fetched.
 *
 * @module
 */
import { decoded, provide } from "./load.js";
import { base64 } from "./wasm/measure_base64.js";

provide("measure", () => decoded(base64));
