// Looks at every page of a book in a browser: node see-book.mjs CHROMIUM FOLDER [PAGE=PICTURE.png | narrow:PAGE=PICTURE.png]...
// Exits 1 where a page reports an error, a link or a picture of the book is missing, a page cannot be reached from the first one, or is
// wider than the window, on a desk and on a telephone.
//
// playwright-core is found by NODE_PATH.
import { createReadStream, existsSync, readdirSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { extname, join } from 'node:path';

const { chromium } = createRequire(import.meta.url)('playwright-core');
const [executablePath, folder, ...wanted] = process.argv.slice(2);
const pictures = Object.fromEntries(wanted.map((one) => one.split('=')));
const types = {
  '.css': 'text/css', '.html': 'text/html', '.js': 'text/javascript', '.png': 'image/png', '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm', '.woff2': 'font/woff2',
};
// Not for reading: the list of chapters for those without scripts, and what a server shows for what is missing.
const others = ['404.html', 'toc.html'];

const server = createServer((request, response) => {
  const path = join(folder, decodeURIComponent(new URL(request.url, 'http://localhost').pathname).replace(/\/$/, '/index.html'));
  if (!existsSync(path) || !statSync(path).isFile()) {
    response.writeHead(404).end();
    return;
  }
  response.writeHead(200, { 'content-type': types[extname(path)] ?? 'application/octet-stream' });
  createReadStream(path).pipe(response);
});
await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
const origin = `http://127.0.0.1:${server.address().port}`;

// Runs in the page.
function look() {
  const absolute = (elements, name) => [...elements].map((one) => new URL(one.getAttribute(name), document.baseURI).href);
  const main = document.querySelector('main');
  return {
    links: absolute(document.querySelectorAll('a[href]'), 'href'),
    text: main.textContent.length,
    raw: main.textContent.includes('{{#'),
    anchors: [...document.querySelectorAll('[id]')].map((one) => one.id),
    unseen: [...main.querySelectorAll('img')].filter((one) => one.complete && one.naturalWidth === 0).map((one) => one.src),
    wider: document.documentElement.scrollWidth - document.documentElement.clientWidth,
  };
}

const browser = await chromium.launch({
  executablePath,
  args: [
    '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
    '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist',
  ],
});
const trouble = [];
const files = readdirSync(folder).filter((name) => name.endsWith('.html') && !others.includes(name));
const found = {};
let now = '';
/// A tab of its own for a window of this width: on a telephone the list of chapters begins folded.
async function tab(width) {
  const context = await browser.newContext({ viewport: { width, height: 900 } });
  const page = await context.newPage();
  page.on('pageerror', (error) => trouble.push(`${now}: ${error}`));
  page.on('console', (message) => {
    if (message.type() === 'error') trouble.push(`${now}: console: ${message.text()}`);
  });
  page.on('response', (response) => {
    if (response.status() >= 400) trouble.push(`${now}: ${response.url().slice(origin.length)} is missing`);
  });
  return page;
}
const [desk, telephone] = [await tab(1200), await tab(420)];
for (const file of files) {
  now = file;
  for (const [page, name] of [[desk, file], [telephone, `narrow:${file}`]]) {
    await page.goto(`${origin}/${file}`, { waitUntil: 'load' });
    const seen = await page.evaluate(look);
    if (page === desk) found[file] = seen;
    if (pictures[name]) await page.screenshot({ path: pictures[name] });
    if (seen.wider > 0) trouble.push(`${name}: ${seen.wider} pixels wider than its window`);
    seen.unseen.forEach((picture) => trouble.push(`${name}: no picture ${picture}`));
  }
  if (found[file].text < 300) trouble.push(`${file}: hardly any text`);
  if (found[file].raw) trouble.push(`${file}: shows a directive of mdBook`);
}
await browser.close();
server.close();

let links = 0;
const reached = new Set(['index.html']);
for (const [file, { links: all }] of Object.entries(found)) {
  for (const link of all.filter((one) => one.startsWith(origin))) {
    links += 1;
    const { pathname, hash } = new URL(link);
    const to = decodeURIComponent(pathname.slice(1)) || 'index.html';
    reached.add(to);
    if (!existsSync(join(folder, to))) {
      trouble.push(`${file}: links to ${to}, which is not there`);
    } else if (hash && to.endsWith('.html') && !found[to]?.anchors.includes(decodeURIComponent(hash.slice(1)))) {
      trouble.push(`${file}: links to ${to}${hash}, which has no such place`);
    }
  }
}
files.filter((file) => !reached.has(file)).forEach((file) => trouble.push(`${file}: cannot be reached`));

console.log(`${files.length} pages, ${links} links within the book`);
if (trouble.length > 0) console.log([...new Set(trouble)].join('\n'));
process.exit(trouble.length > 0 || links < 100 ? 1 : 0);
