// The C++ library, compiled to WebAssembly; bindings.cpp says what each function answers.
import loadContensou from "contensou";
import compressed from "contensou.wasm.gz";

/** What the library says against a question, in its own words. */
export class Rejected extends Error {}

function checked(answer) {
  if (answer.error !== undefined) throw new Rejected(answer.error);
  return answer;
}

/** Wraps the functions of an object of the library so that what it rejects is thrown. */
function checking(object, names) {
  return Object.fromEntries(names.map((name) => [name, (...args) => checked(object[name](...args))]));
}

export async function loadLibrary() {
  const wasm = new Blob([compressed]).stream().pipeThrough(new DecompressionStream("gzip"));
  const module = await loadContensou({ wasmBinary: await new Response(wasm).arrayBuffer() });
  const plane = new module.Plane();
  return {
    laws: module.laws(), bodies: module.bodies(), balls: module.catalogue(), rollingSlip: module.rollingSlip,
    plane: checking(plane, ["choose", "inside", "stop", "motion", "instant", "slide", "course", "isochrone", "checks"]),
    // Of the system that the plane has chosen.
    portrait: (request) => checked(module.portrait(request, plane)),
    ...checking(module, ["contact", "lawName", "portraitFile"]),
  };
}
