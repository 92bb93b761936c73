// The page in WebKit, by hand: it starts, is drawn, takes a preset and a formula; a body is thrown and a start pulled; a
// film is offered or refused with a reason. Debian: webkit2gtk-driver xvfb
//   CONTENSOU_PROGRAM=.../contensou node webkit.mjs
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const port = 4467;
const folder = mkdtempSync(join(tmpdir(), "contensou-page-"));
const file = join(folder, "page.html");
execFileSync(process.env.CONTENSOU_PROGRAM, ["explore", "-o", file]);
const driver = spawn("xvfb-run", ["-a", "-s", "-screen 0 1500x1000x24", "WebKitWebDriver", `--port=${port}`], { detached: true, env: { ...process.env, WEBKIT_DISABLE_COMPOSITING_MODE: "1" } });
const pause = () => new Promise((done) => setTimeout(done, 500));

/** An answer of WebDriver. */
async function ask(path, body, method = "POST") {
  const answer = await fetch(`http://127.0.0.1:${port}/session${path}`, { method, body: body && JSON.stringify(body) });
  const { value } = await answer.json();
  if (value?.error) throw new Error(value.message);
  return value;
}

try {
  for (let i = 0; i < 20 && !(await fetch(`http://127.0.0.1:${port}/status`).then(() => true, () => false)); ++i) await pause();
  const [library] = readdirSync("/usr/lib").filter((name) => name.endsWith("-linux-gnu"));
  const [version] = readdirSync(`/usr/lib/${library}`).filter((name) => name.startsWith("webkit2gtk-"));
  const binary = `/usr/lib/${library}/${version}/MiniBrowser`;
  const { sessionId } = await ask("", { capabilities: { alwaysMatch: { "webkitgtk:browserOptions": { binary, args: ["--automation"] } } } });
  const run = (script) => ask(`/${sessionId}/execute/sync`, { script, args: [] });
  await ask(`/${sessionId}/window/rect`, { x: 0, y: 0, width: 1440, height: 960 });
  await ask(`/${sessionId}/url`, { url: `${pathToFileURL(file).href}#ball=puck&orbits=2.286,0.5&at=1&lab=1` });
  for (let i = 0; i < 40 && !(await run("return Boolean(globalThis.page?.store.settled)")); ++i) await pause();
  await pause();
  assert.equal(await run("return document.getElementById('failure').textContent"), "");
  for (const id of ["lanes", "patch", "plane", "copies"]) {
    const colours = await run(`const canvas = document.getElementById("${id}");
      return new Set(new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size;`);
    assert.ok(colours > 10, `${id}: ${colours} colours`);
  }
  assert.deepEqual(await run("const { textDecorationLine, textDecorationStyle } = getComputedStyle(document.querySelector('.handle')); return [textDecorationLine, textDecorationStyle];"), ["underline", "dotted"]);
  const pull = async (id, [x, y], ...ways) => {
    const { left, top } = await run(`return document.getElementById("${id}").getBoundingClientRect().toJSON()`);
    const to = ([dx, dy]) => ({ type: "pointerMove", duration: 60, x: Math.round(left + x + dx), y: Math.round(top + y + dy), origin: "viewport" });
    const actions = [to([0, 0]), { type: "pointerDown", button: 0 }, ...ways.map(to), { type: "pointerUp", button: 0 }];
    await ask(`/${sessionId}/actions`, { actions: [{ type: "pointer", id: "mouse", parameters: { pointerType: "mouse" }, actions }] });
  };
  await pull("lanes", await run("const { x, y } = globalThis.page.hero.places[1]; return [x, y];"), [-40, -10], [-140, -40]);
  const [thrown, spin] = await run("const { v, u, heading } = globalThis.page.store.orbit; return [heading, u];");
  assert.deepEqual([thrown > 150, spin], [true, 2.286]);
  const start = await run("const { plane: { frames: [frame] }, store: { orbit }, library } = globalThis.page; return frame.pixel(library.plane.place(orbit.u, orbit.v));");
  await pull("plane", start, [-20, 20], [-40, 40]);
  assert.ok(await run("return globalThis.page.store.orbit.u") < spin);
  await run("document.getElementById('save-film').click()");
  await new Promise((passed) => setTimeout(passed, 3000));
  const writes = await run("return Boolean(globalThis.VideoEncoder)");
  assert.match(await run("return document.getElementById('copied').textContent"), writes ? /Film: \d+ % is made|The film is saved/ : /cannot write films/);
  assert.match(await run("document.querySelector('#presets a:nth-child(4)').click(); return document.getElementById('headline').textContent"), /curves by 60°/);
  const law = "phi = k/(1 + k); psi = a/(1 + k); a = 0.5";
  assert.equal(await run(`const field = document.getElementById("formulas"); field.value = "${law}"; field.dispatchEvent(new Event("change")); return globalThis.page.state.law;`), law);
  await ask(`/${sessionId}`, undefined, "DELETE");
  console.log("The page works in WebKit.");
} finally {
  process.kill(-driver.pid);
  rmSync(folder, { recursive: true });
}
