#include "values.hpp"

PYBIND11_MODULE(_core, module) {
  module.attr("__version__") = CONTENSOU_VERSION;
  contensou::python::bind_reduction(module);
  contensou::python::bind_planar(module);
  contensou::python::bind_si(module);
  contensou::python::bind_portraits(module);
  contensou::python::bind_fit(module);
}
