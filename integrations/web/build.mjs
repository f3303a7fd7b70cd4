// Makes the package's folder `dist`: node build.mjs [OUT]; with --keep of the WebAssembly that is there.
//
// Needs rustup's cargo with the target wasm32-unknown-unknown, and the development dependencies of package.json: where they are is
// said by NODE_PATH, or they are in node_modules.
import { execFile, execFileSync } from "node:child_process";
import { copyFileSync, cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { homedir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

import { notices } from "./notices.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const workspace = join(here, "../..");
const [keeps, [out]] = [process.argv.includes("--keep"), process.argv.slice(2).filter((argument) => argument !== "--keep")];
const dist = resolve(out ?? join(here, "dist"));
const target = resolve(process.env.CARGO_TARGET_DIR ?? join(workspace, "target"));
const require = createRequire(import.meta.url);
const { buildSync, transformSync } = require("esbuild");

/** The parts, and how the solvers are compiled for each: presets are of characters, which move by the natural solver. */
const PARTS = { presets: ["--cfg", "aim_natural"], measure: [], declare: [] };

const TRIPLE = "wasm32-unknown-unknown";

/** What browsers of 2023 have. */
const FEATURES = ["bulk-memory", "nontrapping-float-to-int", "sign-ext", "mutable-globals", "reference-types", "multivalue", "simd"];

function run(command, args, env = {}) {
  execFileSync(command, args, { cwd: workspace, stdio: "inherit", env: { ...process.env, ...env } });
}

/** The same, with others beside it. */
async function start(command, args, env = {}) {
  await promisify(execFile)(command, args, { cwd: workspace, env: { ...process.env, ...env } });
}

/** A program of a development dependency. */
function tool(name, script) {
  for (const folder of require.resolve.paths(name)) {
    const path = join(folder, name, script);
    if (existsSync(path)) return path;
  }
  throw new Error(`${name} is not installed: run \`npm install\` in ${here}`);
}

const cargo = process.env.CARGO ?? "cargo";
// What is published names no folder of the machine that it was made on.
const registries = join(process.env.CARGO_HOME ?? join(homedir(), ".cargo"), "registry/src");
const remapped = [
  ...readdirSync(registries).map((registry) => [join(registries, registry), "crates"]),
  [resolve(workspace), "aim"],
].flatMap(([from, to]) => ["--remap-path-prefix", `${from}=${to}`]);

/** Compiles a part. */
async function compile(part, flags) {
  // Even the smallest functions are compressed better as calls than as copies.
  const small = ["--cfg", "aim_small", "-Cllvm-args=-inline-threshold=0"];
  const rustflags = [...small, ...flags, "-Ctarget-feature=+simd128", ...remapped].join("\x1f");
  const args = ["build", "--quiet", "--package", "aim-gaze-wasm", "--lib", "--no-default-features", "--features", part];
  await start(cargo, [...args, "--target", TRIPLE, "--profile", "web"], {
    CARGO_ENCODED_RUSTFLAGS: rustflags,
    CARGO_PROFILE_WEB_OPT_LEVEL: "z",
    CARGO_TARGET_DIR: target,
  });
  const module = join(target, `aim-gaze-${part}.wasm`);
  copyFileSync(join(target, TRIPLE, "web/aim_gaze_wasm.wasm"), module);
  return module;
}

/** Writes the WebAssembly of all parts, with its JavaScript. */
async function assemble(wasm) {
  mkdirSync(wasm, { recursive: true });
  // Beside `aim-features` libraries are built as for the workspace's tests, once for both. The tests compare with what `record` says.
  const native = ["build", "--quiet", "--package", "aim-gaze-wasm", "--package", "aim-features", "--bin"];
  run(cargo, [...native, "record"], { CARGO_TARGET_DIR: target });
  const features = "aim-gaze-wasm/bindgen,aim-gaze-wasm/presets";
  run(cargo, [...native, "aim-gaze-wasm", "--no-default-features", "--features", features], { CARGO_TARGET_DIR: target });
  const done = [];
  for (const [part, flags] of Object.entries(PARTS)) {
    const module = await compile(part, flags);
    run(join(target, "debug/aim-gaze-wasm"), [module, wasm, part]);
    rmSync(join(wasm, `${part}_bg.wasm.d.ts`));
    // While the next one is compiled.
    done.push(shrink(wasm, part));
  }
  await Promise.all(done);
}

// Large functions are compressed less well than the small ones that they would be made of.
const SMALL = ["-Oz", "--converge", "--one-caller-inline-max-function-size=0"];

/** Optimises a part, and writes it as text, too. */
async function shrink(wasm, part) {
  const module = join(wasm, `${part}_bg.wasm`);
  const features = FEATURES.map((feature) => `--enable-${feature}`);
  await start(process.execPath, [tool("binaryen", "bin/wasm-opt"), ...SMALL, ...features, module, "-o", module]);
  const glue = join(wasm, `${part}.js`);
  writeFileSync(glue, transformSync(readFileSync(glue, "utf8"), { minify: true, target: "es2022" }).code);
  const base64 = readFileSync(module).toString("base64");
  writeFileSync(join(wasm, `${part}_base64.js`), `export const base64 = "${base64}";\n`);
  writeFileSync(join(wasm, `${part}_base64.d.ts`), "export declare const base64: string;\n");
}

for (const name of existsSync(dist) ? readdirSync(dist) : []) {
  if (!(keeps && name === "wasm")) rmSync(join(dist, name), { recursive: true });
}
if (!keeps) await assemble(join(dist, "wasm"));

// The compiler finds the declarations of what is made beside the sources.
const declarations = join(here, "src/wasm");
rmSync(declarations, { recursive: true, force: true });
cpSync(join(dist, "wasm"), declarations, { recursive: true, filter: (path) => !/\.(wasm|js)$/.test(path) });
run(process.execPath, [tool("typescript", "bin/tsc"), "--project", join(here, "tsconfig.json"), "--outDir", dist]);
rmSync(declarations, { recursive: true });

buildSync({
  entryPoints: [join(dist, "single.js")],
  outfile: join(dist, "single.js"),
  allowOverwrite: true,
  bundle: true,
  format: "esm",
  minify: true,
  keepNames: true,
  target: "es2022",
  legalComments: "none",
  // The presets alone are in it.
  external: ["./wasm/measure.js", "./wasm/declare.js"],
});

writeFileSync(join(here, "NOTICES"), notices(cargo, workspace, "aim-gaze-wasm", Object.keys(PARTS), TRIPLE));
for (const licence of readdirSync(workspace).filter((name) => name.startsWith("LICENSE-"))) {
  copyFileSync(join(workspace, licence), join(here, licence));
}
