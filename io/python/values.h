#pragma once

#include "io/results/result_json.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace viscard::python {

// Objects of --json as dict, list, float and None.
pybind11::object to_python(const nlohmann::json& json);
pybind11::object to_python(const nlohmann::ordered_json& json);

// Keys of a result as dict: numbers in arrays of numpy, intervals as (low, high), what does not exist as
// NaN, in intervals as infinity.
pybind11::dict values_from_keys(const ShowKeys& show);

// A result as Python keeps it; its values and its text are made when they are asked for.
struct PythonResult {
  std::string schema;  // "viscard-fit/1"
  std::vector<std::string> inputs;
  ShowKeys show;
  std::function<std::string()> text;  // what the command prints
};

// A numpy array that owns the vector; nothing is copied.
template <typename Number>
pybind11::array array_of(std::vector<Number> values) {
  auto* owned = new std::vector<Number>(std::move(values));
  const pybind11::capsule owner(owned,
                                [](void* it) { delete static_cast<std::vector<Number>*>(it); });
  return pybind11::array_t<Number>(static_cast<pybind11::ssize_t>(owned->size()), owned->data(),
                                   owner);
}

// One field of all rows as a numpy array. It looks into the rows, which `owner` keeps alive.
template <typename Row, typename Number>
pybind11::array field_array(const std::vector<Row>& rows, Number Row::*field,
                            const pybind11::handle& owner) {
  const Number* first = rows.empty() ? nullptr : &(rows.front().*field);
  return pybind11::array_t<Number>({static_cast<pybind11::ssize_t>(rows.size())},
                                   {static_cast<pybind11::ssize_t>(sizeof(Row))}, first, owner);
}

// value(row) of all rows.
template <typename Row, typename Value>
auto array_over(const std::vector<Row>& rows, const Value& value) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Row& row : rows) values.push_back(value(row));
  return array_of(std::move(values));
}

// The class of results in Python.
void add_results(pybind11::module_& module);

}  // namespace viscard::python
