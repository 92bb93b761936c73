// Runs the tests of the page, or says what they lack and leaves with CTest's status for a skipped test.
const skipped = 77;

try {
  await import("playwright-core");
} catch {
  console.log("The page is not tested in a browser: playwright-core is missing; npm ci --prefix tests/browser installs it");
  process.exit(skipped);
}
for (const file of ["page", "mended"]) await import(`./${file}.test.mjs`);
