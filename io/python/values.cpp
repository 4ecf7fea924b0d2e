#include "io/python/values.h"

#include <nlohmann/json.hpp>

namespace viscard::python {
namespace {

namespace py = pybind11;

template <typename Json>
py::object value_of(const Json& json) {
  if (json.is_object()) {
    py::dict object;
    for (const auto& [key, value] : json.items()) object[py::str(key)] = value_of(value);
    return object;
  }
  if (json.is_array()) {
    py::list list;
    for (const auto& value : json) list.append(value_of(value));
    return list;
  }
  if (json.is_boolean()) return py::bool_(json.template get<bool>());
  if (json.is_number_integer()) return py::int_(json.template get<long long>());
  if (json.is_number()) return py::float_(json.template get<double>());
  if (json.is_string()) return py::str(json.template get_ref<const std::string&>());
  return py::none();
}

}  // namespace

py::object to_python(const nlohmann::json& json) {
  return value_of(json);
}

py::object to_python(const nlohmann::ordered_json& json) {
  return value_of(json);
}

py::array matrix_array(const Eigen::MatrixXd& matrix) {
  py::array_t<double> array({matrix.rows(), matrix.cols()});
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) array.mutable_at(i, j) = matrix(i, j);
  }
  return array;
}

}  // namespace viscard::python
