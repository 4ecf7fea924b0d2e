#include "io/python/values.h"

#include "io/basics/json_string.h"
#include "io/python/parts.h"

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

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

py::array matrix_array(const Eigen::MatrixXd& matrix) {
  py::array_t<double> array({matrix.rows(), matrix.cols()});
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) array.mutable_at(i, j) = matrix(i, j);
  }
  return array;
}

class PythonWriter : public ResultVisitor {
 public:
  explicit PythonWriter(py::dict object) : within_{std::move(object)} {}
  bool is_in_memory() const override { return true; }
  void document(std::string_view key, const std::string& json, const char* /*what*/) override {
    set(key, value_of(ordered_json_from_text(json)));
  }
  void documents(std::string_view key, const std::vector<std::string>& json,
                 const char* /*what*/) override {
    py::list list;
    for (const std::string& one : json) list.append(value_of(ordered_json_from_text(one)));
    set(key, list);
  }

 protected:
  void number(std::string_view key, double value, const char* /*what*/) override {
    set(key, py::float_(value));
  }
  void whole(std::string_view key, std::int64_t value, const char* /*what*/) override {
    set(key, py::int_(value));
  }
  void flag(std::string_view key, bool value, const char* /*what*/) override {
    set(key, py::bool_(value));
  }
  void text(std::string_view key, const std::string& value, const char* /*what*/,
            const std::vector<const char*>* /*words*/) override {
    set(key, text_of(value));
  }
  void pair(std::string_view key, const Interval& value, const char* /*what*/) override {
    set(key, py::make_tuple(value.low, value.high));
  }
  void numbers(std::string_view key, const std::vector<double>& values,
               const char* /*what*/) override {
    set(key, array_of(std::vector<double>(values)));
  }
  void wholes(std::string_view key, const std::vector<std::int64_t>& values,
              const char* /*what*/) override {
    set(key, array_of(std::vector<std::int64_t>(values)));
  }
  void texts(std::string_view key, const std::vector<std::string>& values,
             const char* /*what*/) override {
    py::list list;
    for (const std::string& value : values) list.append(text_of(value));
    set(key, list);
  }
  void flags(std::string_view key, const std::vector<bool>& values, const char* /*what*/) override {
    py::array_t<bool> array(static_cast<py::ssize_t>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
      array.mutable_at(static_cast<py::ssize_t>(i)) = values[i];
    }
    set(key, array);
  }
  void matrix(std::string_view key, const Eigen::MatrixXd& values, const char* /*what*/) override {
    set(key, matrix_array(values));
  }
  void null(std::string_view key) override { set(key, py::none()); }
  void open(Part part, std::string_view key, const char* /*what*/) override {
    const py::object opened = part == Part::kList ? py::object(py::list()) : py::object(py::dict());
    if (part == Part::kEntry) {
      within_.back().attr("append")(opened);
    } else {
      set(key, opened);
    }
    within_.push_back(opened);
  }
  void close() override { within_.pop_back(); }

 private:
  static py::object text_of(
      const std::string& value) {  // messages may quote bytes that are not UTF-8
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(value.data(), static_cast<py::ssize_t>(value.size()), "replace"));
  }
  void set(std::string_view key, const py::object& value) {
    within_.back()[py::str(key.data(), key.size())] = value;
  }
  std::vector<py::object> within_;
};

py::object json_of(const PythonResult& result) {
  nlohmann::ordered_json json{
      {"schema", result.schema}, {"version", VISCARD_VERSION}, {"inputs", result.inputs}};
  json.update(json_from_keys(result.show));
  return to_python(json);
}

}  // namespace

py::object to_python(const nlohmann::json& json) {
  return value_of(json);
}

py::object to_python(const nlohmann::ordered_json& json) {
  return value_of(json);
}

py::dict values_from_keys(const ShowKeys& show) {
  py::dict object;
  PythonWriter writer(object);
  show(writer);
  return object;
}

void add_results(py::module_& module) {
  py::class_<PythonResult>(module, "Result")
      .def("json", &json_of)
      .def("values", [](const PythonResult& result) { return values_from_keys(result.show); })
      .def("text",
           [](const PythonResult& result) { return result.text ? result.text() : std::string(); });
}

}  // namespace viscard::python
