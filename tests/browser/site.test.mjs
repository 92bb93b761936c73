// The folder that `cmake --build build --target site` writes, in a real browser, and what its own check finds.
//   CONTENSOU_SITE=.../build/site node site.test.mjs
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const site = process.env.CONTENSOU_SITE;
if (!existsSync(join(site, "index.html"))) {
  console.log(`The site is not tested: missing ${site}, which the target site writes`);
  process.exit(77);
}
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const check = (folder) => spawnSync(process.execPath, [fileURLToPath(new URL("../../src/site/check.mjs", import.meta.url)), folder], { encoding: "utf8" });

const patience = 300_000;  // ms: only a failure takes so long
let browser;
before(async () => (browser = await chromium.launch({ executablePath: process.env.CONTENSOU_CHROMIUM, args: ["--no-sandbox"], timeout: patience })));
after(() => browser?.close());

for (const path of ["index.html", "start.html", "film.html", "mathematics.html", "gallery.html", "README.html", "reduction/theory.html", "src/README.html", "reference/classcontensou_1_1reduction_1_1Flow.html",
  "reference/flow_8hpp_source.html"]) {
  test(`${path} is accessible, fits its window and asks the network for nothing`, async () => {
    for (const viewport of [{ width: 1440, height: 900 }, { width: 390, height: 844 }]) {
      for (const colorScheme of ["light", "dark"]) {
        const page = await browser.newPage({ viewport, colorScheme });
        page.setDefaultTimeout(patience);
        const complaints = [];
        page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(message.text()));
        page.on("pageerror", (error) => complaints.push(error.message));
        page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || complaints.push(`asks for ${request.url()}`));
        await page.goto(pathToFileURL(join(site, path)).href);
        await page.evaluate(axe);
        const { violations } = await page.evaluate(() => axe.run(document, { iframes: false, preload: false }));
        complaints.push(...violations.map(({ id, nodes }) => `${id}: ${nodes[0].html} ${nodes[0].failureSummary}`));
        if (await page.evaluate(() => document.documentElement.scrollWidth > innerWidth)) complaints.push("wider than the window");
        assert.deepEqual(complaints, [], `${viewport.width} ${colorScheme}`);
        await page.close();
      }
    }
  });
}

test("every link of the folder leads somewhere", () => {
  const { status, stdout } = check(site);
  assert.equal(status, 0, stdout);
});

test("a dead link, a dead part, a lost page and whatever asks the network are found", () => {
  const folder = mkdtempSync(join(tmpdir(), "contensou-site-"));
  writeFileSync(join(folder, "index.html"), `<a href="https://doi.org/1">fine</a> <a href="none.html">x</a> <a href="#none">x</a> <h1 id="some"><a href="#some">fine</a></h1>
<script src="//a.example/x.js"></script><script>fetch("https://b.example")</script><style>@import "https://c.example/x.css";</style><img src="data:,">`);
  writeFileSync(join(folder, "lost.html"), "");
  const { status, stdout } = check(folder);
  rmSync(folder, { recursive: true });
  assert.equal(status, 1);
  assert.deepEqual(stdout.trim().split("\n").sort(), [
    'index.html: asks the network: <script src="//a.example/x.js">', "index.html: asks the network: https://c.example/x.css",
    "index.html: its script names https://b.example", "index.html: no none.html", "index.html: no part #none", "lost.html: nothing leads here"]);
});
