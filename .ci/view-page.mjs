// Opens the viewer's page in headless Chromium from a plain static file server, moves the target, and checks that the
// reported error and the pixels change accordingly: node view-page.mjs FOLDER [SCREENSHOT.png]
//
// playwright-core is found by NODE_PATH; Chromium is the system's.
import { createReadStream, existsSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join } from "node:path";

const { chromium } = createRequire(import.meta.url)("playwright-core");
const [folder, screenshot] = process.argv.slice(2);
const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm" };

const server = createServer((request, response) => {
  const path = join(folder, new URL(request.url, "http://localhost").pathname.replace(/\/$/, "/index.html"));
  if (!existsSync(path) || !statSync(path).isFile()) {
    response.writeHead(404).end();
    return;
  }
  response.writeHead(200, { "content-type": types[extname(path)] ?? "application/octet-stream" });
  createReadStream(path).pipe(response);
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: [
    "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
  ],
});
const fail = async (problem) => {
  console.error(problem);
  await browser.close();
  process.exit(1);
};
const page = await browser.newPage({ viewport: { width: 1000, height: 640 } });
const trouble = [];
page.on("pageerror", (error) => trouble.push(`page: ${error}`));
page.on("console", (message) => {
  if (message.type() === "error") trouble.push(`console: ${message.text()}`);
});
await page.goto(`http://127.0.0.1:${server.address().port}/`);

const state = async () => JSON.parse(await page.locator("#viewer").getAttribute("data-state"))[0];
/// Waits until what the page reports satisfies the condition.
const until = async (what, holds) => {
  for (let tries = 0; tries < 300; tries += 1) {
    const text = await page.locator("#viewer").getAttribute("data-state");
    if (text !== null && holds(JSON.parse(text)[0])) return JSON.parse(text)[0];
    await page.waitForTimeout(100);
  }
  const note = await page.locator("#note").textContent();
  return fail(`never: ${what}; the page says ${await page.locator("#viewer").getAttribute("data-state")}, its note "${note}", ${trouble.join("; ")}`);
};
/// The scene's pixels (without the panel and the plots), as the browser shows them.
const scene = async (path) => page.screenshot({ path, clip: { x: 0, y: 0, width: 600, height: 380 } });
/// The share of pixels in which two screenshots differ once decoded.
const difference = async (one, other) =>
  page.evaluate(
    async (shots) => {
      const [a, b] = await Promise.all(
        shots.map(async (shot) => {
          const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${shot}`)).blob());
          const canvas = new OffscreenCanvas(image.width, image.height);
          const context = canvas.getContext("2d");
          context.drawImage(image, 0, 0);
          return context.getImageData(0, 0, image.width, image.height).data;
        }),
      );
      let [differ, colours] = [0, new Set()];
      for (let at = 0; at < a.length; at += 4) {
        const change = Math.abs(a[at] - b[at]) + Math.abs(a[at + 1] - b[at + 1]) + Math.abs(a[at + 2] - b[at + 2]);
        differ += change > 24 ? 1 : 0;
        colours.add((a[at] >> 3) * 1024 + (a[at + 1] >> 3) * 32 + (a[at + 2] >> 3));
      }
      return { share: differ / (a.length / 4), colours: colours.size };
    },
    [one, other].map((shot) => shot.toString("base64")),
  );

const first = await until("the character looks at the target", (now) => now.status === "Reached" && now.error_deg < 0.2);
await page.locator("#viewer").click({ position: { x: 60, y: 300 } });
await page.keyboard.press("Space"); // Everything stands still: what changes is what is moved.
await page.waitForTimeout(300);
const still = await state();
const before = await scene(screenshot);
// The target up and to the side; while all stands still the character cannot follow.
await page.keyboard.down("I");
await page.keyboard.down("J");
const moved = await until("the target moved", (now) => Math.hypot(...now.target.map((c, i) => c - still.target[i])) > 0.4);
await page.keyboard.up("I");
await page.keyboard.up("J");
await page.waitForTimeout(300);
const away = await difference(before, await scene());
await page.keyboard.press("Space");
const again = await until("the character looks at it again", (now) => now.status === "Reached" && now.error_deg < 0.2);
const after = await difference(before, await scene(screenshot?.replace(/\.png$/, "-after.png")));

const report = `error ${first.error_deg}° → ${moved.error_deg}° → ${again.error_deg}°; pixels changed: ` +
  `${(100 * away.share).toFixed(2)} % with the target, ${(100 * after.share).toFixed(2)} % with the gaze; ${after.colours} colours`;
if (trouble.length > 0) await fail(trouble.join("\n"));
if (away.colours < 60) await fail(`the scene is blank: ${report}`);
if (!(away.share > 0.0005 && after.share > away.share)) await fail(`the pixels do not follow: ${report}`);
console.log(report);
await browser.close();
server.close();
