// Validates glTF files with the Khronos validator: node validate-gltf.mjs FILE...
// Exits 1 if any file has an error; as node validate-gltf.mjs --no-worse BEFORE AFTER, if AFTER has more errors of any
// code than BEFORE has. Finds the package `gltf-validator` in ./node_modules or in NODE_PATH.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';

const require = createRequire(join(process.cwd(), 'package.json'));
const validator = require('gltf-validator');

async function validate(file) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    uri: file,
    maxIssues: 0,
    externalResourceFunction: async (uri) => new Uint8Array(readFileSync(resolve(dirname(file), decodeURIComponent(uri)))),
  });
  const { numErrors, numWarnings, messages } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
  return { numErrors, messages };
}

function show(messages) {
  for (const { severity, code, message, pointer } of messages.filter((m) => m.severity <= 1).slice(0, 20)) {
    console.log(`  ${severity === 0 ? 'error' : 'warning'} ${code} at ${pointer}: ${message}`);
  }
}

function errorsByCode(messages) {
  const counts = new Map();
  for (const { code } of messages.filter((m) => m.severity === 0)) counts.set(code, (counts.get(code) ?? 0) + 1);
  return counts;
}

let failed = false;
const files = process.argv.slice(2);
const compares = files[0] === '--no-worse';
if (files.length === 0 || (compares && files.length !== 3)) {
  console.error('usage: node validate-gltf.mjs FILE... | --no-worse BEFORE AFTER');
  process.exit(2);
}
if (compares) {
  const [before, after] = [await validate(files[1]), await validate(files[2])];
  const known = errorsByCode(before.messages);
  for (const [code, count] of errorsByCode(after.messages)) {
    if (count <= (known.get(code) ?? 0)) continue;
    console.log(`  ${count} errors ${code} instead of ${known.get(code) ?? 0}`);
    show(after.messages.filter((m) => m.code === code));
    failed = true;
  }
} else {
  for (const file of files) {
    const { numErrors, messages } = await validate(file);
    show(messages);
    failed ||= numErrors > 0;
  }
}
process.exit(failed ? 1 : 0);
