// What a page has to load, compressed as servers do: node --test tests/sizes.mjs, in a folder that has the package installed.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { test } from "node:test";
import { brotliCompressSync, constants } from "node:zlib";

const dist = resolve(import.meta.dirname, "../node_modules/aim-gaze/dist");

function compressed(path) {
  const bytes = readFileSync(resolve(dist, path));
  const params = {
    [constants.BROTLI_PARAM_QUALITY]: 11,
    // As far back as brotli looks by default in servers.
    [constants.BROTLI_PARAM_LGWIN]: 22,
    [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length,
  };
  const size = brotliCompressSync(bytes, { params }).length;
  console.log(`  ${path}: ${bytes.length} bytes, ${size} compressed`);
  return size;
}

for (const [name, most] of [["presets", 80_000], ["declare", 300_000], ["measure", 300_000]]) {
  test(`the module ${name} and its glue: at most ${most} bytes`, () => {
    const sum = compressed(`wasm/${name}_bg.wasm`) + compressed(`wasm/${name}.js`);
    assert.ok(sum <= most, `${sum} bytes, at most ${most}`);
  });
}

test("the single file, for the record", () => {
  compressed("single.js");
});
