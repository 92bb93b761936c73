#include <string>
#include <utility>

#include "answers/input/errors.hpp"
#include "values.hpp"

namespace {

/// Returns a message of the library without names of functions of the library, and with arguments in place of options.
std::string in_words_of_python(std::string text) {
  text = contensou::answers::words_of(std::move(text));
  for (const auto& [words, instead] : {std::pair<std::string, const char*>{"fit: track t: ", ""},
                                       {"with --param ", "as "},
                                       {"--mu", "mu"},
                                       {"--slope 0", "slope=0"},
                                       {"--rolling-friction 0", "rolling_friction=0"}}) {
    if (const std::size_t at = text.find(words); at != std::string::npos) text.replace(at, words.size(), instead);
  }
  return text;
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  pybind11::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const std::domain_error& error) {
      PyErr_SetString(PyExc_ValueError, in_words_of_python(error.what()).c_str());
    } catch (const pybind11::builtin_exception&) {
      throw;
    } catch (const pybind11::error_already_set&) {
      throw;
    } catch (const std::exception& error) {
      if (!contensou::answers::is_fault(error)) throw;
      // pybind11 would raise an IndexError, a ValueError or an OverflowError, as if the input were wrong.
      PyErr_SetString(PyExc_RuntimeError, contensou::answers::message_of(error, "the call above").c_str());
    }
  });
  module.attr("__version__") = CONTENSOU_VERSION;
  contensou::python::bind_reduction(module);
  contensou::python::bind_planar(module);
  contensou::python::bind_si(module);
  contensou::python::bind_portraits(module);
  contensou::python::bind_fit(module);
}
