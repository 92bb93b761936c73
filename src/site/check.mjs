// What is wrong with a written folder: links and #parts that lead nowhere, and what a browser would ask the network for.
//   node check.mjs FOLDER
import { existsSync, readFileSync, readdirSync, statSync } from "node:fs";
import { dirname, extname, join, relative } from "node:path";
import { parse } from "parse5";

const folder = process.argv[2];
const files = readdirSync(folder, { recursive: true }).map((file) => join(folder, file)).filter((file) => statSync(file).isFile());
const text = (file) => readFileSync(file, "utf8");
const isNetwork = (address) => /^(\w+:)?\/\//.test(address);
const complaints = [];
const parts = new Map();   // the ids of each page
const links = [];
const complain = (file, what) => complaints.push(`${relative(folder, file)}: ${what}`);

function walk(file, node) {
  const attributes = Object.fromEntries((node.attrs ?? []).map(({ name, value }) => [name, value]));
  for (const id of [attributes.id, node.tagName === "a" && attributes.name]) if (id) parts.get(file).add(id);
  for (const name of ["href", "src", "srcset", "poster", "data", "action", "ping", "style"].filter((name) => name in attributes)) {
    const address = attributes[name];
    if (name === "style") readStyle(file, address);
    else if (isNetwork(address) ? node.tagName !== "a" || name !== "href" : false) complain(file, `asks the network: <${node.tagName} ${name}="${address}">`);
    else if (!/^[a-z]+:/.test(address) && !isNetwork(address)) links.push([file, address]);
  }
  for (const child of [...(node.childNodes ?? []), ...(node.content ? [node.content] : [])]) {
    if (node.tagName === "style") readStyle(file, child.value);
    if (node.tagName === "script") readScript(file, child.value);
    walk(file, child);
  }
}

function readStyle(file, style) {
  for (const [, address] of style.matchAll(/(?:url\(\s*|@import\s+)["']?([^"')\s;]+)/g)) {
    if (isNetwork(address)) complain(file, `asks the network: ${address}`);
    else if (!/^(data:|#)/.test(address)) links.push([file, address]);
  }
}

// The names of SVG and XHTML are no addresses.
function readScript(file, script) {
  for (const [address] of script.matchAll(/(https?|wss?):\/\/(?!www\.w3\.org\/)[^"'`\s]+/g)) complain(file, `its script names ${address}`);
}

for (const file of files) {
  parts.set(file, new Set());
  if ([".html", ".svg"].includes(extname(file))) walk(file, parse(text(file)));
  if (extname(file) === ".css") readStyle(file, text(file));
}
for (const [file, address] of links) {
  const [path, part] = address.split("#").map(decodeURIComponent);
  const to = path ? join(dirname(file), path) : file;
  if (!existsSync(to) || statSync(to).isDirectory()) complain(file, `no ${address}`);
  // What stands after # in the address of explore.html is its state.
  else if (part && relative(folder, to) !== "explore.html" && !parts.get(to).has(part)) complain(file, `no part ${address}`);
}
const written = new Set(links.map(([file, address]) => join(dirname(file), decodeURIComponent(address.split("#")[0]))));
for (const file of files) if (!written.has(file) && relative(folder, file) !== "index.html") complain(file, "nothing leads here");

console.log(complaints.length ? complaints.join("\n") : `${files.length} files, ${links.length} links`);
process.exitCode = complaints.length ? 1 : 0;
