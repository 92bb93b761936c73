// Draws the picture of the page that README.md shows.
//   CONTENSOU_PROGRAM=.../contensou CONTENSOU_CHROMIUM=/usr/bin/chromium node picture.mjs ../../src/page/page.png
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const state = "#law=exact&mu=0.4&view=uv&window=1,4&orbits=0.8,3.2;-0.6,2;0.35,1.1&chosen=0&at=0.24&isochrone=8";

const folder = mkdtempSync(join(tmpdir(), "contensou-page-"));
const file = join(folder, "page.html");
execFileSync(process.env.CONTENSOU_PROGRAM, ["explore", "-o", file]);
const browser = await chromium.launch({ executablePath: process.env.CONTENSOU_CHROMIUM, args: ["--no-sandbox"] });
const page = await browser.newPage({ viewport: { width: 1240, height: 1010 }, colorScheme: "light" });
await page.goto(pathToFileURL(file).href + state);
await page.waitForSelector("#checks tbody tr");
await page.screenshot({ path: process.argv[2] });
await browser.close();
rmSync(folder, { recursive: true });
