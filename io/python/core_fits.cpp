#include "io/basics/failure_text.h"
#include "io/flow/command_error.h"
#include "io/flow/fit_file.h"
#include "io/flow/test_words.h"
#include "io/flow/words/fit_text.h"
#include "io/materials/material_file.h"
#include "io/python/job.h"
#include "io/python/keywords.h"
#include "io/python/parts.h"
#include "io/python/values.h"

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

#include <memory>
#include <sstream>
#include <variant>

namespace viscard::python {
namespace {

namespace py = pybind11;

// The material of one fit, or why there is none.
struct FitOutcome {
  std::string path;
  std::vector<std::string> inputs;
  std::optional<FittedFile> fitted;
  std::optional<Material> material;
  std::string no_material;
  std::exception_ptr error;
};

void add_material(const FitWords& words, const MaterialRequest& about, FitOutcome& outcome) {
  if (!outcome.fitted) return;
  try {
    outcome.material = material_from_fitted(*outcome.fitted, about);
    if (!words.ratio.empty()) outcome.material->mixing_ratio = words.ratio.front();
  } catch (const std::exception& error) {
    outcome.no_material = failure_text(error, "this material");
  }
}

py::dict error_dict(const std::exception_ptr& thrown) {
  py::dict out;
  try {
    std::rethrow_exception(thrown);
  } catch (const std::exception& error) {
    out = to_python(json_from_result(command_error(error)));
    out["text"] = error.what();
  }
  return out;
}

py::dict outcome_dict(FitOutcome outcome) {
  py::dict out;
  out["file"] = outcome.path;
  out["error"] = py::none();
  if (outcome.error) {
    out["error"] = error_dict(outcome.error);
    return out;
  }
  const auto fitted = std::make_shared<const FittedFile>(std::move(*outcome.fitted));
  out["result"] = PythonResult{"viscard-fit/1", std::move(outcome.inputs),
                               [fitted](ResultVisitor& v) { show_keys(v, *fitted); },
                               [fitted] {
                                 std::ostringstream text;
                                 print_fit(*fitted, text);
                                 return text.str();
                               }};
  out["material"] = outcome.material ? py::cast(*outcome.material) : py::object(py::none());
  out["no_material"] = outcome.no_material;
  return out;
}

py::list list_from(std::vector<FitOutcome> outcomes) {
  py::list out;
  for (FitOutcome& outcome : outcomes) out.append(outcome_dict(std::move(outcome)));
  return out;
}

std::vector<TestFile> tests_given(const std::vector<std::string>& files) {
  try {
    return tests_from_words(files);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
}

py::list fit_paths(std::vector<std::string> files, const py::dict& keywords,
                   const std::string& command, const py::object& progress) {
  const FitWords words = fit_words_from(keywords);
  const std::vector<TestFile> tests = tests_given(files);
  if (!tests.empty()) files = paths_of(tests);
  refuse_contradictions(words, tests, files.size(), false);
  FitRequest request = fit_request(words);
  if (tests.size() == 1) request.kind = tests.front().kind;
  const MaterialRequest about = material_request(words, command);
  return list_from(in_background({.progress = progress}, [=](Job& job) {
    const FlowProgress show = [&](double done, const std::string& file) { job.report(done, file); };
    std::vector<FitOutcome> outcomes;
    if (tests.size() > 1) {
      FittedFile fitted = fit_tests(tests, request, show);
      const std::string path = fitted.path;
      outcomes.push_back({.path = path, .inputs = files, .fitted = std::move(fitted)});
    } else {
      for (FileOutcome& one : fit_each_file(files, request, show)) {
        outcomes.push_back({.path = one.path,
                            .inputs = {one.path},
                            .fitted = std::move(one.fitted),
                            .error = one.error});
      }
    }
    for (FitOutcome& outcome : outcomes) add_material(words, about, outcome);
    return outcomes;
  }));
}

py::list fit_arrays(const py::dict& arrays, const std::string& name, const py::dict& keywords,
                    const std::string& command, const py::object& progress) {
  const FitWords words = fit_words_from(keywords);
  refuse_contradictions(words, {}, 1, false);
  if (words.joint) throw OptionError("--joint fits files; give their paths");
  const FitRequest request = fit_request(words);
  const MaterialRequest about = material_request(words, command);
  return list_from(
      in_background({.progress = progress}, [=, table = table_from_arrays(arrays, name)](Job& job) {
        std::vector<FitOutcome> outcomes(1);
        outcomes[0] = {.path = name, .inputs = {name}, .fitted = fit_values(table, request)};
        add_material(words, about, outcomes[0]);
        job.report(1.0, name);
        return outcomes;
      }));
}

RatioFit fit_ratios(const std::vector<std::string>& files, const py::dict& keywords,
                    const std::string& command, const py::object& progress) {
  const FitWords words = fit_words_from(keywords);
  const std::vector<TestFile> tests = tests_given(files);
  refuse_contradictions(words, tests, files.size(), false);
  return in_background(
      {.progress = progress}, [request = joint_request(words, files, command)](Job& job) mutable {
        request.progress = [&](double done, const std::string& file) { job.report(done, file); };
        return fit_jointly(request);
      });
}

}  // namespace

void add_fits(py::module_& module) {
  const py::class_<Material> opaque(module, "Material");
  py::class_<RatioFit>(module, "RatioFit")
      .def("to_json", [](const RatioFit& fit) { return json_from_ratio_fit(fit); })
      .def("law", [](const RatioFit& fit) { return law_in_words(fit); })
      .def("ratios", [](const RatioFit& fit) { return fit.best.ratios; })
      .def("at", [](const RatioFit& fit, double ratio, bool may_extrapolate) {
        return material_at_ratio(fit, ratio, may_extrapolate);
      });
  module.def("fit_paths", &fit_paths);
  module.def("fit_arrays", &fit_arrays);
  module.def("fit_ratios", &fit_ratios);
  module.def("ratio_fit_from_json", [](const std::string& text, const std::string& name) {
    return ratio_fit_from_json(text, name);
  });
}

}  // namespace viscard::python
