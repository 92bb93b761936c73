// Style, types and tests of the page's modules; or says what they lack, and leaves with CTest's status for a skipped test.
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const tools = `${here}/node_modules`;
if (!existsSync(`${tools}/eslint`) || !existsSync(`${tools}/typescript`)) {
  console.log("The page's modules are not tested: eslint and typescript are missing; npm ci --prefix tests/page installs them");
  process.exit(77);
}
const steps = {
  style: [`${tools}/eslint/bin/eslint.js`, "--config", "tests/page/eslint.config.js", "src/page", "tests/page", "tests/browser"],
  types: [`${tools}/typescript/bin/tsc`, "--project", here],
  tests: ["--test", `${here}/modules.test.mjs`],
};
// A node that would guess that a file is a module is not to: Debian's does not.
const guess = "--experimental-detect-module";
if (process.allowedNodeEnvironmentFlags.has(guess)) process.env.NODE_OPTIONS = guess.replace("--", "--no-");
const failed = Object.entries(steps).filter(([name, words]) => {
  console.log(`--- ${name}`);
  return spawnSync(process.execPath, words, { cwd: dirname(dirname(here)), stdio: "inherit" }).status !== 0;
});
process.exit(failed.length);
