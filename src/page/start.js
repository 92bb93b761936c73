// The first script of the page. It unpacks the other modules and the library, which are compressed to a third of their size.
import { $ } from "./dom.js";
import { unpacked } from "./packing.js";

// The build puts the packed files here.
const [modules, wasm] = ["@MODULES@", "@LIBRARY@"];
const inflated = (text) => new Response(new Blob([unpacked(text)]).stream().pipeThrough(new DecompressionStream("gzip")));

globalThis.contensouFailed = (error) => {
  $("failure").hidden = false;
  $("failure").textContent = `The library could not be started: ${error.message ?? error}. The page needs a browser of 2023 or later, ` +
    "and a host that allows WebAssembly ('wasm-unsafe-eval' in its content security policy, if it sends one).";
};

async function begin() {
  globalThis.contensouWasm = inflated(wasm).arrayBuffer();
  const text = await inflated(modules).text();
  document.body.append(Object.assign(document.createElement("script"), { textContent: text }));
}

begin().catch(globalThis.contensouFailed);
