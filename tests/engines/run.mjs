// Runs the tests of the physics engines, or says what they lack and leaves with CTest's status for a skipped test.
import { createRequire } from "node:module";

const skipped = 77;
const { resolve } = createRequire(import.meta.url);

try {
  resolve("mujoco-js");
  resolve("physx-js-webidl");
} catch {
  console.log("Engines are not tested: mujoco-js and physx-js-webidl are missing; npm ci --prefix tests/engines installs them");
  process.exit(skipped);
}
await import("./engines.test.mjs");
