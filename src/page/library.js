// The C++ library, compiled to WebAssembly; bindings.cpp says what each function answers, and throws what it rejects.
import loadContensou from "contensou";

export async function loadLibrary() {
  const module = await loadContensou({ wasmBinary: await globalThis.contensouWasm });
  const { contact, fit, lawName, layOut, rollingSlip, rowsOf } = module;
  return {
    laws: module.laws(), bodies: module.bodies(), balls: module.catalogue(), views: module.views().flatMap((view) => (view.name === "uv" ? [view, { ...view, name: "bent" }] : [view])), plane: new module.Plane(),
    contact, fit, lawName, layOut, rollingSlip, rowsOf,
  };
}
