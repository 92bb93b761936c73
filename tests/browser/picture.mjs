// Draws the pictures of the page that its README shows: page.png, and strip.png of eight states.
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

async function shot(fragment, share, options, act = () => {}) {
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 }, deviceScaleFactor: 0.75, reducedMotion: "reduce", ...options });
  await page.goto(pathToFileURL(file).href + fragment);
  await page.waitForSelector("#orbits li", { state: "attached" });
  await page.evaluate((share) => globalThis.page.store.move({ fraction: share }), share);
  await act(page);
  const picture = await page.screenshot();
  await page.close();
  return picture;
}

/** Gives the page a film of the ball that it shows, with errors. */
async function film(page) {
  const text = await page.evaluate(() => {
    const { store, library } = globalThis.page;
    const { t, slip, wz } = library.plane.ride(store.request.ball, 0, 0.5);
    const rows = Array.from(t, (t, i) => `${t},${slip[i] + 0.01 * Math.sin(999 * i)},${wz[i] + Math.cos(777 * i)},0.01,1`);
    return `t,slip,spin,slip_sd,spin_sd\n${rows.join("\n")}\n`;
  });
  await page.setInputFiles("#film", { name: "film.csv", mimeType: "text/csv", buffer: Buffer.from(text) });
  await page.locator("#film-report").filter({ visible: true }).waitFor();
}

/** Shows the plane of typed equations. */
const typed = (page) => page.locator("section:has(#typed)").evaluate((card) => card.scrollIntoView());

const light = { colorScheme: "light" };
const dark = { colorScheme: "dark" };
const struck = "1.28866,3.91931,1.05927,-0.733885";
const curled = `#ball=pool&orbits=${[0, 0, 20, 27].map((aim) => `${struck},${aim}`).join(";")}&chosen=3&line=0.6&step=7`;
const phone = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 1 };
writeFileSync(join(out, "page.png"), await shot("", 0.6, light));
const shots = [
  ["", 0.4, light], ["", 0.15, { ...phone, ...light }], ["#ball=gel&view=log&orbits=9,0.5;-4,0.5", 0.2, dark],
  [curled, 1, light], ["#ball=puck&view=disc&orbits=7.62,0.5", 0.6, light], [`#system=${encodeURIComponent("x' = y; y' = (1 - x^2)*y - x")}&points=0.1,0`, 0, light, typed],
  ["#ball=gel&against=pade", 0, light, film], ["#ball=puck&orbits=2.286,0.5;3.4,0.5;5,0.5;4.53,0.5&chosen=3&line=1", 1, { ...phone, ...dark }],
];
const pictures = [];
for (const asked of shots) pictures.push(await shot(...asked));
const strip = await browser.newPage({ viewport: { width: 1639, height: 636 } });
await strip.setContent(`<body style="margin:0;padding:12px;display:flex;flex-wrap:wrap;gap:12px;background:#888">${
  pictures.map((picture) => `<img height="300" src="data:image/png;base64,${picture.toString("base64")}">`).join("")}</body>`);
await strip.evaluate(() => Promise.all([...document.images].map((image) => image.decode())));
await strip.screenshot({ path: join(out, "strip.png") });
await browser.close();
rmSync(folder, { recursive: true });
