#include "io/flow/planning/study_output.h"
#include "io/options/option.h"
#include "io/python/job.h"
#include "io/python/keywords.h"
#include "io/python/parts.h"
#include "io/python/values.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <memory>

namespace viscard::python {
namespace {

namespace py = pybind11;

// The tests that `viscard cost --rig` compares, and the test file that it advises.
py::dict cost_of_tests(const std::string& rig, const std::string& specimen,
                       const std::vector<std::string>& want, const std::optional<std::string>& test,
                       const std::optional<std::string>& guess,
                       const std::optional<std::string>& scene, const py::object& at_most) {
  TestStudyRequest request{.rig = rig, .specimen = specimen, .test = test, .guess = guess};
  request.scene = scene;
  request.want = want;
  if (want.empty()) throw OptionError("what is wanted? Give for instance want=[\"E0=1%\"]");
  request.longest_s = quantity_from("at_most", at_most, "s").value_or(3600.0);
  if (!(request.longest_s > 0.0)) {
    throw OptionError("at_most is " + fmt::format("{:g}", request.longest_s) +
                      " s; it must be positive, such as \"20 min\"");
  }
  const auto study = in_background(
      {}, [request](Job&) { return std::make_shared<const TestStudy>(study_tests(request)); });
  std::vector<std::string> inputs{rig, specimen};
  for (const auto& file : {test, guess, scene}) {
    if (file) inputs.push_back(*file);
  }
  py::dict out;
  out["result"] = PythonResult{"viscard-cost-tests/1", inputs,
                               [study](ResultVisitor& v) { show_keys(v, *study); },
                               [study] { return advice_of(*study); }};
  out["test"] = study->protocols.advised ? toml_of_advice(*study, "viscard.cost_of_tests") : "";
  return out;
}

}  // namespace

void add_planning(py::module_& module) {
  module.def("cost_of_tests", &cost_of_tests);
}

}  // namespace viscard::python
