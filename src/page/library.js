// The C++ library, compiled to WebAssembly; bindings.cpp says what each function answers, and throws what it rejects.
import loadContensou from "contensou";
import { described } from "./plane/views.js";

/** @returns {Promise<Library>} */
export async function loadLibrary() {
  const module = await loadContensou({ wasmBinary: await globalThis.contensouWasm });
  return {
    ...module, laws: module.laws(), bodies: module.bodies(), balls: module.catalogue(), views: module.views().map(described), plane: new module.Plane(),
  };
}
