// Looks at pages in a browser: node see-page.mjs CHROMIUM PAGE.html...
// Exits 1 unless every formula and every drawing has a place of its own, nothing is wider than the page but what scrolls by
// itself, and all of that holds on a desk and on a telephone, in light and in dark, folded parts open.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [chromium, ...pages] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), 'see-page-'));

// Runs in the page; pages have no scripts themselves.
function look() {
  document.querySelectorAll('details').forEach((fold) => { fold.open = true; });
  const formulas = [...document.querySelectorAll('math')];
  const isSeen = (element) => {
    const { width, height } = element.getBoundingClientRect();
    return width >= 3 && height >= 5;
  };
  const ink = (element) => getComputedStyle(element).color;
  const seen = {
    formulas: formulas.length,
    unseen: formulas.filter((one) => !isSeen(one)).map((one) => one.textContent),
    // An element that the browser does not know as mathematics is laid out as text.
    foreign: formulas.filter((one) => !getComputedStyle(one).display.includes('math')).length,
    drawings: [...document.querySelectorAll('svg')].filter((one) => !isSeen(one)).length,
    wider: document.documentElement.scrollWidth - document.documentElement.clientWidth,
    page: getComputedStyle(document.body).backgroundColor,
    ink: ink(document.body),
    others: formulas.filter((one) => ink(one) === getComputedStyle(document.body).backgroundColor).length,
  };
  document.body.innerHTML = '<pre id="seen"></pre>';
  document.getElementById('seen').textContent = encodeURIComponent(JSON.stringify(seen));
}

function seen(page, width, isDark) {
  const copy = join(folder, 'page.html');
  const script = `<script>addEventListener('load', ${look})</script>`;
  writeFileSync(copy, readFileSync(page, 'utf8').replace('</head>', () => `${script}</head>`));
  const dom = execFileSync(chromium, [
    '--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
    `--user-data-dir=${join(folder, 'profile')}`, `--window-size=${width},1000`,
    `--blink-settings=preferredColorScheme=${isDark ? 0 : 1}`, '--dump-dom', pathToFileURL(copy).href,
  ], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'], maxBuffer: 1 << 28 });
  const found = /<pre id="seen">([^<]+)<\/pre>/.exec(dom);
  if (!found) throw new Error(`${page}: the browser did not answer`);
  return JSON.parse(decodeURIComponent(found[1]));
}

let failed = false;
for (const page of pages) {
  const inks = new Set();
  for (const [width, isDark] of [[1100, false], [1100, true], [500, false]]) {
    const { formulas, unseen, foreign, drawings, wider, page: paper, ink, others } = seen(page, width, isDark);
    inks.add(`${ink} on ${paper}`);
    const isRight = formulas > 0 && unseen.length + foreign + drawings + others === 0 && wider <= 0;
    console.log(`${page}: ${formulas} formulas, ${width} wide, ${ink} on ${paper}${isRight ? '' : ': WRONG'}`);
    if (!isRight) {
      console.log(JSON.stringify({ unseen, foreign, drawings, wider, others }));
      failed = true;
    }
  }
  if (inks.size !== 2) {
    console.log(`${page}: light and dark are the same`);
    failed = true;
  }
}
rmSync(folder, { recursive: true, force: true });
process.exit(failed ? 1 : 0);
