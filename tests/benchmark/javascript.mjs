// Costs of a stop time and of a time step in JavaScript, in one run: the table of src/javascript/README.md.
//
//     node tests/benchmark/javascript.mjs build/src/javascript/package
import { resolve } from "node:path";

const { Flow, step, stopTime, stopTimes } = await import(resolve(process.argv[2], "index.js"));
const starts = 100_000, [u, v, mu] = [0.1, 0.1, 0.05].map((least) => Float64Array.from({ length: starts }, (_, i) => least + (i * 0.618) % 0.5));
const flow = new Flow({ mu: 0.3 }), out = new Float64Array(starts);
const contact = { motion: [1, -2, 300], load: 1.7, friction: 0.2, radius: 3e-3, byForce: 20, byMoment: 2e4, dt: 0.01 };
const times = (count, call) => () => { for (let i = 0; i < count; ++i) call(i); };
const rows = [
  ["u + v in a loop", starts, times(starts, (i) => { out[i] = u[i] + v[i]; })],
  ["`Flow.stopTimes`, 100 000 starts", starts, () => flow.stopTimes({ u, v })],
  ["`stopTimes` with a mu each, 100 000 starts", starts, () => stopTimes({ mu, u, v })],
  ["`stopTime` of one start, the same mu again", 1000, times(1000, () => stopTime({ mu: 0.3, u: 1, v: 1 }))],
  ["`stopTime` of one start, another mu", 50, times(50, (i) => stopTime({ mu: 0.2 + i / 1000, u: 1, v: 1 }))],
  ["`step` of one contact", 10_000, times(10_000, () => step(contact))],
].map(([name, count, call]) => ({ name, count, call, best: Infinity }));
for (let round = 0; round < 9; ++round) {  // in turn, the least of nine
  for (const row of rows) {
    const before = process.cpuUsage();
    row.call();
    const { user, system } = process.cpuUsage(before);
    row.best = Math.min(row.best, (user + system) * 1e3 / row.count);
  }
}
console.log("| computation | time | divided by the second row |\n|---|---|---|");
for (const { name, best } of rows) console.log(`| ${name} | ${best < 1e3 ? `${best.toFixed(1)} ns` : `${(best / 1e3).toPrecision(3)} us`} | ${(best / rows[1].best).toPrecision(3)} |`);
