// The C++ library, compiled to WebAssembly; bindings.cpp says what each function answers, and throws what it rejects.
import loadContensou from "contensou";
import compressed from "contensou.wasm.gz";

export async function loadLibrary() {
  const wasm = new Blob([compressed]).stream().pipeThrough(new DecompressionStream("gzip"));
  const module = await loadContensou({ wasmBinary: await new Response(wasm).arrayBuffer() });
  const { contact, lawName, portraitFile, rollingSlip } = module;
  return {
    laws: module.laws(), bodies: module.bodies(), balls: module.catalogue(), views: module.views(), plane: new module.Plane(),
    contact, lawName, portraitFile, rollingSlip,
  };
}
