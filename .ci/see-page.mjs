// Looks at pages in a browser: node see-page.mjs CHROMIUM PAGE.html...
// Exits 1 unless every formula and every drawing has a place of its own, nothing is wider than the page but what scrolls by
// itself, and all of that holds on a desk and on a telephone, in light and in dark, folded parts open.
//
// playwright-core is found by NODE_PATH. One browser looks at all of them: starting one takes longer than a page.
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const { chromium } = createRequire(import.meta.url)('playwright-core');
const [executablePath, ...pages] = process.argv.slice(2);

// Runs in the page; pages have no scripts themselves.
function look() {
  document.querySelectorAll('details').forEach((fold) => { fold.open = true; });
  const formulas = [...document.querySelectorAll('math')];
  const isSeen = (element) => {
    const { width, height } = element.getBoundingClientRect();
    return width >= 3 && height >= 5;
  };
  const ink = (element) => getComputedStyle(element).color;
  return {
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
}

const browser = await chromium.launch({
  executablePath,
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking'],
});
async function seen(page, width, isDark) {
  const tab = await browser.newPage({ viewport: { width, height: 1000 }, colorScheme: isDark ? 'dark' : 'light' });
  await tab.goto(pathToFileURL(resolve(page)).href);
  const found = await tab.evaluate(look);
  await tab.close();
  return found;
}

let failed = false;
for (const page of pages) {
  const inks = new Set();
  for (const [width, isDark] of [[1100, false], [1100, true], [500, false]]) {
    const { formulas, unseen, foreign, drawings, wider, page: paper, ink, others } = await seen(page, width, isDark);
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
await browser.close();
process.exit(failed ? 1 : 0);
