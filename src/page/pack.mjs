// Writes files as text beside them, for start.js:  node pack.mjs FILE...
import { readFileSync, writeFileSync } from "node:fs";
import { argv } from "node:process";
import { packed } from "./packing.js";

for (const file of argv.slice(2)) writeFileSync(`${file}.txt`, packed(readFileSync(file)));
