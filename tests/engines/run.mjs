// Runs a file of tests of physics engines, or prints what is missing and exits with CTest's status of a skipped test.
import { spawnSync } from "node:child_process";
import { createRequire } from "node:module";

const skipped = 77;
const [file] = process.argv.slice(2);
const { resolve } = createRequire(import.meta.url);

function missing() {
  if (file === "lammps.test.mjs") {
    return spawnSync("lmp", ["-help"]).error && "lmp is missing; Debian's package lammps installs it";
  }
  try {
    resolve("mujoco-js");
    resolve("physx-js-webidl");
  } catch {
    return "mujoco-js and physx-js-webidl are missing; npm ci --prefix tests/engines installs them";
  }
}

const reason = missing();
if (reason) {
  console.log(`${file} is not run: ${reason}`);
  process.exit(skipped);
}
await import(`./${file}`);
