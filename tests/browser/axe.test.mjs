// Accessibility of the page in each of its states, by the rules of axe.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { close, open, page } from "./browser.mjs";

test("axe finds nothing to complain of", async () => {
  const film = async () => {
    await page.setInputFiles("#film", { name: "film.csv", mimeType: "text/csv", buffer: Buffer.from(`t,spin\n${Array.from({ length: 30 }, (_, i) => `${i / 20},${100 - 0.5 * i + Math.sin(99 * i)}`).join("\n")}\n`) });
    await page.locator("#film-report").filter({ visible: true }).waitFor();
  };
  const wrong = async () => {
    await page.setInputFiles("#film", { name: "film.csv", mimeType: "text/csv", buffer: Buffer.from("t,slip\n0,x\n") });
    await page.fill("[name=mu]", "7");
    await page.fill("[name=png-width]", "7");
  };
  for (const [fragment, options, act] of [["", {}], ["", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, colorScheme: "dark" }],
    ["#law=pressure:2&mu=0.3&view=log&orbits=0.8,3.5;0.5,1&isochrone=3&against=pade", {}],
    ["#ball=pool&rollingFriction=0.01&part=whole", { colorScheme: "dark" }, film], ["#ball=pool", { viewport: { width: 390, height: 844 } }, film], ["#ball=puck", {}], ["#ball=pool", {}, wrong], ["#ball=pool&orbits=1.28866,3.91931,1.05927,-0.733885&line=0.6&step=7", {}], ["#ball=gel&step=6", { colorScheme: "dark" }],
    ["#law=exact&mu=0.3&orbits=", {}, null], ["#line=1&tries=2", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }], ["#project=1", {}], ["#system=x'=y;y'=-x&points=1,0", { colorScheme: "dark" }], ["#system=x'=y;y'=-x", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }], ["", { forcedColors: "active" }], ["#lab=0", { viewport: { width: 320, height: 256 } }], ["#embed", {}, null], ["#embed", { colorScheme: "dark", viewport: { width: 390, height: 844 } }, null]]) {
    await open(fragment, options, act !== null);
    await act?.();
    await page.addScriptTag({ content: readFileSync(fileURLToPath(import.meta.resolve("axe-core/axe.min.js")), "utf8") });
    const { violations } = await page.evaluate(() => globalThis.axe.run());
    assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" ")}`), []);
    await close();
  }
});
