// Draws the pictures of the page that its README shows: page.png, and strip.png of three states side by side.
//   CONTENSOU_PROGRAM=.../contensou CONTENSOU_CHROMIUM=/usr/bin/chromium node picture.mjs ../../src/page
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [folder, out] = [mkdtempSync(join(tmpdir(), "contensou-page-")), process.argv[2]];
const file = join(folder, "page.html");
execFileSync(process.env.CONTENSOU_PROGRAM, ["explore", "-o", file]);
const browser = await chromium.launch({ executablePath: process.env.CONTENSOU_CHROMIUM, args: ["--no-sandbox"] });

async function shot(fragment, share, options) {
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 }, deviceScaleFactor: 0.75, reducedMotion: "reduce", ...options });
  await page.goto(pathToFileURL(file).href + fragment);
  await page.waitForSelector("#orbits li");
  await page.evaluate((share) => globalThis.page.store.move({ fraction: share }), share);
  const picture = await page.screenshot();
  await page.close();
  return picture;
}

writeFileSync(join(out, "page.png"), await shot("", 0.3, { colorScheme: "light" }));
const pictures = await Promise.all([
  shot("", 0.15, { viewport: { width: 390, height: 844 }, deviceScaleFactor: 1, colorScheme: "dark" }),
  shot("#ball=pool&velocityX=0.9&velocityY=0.9&orbits=3,4", 0.5, { colorScheme: "light" }),
  shot("#ball=puck&view=disc", 0.6, { colorScheme: "light" }),
]);
const strip = await browser.newPage({ viewport: { width: 1342, height: 360 } });
await strip.setContent(`<body style="margin:0;display:flex;gap:12px;background:#888">${
  pictures.map((picture) => `<img height="360" src="data:image/png;base64,${picture.toString("base64")}">`).join("")}</body>`);
await strip.evaluate(() => Promise.all([...document.images].map((image) => image.decode())));
await strip.screenshot({ path: join(out, "strip.png") });
await browser.close();
rmSync(folder, { recursive: true });
