// Runs files of tests in the browser, or says what they lack and leaves with CTest's status for a skipped test.
const skipped = 77;
const files = process.argv.slice(2);

try {
  await import("playwright-core");
} catch {
  console.log(`${files} needs a browser, and playwright-core is missing; npm ci --prefix tests/browser installs it`);
  process.exit(skipped);
}
for (const file of files) await import(`./${file}`);
