// The C++ library, compiled to WebAssembly; bindings.cpp says what each function answers, and throws what it rejects.
import loadContensou from "contensou";
import { described } from "./plane/views.js";

/** @returns {Promise<Library>} */
export async function loadLibrary() {
  const module = await loadContensou({ wasmBinary: await globalThis.contensouWasm });
  const views = module.views().flatMap((view) => (view.name === "uv" ? [view, { ...view, name: "bent" }] : [view]));
  return {
    ...module, laws: module.laws(), bodies: module.bodies(), balls: module.catalogue(), views: views.map(described), plane: new module.Plane(),
  };
}
