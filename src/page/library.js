// The C++ library, compiled to WebAssembly. The file bindings.cpp describes the result and the errors of each function.
import loadContensou from "contensou";
import { described } from "./plane/views.js";

/** @returns {Promise<Library>} */
export async function loadLibrary() {
  const module = await loadContensou({ wasmBinary: await globalThis.contensouWasm });
  return {
    ...module, laws: module.laws(), bodies: module.bodies(), balls: module.catalogue(), views: module.views().map(described), plane: new module.Plane(),
  };
}
