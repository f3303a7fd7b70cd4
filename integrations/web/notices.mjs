// The licences of the crates that are compiled into the package's WebAssembly.
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { dirname, join } from "node:path";

/** The licences of everything that a package is made of when it is compiled for a target, as one text. */
export function notices(cargo, workspace, root, features, target) {
  const { packages, resolve } = metadata(cargo, workspace, target, features.map((feature) => `${root}/${feature}`));
  const byId = new Map(packages.map((found) => [found.id, found]));
  const nodes = new Map(resolve.nodes.map((node) => [node.id, node]));
  const used = new Set();
  const visit = (id) => {
    if (used.has(id) || isMacro(byId.get(id))) return;
    used.add(id);
    for (const { pkg, dep_kinds } of nodes.get(id).deps) {
      if (dep_kinds.some(({ kind }) => kind === null)) visit(pkg);
    }
  };
  visit(packages.find(({ name }) => name === root).id);
  const foreign = [...used].map((id) => byId.get(id)).filter(({ source }) => source !== null);
  foreign.sort((a, b) => (a.name < b.name ? -1 : 1));
  const parts = foreign.map((found) => `## ${found.name} ${found.version} (${found.license})\n\n${text(found)}`);
  return `${HEAD}\n${parts.join("\n\n")}\n`;
}

const HEAD = `The WebAssembly of this package contains code of the Rust standard library (MIT OR Apache-2.0,
https://github.com/rust-lang/rust) and of the libraries below, under their licences.
`;

function metadata(cargo, workspace, target, features) {
  const args = ["metadata", "--format-version", "1", "--locked", "--filter-platform", target, "--features", features.join(",")];
  return JSON.parse(execFileSync(cargo, args, { cwd: workspace, maxBuffer: 1 << 28 }));
}

/** Macros run when the package is made; nothing of them is in it. */
function isMacro({ targets }) {
  return targets.some(({ kind }) => kind.includes("proc-macro"));
}

/** The text of a licence that a library may be used under; of several, that of MIT. */
function text({ name, manifest_path, license, authors }) {
  const folder = dirname(manifest_path);
  const files = readdirSync(folder).filter((file) => /^(un)?licen[cs]e|^copying/i.test(file)).sort();
  const file = files.find((file) => /mit/i.test(file)) ?? files.find((file) => !/apache/i.test(file)) ?? files[0];
  if (file === undefined) {
    if (!/\bMIT\b/.test(license)) throw new Error(`${name} (${license}) comes without the text of its licence`);
    return MIT.replace("AUTHORS", authors.map((author) => author.replace(/ <.*>/, "")).join(", "));
  }
  return readFileSync(join(folder, file), "utf8").trim();
}

/** For libraries that name it and leave it out. */
const MIT = `Copyright (c) AUTHORS

Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated documentation files (the
"Software"), to deal in the Software without restriction, including without limitation the rights to use, copy, modify, merge, publish,
distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is furnished to do so, subject to
the following conditions:

The above copyright notice and this permission notice shall be included in all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF
MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY
CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE
SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.`;
