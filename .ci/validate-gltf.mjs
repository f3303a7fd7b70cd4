// Validates glTF files with the Khronos validator: node validate-gltf.mjs FILE...
// Exits 1 if any file has an error. Finds the package `gltf-validator` in ./node_modules or in NODE_PATH.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';

const require = createRequire(join(process.cwd(), 'package.json'));
const validator = require('gltf-validator');

let failed = false;
const files = process.argv.slice(2);
if (files.length === 0) {
  console.error('usage: node validate-gltf.mjs FILE...');
  process.exit(2);
}
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    uri: file,
    externalResourceFunction: async (uri) => new Uint8Array(readFileSync(resolve(dirname(file), decodeURIComponent(uri)))),
  });
  const { numErrors, numWarnings, messages } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
  for (const { severity, code, message, pointer } of messages.filter((m) => m.severity <= 1).slice(0, 20)) {
    console.log(`  ${severity === 0 ? 'error' : 'warning'} ${code} at ${pointer}: ${message}`);
  }
  failed ||= numErrors > 0;
}
process.exit(failed ? 1 : 0);
