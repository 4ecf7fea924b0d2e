#include "io/basics/atomic_file.h"
#include "io/flow/design/closed_form.h"
#include "io/flow/design/judge_scene.h"
#include "io/flow/design/judgement_output.h"
#include "io/flow/optimise/optimised_output.h"
#include "io/options/option.h"
#include "io/python/job.h"
#include "io/python/keywords.h"
#include "io/python/parts.h"
#include "io/python/values.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>

namespace viscard::python {
namespace {

namespace py = pybind11;

// viscard design --require.
PythonResult design_scene(const std::optional<std::string>& text, const std::string& path,
                          const std::optional<std::string>& require_text,
                          const std::string& require_path, std::optional<double> tolerance,
                          const py::object& search_time, const py::object& progress) {
  const double search_s = quantity_from("search_time", search_time, "s").value_or(60.0);
  if (search_s < 0.0) {
    throw OptionError("search_time is " + fmt::format("{:g}", search_s) +
                      " s; it must not be negative, such as 60s");
  }
  const auto found = in_background({.progress = progress}, [=](Job& job) {
    const Requirements requirements = require_text
                                          ? requirements_from_toml(*require_text, require_path)
                                          : read_requirements(require_path);
    JudgeOptions options;
    options.tolerance = tolerance;
    options.search_s = search_s;
    options.progress = [&](double done, const std::string& what) { job.report(done, what); };
    return std::make_shared<const Judgement>(
        judge_scene(text ? *text : read_file(path), path, requirements, options));
  });
  return {"viscard-design-judge/1",
          {path, require_path},
          [found](ResultVisitor& v) { show_keys(v, *found); },
          [found] { return text_from_judgement(*found); }};
}

// viscard design SPEC.
PythonResult design_of_spec(const std::string& path, const py::object& progress) {
  struct Found {
    DesignSpec spec;
    DesignFront front;
  };
  const auto found = in_background({.progress = progress}, [=](Job& job) {
    const DesignSpec spec = read_design_spec(path);
    return std::make_shared<const Found>(Found{
        spec,
        design_front(spec, [&](double done, const std::string& what) { job.report(done, what); })});
  });
  return {"viscard-design-front/1",
          {path},
          [found](ResultVisitor& v) { show_front(v, found->spec, found->front); },
          [found] { return text_from_front(found->spec, found->front); }};
}

// viscard design without a scene.
PythonResult closed_form(const py::dict& keywords) {
  const auto given = [&](const char* name, const QuantityOrUnit& unit) -> std::optional<double> {
    std::string keyword = name;
    std::replace(keyword.begin(), keyword.end(), '-', '_');
    if (!keywords.contains(keyword)) return std::nullopt;
    const py::object typed = keywords[keyword.c_str()];
    const std::optional<double> value = quantity_from(keyword.c_str(), typed, unit);
    if (value) refuse_negative(keyword, *value, py::str(typed));
    return value;
  };
  std::optional<std::string> lattice;
  if (keywords.contains("lattice")) lattice = text_from("lattice", keywords["lattice"]);
  try {
    const ClosedFormDesign design = closed_form_design(given, lattice);
    return {"viscard-design/1",
            {},
            [design](ResultVisitor& v) { show_keys(v, design); },
            [design] { return text_from_design(design); }};
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
}

}  // namespace

void add_designs(py::module_& module) {
  module.def("design", &design_scene);
  module.def("design_limits", &closed_form);
  module.def("design_of_spec", &design_of_spec);
}

}  // namespace viscard::python
