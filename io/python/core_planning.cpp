#include "io/basics/units.h"
#include "io/flow/planning/study_output.h"
#include "io/flow/words/option_error.h"
#include "io/python/job.h"
#include "io/python/keywords.h"
#include "io/python/parts.h"

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

namespace viscard::python {
namespace {

namespace py = pybind11;

// The tests that `viscard cost --rig` compares: its JSON, its advice and its test file as texts.
py::dict cost_of_tests(const std::string& rig, const std::string& specimen,
                       const std::vector<std::string>& want, const std::optional<std::string>& test,
                       const std::optional<std::string>& guess,
                       const std::optional<std::string>& scene, const py::object& at_most) {
  TestStudyRequest request{.rig = rig, .specimen = specimen, .test = test, .guess = guess};
  request.scene = scene;
  request.want = want;
  if (want.empty()) throw OptionError("what is wanted? Give for instance want=[\"E0=1%\"]");
  request.longest_s = si_from_text(text_from("at_most", at_most).value_or("60min"), "s");
  const TestStudy study = in_background({}, [request](Job&) { return study_tests(request); });
  py::dict out;
  out["json"] = json_from_test_study(study).dump();
  out["advice"] = advice_of(study);
  out["test"] = study.protocols.advised ? toml_of_advice(study, "viscard.cost_of_tests") : "";
  return out;
}

}  // namespace

void add_planning(py::module_& module) {
  module.def("cost_of_tests", &cost_of_tests);
}

}  // namespace viscard::python
