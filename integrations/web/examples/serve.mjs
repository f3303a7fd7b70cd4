// Bundles the examples and serves them: node examples/serve.mjs [--port N] [--out FOLDER]
//
// The package has to be built (node build.mjs). With --out the site is written into the folder, for any static server, and not served.
// The characters are the mannequin of this repository; its program writes them, with cargo, unless examples/models has them.
import { execFileSync } from "node:child_process";
import { cp, mkdir, readFile, writeFile } from "node:fs/promises";
import { existsSync } from "node:fs";
import { createServer } from "node:http";
import { dirname, extname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { build } from "esbuild";

const examples = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({ options: { port: { type: "string", default: "8080" }, out: { type: "string" } } });
const site = values.out === undefined ? join(examples, "site") : resolve(values.out);

const names = { pointer: "pointer.ts", avatar: "avatar.ts", babylon: "babylon.ts", react: "react.tsx" };
const models = { "mannequin.glb": [], "mannequin.vrm": ["--vrm1"], "mannequin-0.vrm": ["--vrm0"] };

/** Writes the characters that are not there yet. */
async function makeModels() {
  await mkdir(join(examples, "models"), { recursive: true });
  const root = join(examples, "../../..");
  for (const [name, words] of Object.entries(models)) {
    const file = join(examples, "models", name);
    if (existsSync(file)) continue;
    const program = ["run", "--quiet", "-p", "aim-character", "--example", "mannequin", "--"];
    execFileSync("cargo", [...program, "--moves", ...words, file], { cwd: root, stdio: "inherit" });
  }
}

/** Writes the site: pages, bundles, modules of WebAssembly, characters, and the examples' sources. */
async function makeSite() {
  await mkdir(site, { recursive: true });
  await build({
    absWorkingDir: examples,
    entryPoints: Object.values(names),
    bundle: true,
    splitting: true,
    minify: true,
    format: "esm",
    target: "es2022",
    define: { "process.env.NODE_ENV": '"production"' },
    outdir: site,
    logLevel: "warning",
  });
  // esbuild leaves `new URL("./wasm/….wasm", import.meta.url)` as it is: the folder goes beside the bundles.
  const wasm = (path) => extname(path) === "" || path.endsWith(".wasm");
  await cp(join(examples, "../dist/wasm"), join(site, "wasm"), { recursive: true, filter: wasm });
  const page = await readFile(join(examples, "example.html"), "utf8");
  for (const [name, source] of Object.entries(names)) {
    await writeFile(join(site, `${name}.html`), page.replaceAll("NAME", name));
    // As text, so that a browser shows it.
    await cp(join(examples, source), join(site, `${source}.txt`));
  }
  await cp(join(examples, "index.html"), join(site, "index.html"));
  await cp(join(examples, "models"), join(site, "models"), { recursive: true });
}

const types = {
  ".html": "text/html; charset=utf-8", ".js": "text/javascript", ".txt": "text/plain; charset=utf-8",
  ".wasm": "application/wasm", ".glb": "model/gltf-binary", ".vrm": "model/gltf-binary",
};

async function answer(request, response) {
  const { pathname } = new URL(request.url ?? "/", "http://localhost");
  const path = pathname === "/" ? "index.html" : decodeURIComponent(pathname.slice(1));
  try {
    // Nothing outside of the site.
    if (path.split(/[\\/]/).includes("..")) throw new Error("outside");
    const bytes = await readFile(join(site, path));
    response.writeHead(200, { "content-type": types[extname(path)] ?? "application/octet-stream" }).end(bytes);
  } catch {
    response.writeHead(404).end();
  }
}

await makeModels();
await makeSite();
if (values.out === undefined) {
  const server = createServer((request, response) => void answer(request, response));
  server.listen(Number(values.port), "127.0.0.1", () => console.log(`http://127.0.0.1:${server.address().port}/`));
} else {
  console.log(site);
}
