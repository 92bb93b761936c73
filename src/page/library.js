// The C++ library, compiled to WebAssembly; bindings.cpp says what each function answers.

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
  const module = await globalThis.loadContensou();
  const plane = new module.Plane();
  return {
    laws: module.namesOfLaws(),
    largestExponent: module.largestExponent(),
    balls: module.catalogue(),
    plane: checking(plane, ["choose", "inside", "stop", "motion", "instant", "isochrone", "checks"]),
    // Of the system that the plane has chosen.
    portrait: (request) => checked(module.portrait(request, plane)),
    ...checking(module, ["contact", "roll", "place", "portraitFile"]),
  };
}
