#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <Eigen/Core>

#include "contensou/si/description.hpp"
#include "text/nearest_name.hpp"

namespace contensou::python {

namespace py = pybind11;

/// Releases Python's lock while the library computes. A law in Python takes the lock for each call.
using Released = py::call_guard<py::gil_scoped_release>;

/// Numbers of any shape, in C order.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Ends a long computation, which runs without Python's lock, after a signal such as Ctrl-C. It looks every 0.1 s.
class Interruption {
 public:
  /// @throws py::error_already_set  KeyboardInterrupt, or another exception of a handler in Python
  void check() {
    if (++asked_ % 64 == 0) look();
  }

  /// Looks, unless it has looked less than 0.1 s before.
  void look() {
    const auto now = std::chrono::steady_clock::now();
    if (now - looked_ < std::chrono::milliseconds(100)) return;
    looked_ = now;
    const py::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

 private:
  unsigned asked_ = 0;
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
};

inline Eigen::ArrayXd column_of(const Numbers& values) {
  return Eigen::Map<const Eigen::ArrayXd>(values.data(), values.size());
}

/// Returns a list with the value of the function for each entry of a range.
template <class Range, class Function>
py::list list_of(const Range& range, Function value) {
  py::list list;
  for (const auto& entry : range) list.append(std::invoke(value, entry));
  return list;
}

/// Returns an array of the shape of `given`.
template <class Value>
py::array_t<Value> array_like(const Numbers& given) {
  return py::array_t<Value>(std::vector<py::ssize_t>(given.shape(), given.shape() + given.ndim()));
}

/// Returns an array of the shape of `given` with the value of the function for each number.
template <class Value, class Function>
py::array_t<Value> mapped(const Numbers& given, Function function) {
  auto result = array_like<Value>(given);
  const double* const from = given.data();
  Value* const to = result.mutable_data();
  const py::ssize_t size = given.size();
  const py::gil_scoped_release released;
  Interruption interruption;
  for (py::ssize_t i = 0; i < size; ++i) {
    interruption.check();
    to[i] = function(from[i]);
  }
  return result;
}

/// Returns the entry of a range that a name stands for.
/// @param kind   kind of the names, such as "law"
/// @param name   returns the name of an entry
/// @param more   further names for the message, such as families of laws
/// @throws std::domain_error  with a list of the names, if the name is not among them
template <class Range, class Name>
auto entry_of(std::string_view kind, const Range& range, Name name, const std::string& typed,
              const std::vector<std::string>& more = {}) {
  std::vector<std::string> names;
  for (const auto& entry : range) {
    names.emplace_back(std::invoke(name, entry));
    if (names.back() == typed) return entry;
  }
  names.insert(names.end(), more.begin(), more.end());
  throw std::domain_error(no_such(kind, typed, names));
}

/// Returns the value that a name stands for. Throws as entry_of.
template <class Value>
Value one_of(std::string_view kind, const std::vector<std::pair<std::string, Value>>& choices,
             const std::string& typed) {
  return entry_of(kind, choices, &std::pair<std::string, Value>::first, typed).second;
}

/// Returns the fields of Python's Ball.
py::dict fields_of(const si::Description& described);

void bind_reduction(py::module_& module);
void bind_planar(py::module_& module);
void bind_si(py::module_& module);
void bind_portraits(py::module_& module);
void bind_fit(py::module_& module);

}  // namespace contensou::python
