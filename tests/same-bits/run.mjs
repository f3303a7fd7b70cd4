// Compares the hashes of a WebAssembly build with those of a file: node run.mjs module.wasm golden.txt
import { readFileSync } from "node:fs";

const [module, golden] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(module));
const lines = readFileSync(golden, "utf8").trimEnd().split("\n");
let wrong = lines.length === 0;
lines.forEach((line, run) => {
    const hash = BigInt.asUintN(64, instance.exports.hash(run)).toString(16).padStart(16, "0");
    if (!line.startsWith(`${hash} `)) {
        console.error(`other bits than in ${golden}: ${hash} but ${line}`);
        wrong = true;
    }
});
process.exit(wrong ? 1 : 0);
