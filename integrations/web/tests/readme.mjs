// Takes the programs out of a page and makes a bundle of each: node readme.mjs README.md FOLDER
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { build } from "esbuild";

const [page, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const blocks = [...readFileSync(page, "utf8").matchAll(/^```(tsx?)\n([\s\S]*?)^```/gm)];
if (blocks.length < 7) throw new Error(`${page} has ${blocks.length} programs, which is fewer than it should`);
const files = blocks.map(([, language, text], index) => {
  const file = join(folder, `block${index}.${language}`);
  writeFileSync(file, text);
  return file;
});
await build({ entryPoints: files, bundle: true, splitting: true, format: "esm", target: "es2022", outdir: join(folder, "bundled"), logLevel: "warning" });
console.log(`${blocks.length} programs`);
