#include "io/basics/atomic_file.h"
#include "io/basics/timestamp.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/unit_system.h"
#include "io/flow/command_error.h"
#include "io/flow/fit_file.h"
#include "io/flow/planning/next_test.h"
#include "io/flow/read_report.h"
#include "io/flow/test_words.h"
#include "io/flow/words/fit_text.h"
#include "io/materials/material_file.h"
#include "io/python/job.h"
#include "io/python/keywords.h"
#include "io/python/parts.h"
#include "io/python/values.h"
#include "io/report/report.h"
#include "models/maths/failure_text.h"

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

#include <map>
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

// What to measure next after the fit of a capture.
py::dict next_test(const std::string& path, const std::vector<std::string>& want,
                   const py::dict& keywords) {
  const FitWords words = fit_words_from(keywords);
  const FitRequest request = fit_request(words);
  const auto next = in_background({}, [=](Job&) {
    const FittedFile fitted = fit_file(path, request);
    return next_after_capture(path, fitted.result, fitted.specimen, want);
  });
  py::dict out = values_from_keys([&](ResultVisitor& v) { v("measurements", next, "best first"); });
  out["text"] = text_of_next(next);
  return out;
}

// Writes the page about captures, tables and materials. Returns what is not to be trusted on it.
std::vector<std::string> report(const std::vector<std::string>& files, const std::string& page,
                                const py::dict& keywords, const py::object& progress) {
  const auto text = [&](const char* name) { return keywords[name].cast<std::string>(); };
  const auto texts = [&](const char* name) {
    return keywords[name].cast<std::vector<std::string>>();
  };
  const auto is_on = [&](const char* name) { return keywords[name].cast<bool>(); };
  const std::vector<std::string> cards = texts("cards");
  const std::string title = text("title"), units = text("units"), pictures = text("pictures");
  const bool overwrite = is_on("overwrite");
  ReportRequest request{.files = files,
                        .truth_files = texts("truth"),
                        .card_targets = cards,
                        .card_units = units,
                        .logo = text("logo")};
  request.command = "viscard.report()";
  request.plausible = judged_by(text("plausible"));
  request.accepts_unverified = is_on("unverified");
  if (!is_on("reproducible")) request.created_at = now_iso8601();
  try {
    sort_inputs(request);
    for (const std::string& target : cards) card_target(target);
    unit_system(units);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
  return in_background({.progress = progress}, [=](Job& job) {
    const ReportInput input = read_report(
        request, title, [&](double done, const std::string& what) { job.report(done, what); });
    const RenderedReport rendered = render_report(input);
    if (!pictures.empty()) write_report_pictures(rendered, pictures, overwrite);
    write_file(page, rendered.html, overwrite);
    return defects_of(input);
  });
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

// Tables of arrays by the name that stands for a file; null if there are none.
std::shared_ptr<const std::map<std::string, CsvTable>> in_memory(const py::dict& tables) {
  if (tables.empty()) return nullptr;
  auto found = std::make_shared<std::map<std::string, CsvTable>>();
  for (const auto& [name, arrays] : tables) {
    const auto file = name.cast<std::string>();
    found->emplace(file, table_from_arrays(arrays.cast<py::dict>(), file));
  }
  return found;
}

py::list fit_paths(std::vector<std::string> files, const py::dict& tables, const py::dict& keywords,
                   const std::string& command, const py::object& progress) {
  const FitWords words = fit_words_from(keywords);
  const std::vector<TestFile> tests = tests_given(files);
  if (!tests.empty()) files = paths_of(tests);
  refuse_contradictions(words, tests, files.size(), false);
  FitRequest request = fit_request(words);
  if (tests.size() == 1) request.kind = tests.front().kind;
  request.in_memory = in_memory(tables);
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

RatioFit fit_ratios(const std::vector<std::string>& files, const py::dict& tables,
                    const py::dict& keywords, const std::string& command,
                    const py::object& progress) {
  const FitWords words = fit_words_from(keywords);
  const std::vector<TestFile> tests = tests_given(files);
  refuse_contradictions(words, tests, files.size(), false);
  JointRequest request = joint_request(words, files, command);
  request.fit.in_memory = in_memory(tables);
  return in_background({.progress = progress}, [request](Job& job) mutable {
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
  module.def("fit_ratios", &fit_ratios);
  module.def("next_test", &next_test);
  module.def("report", &report);
  module.def("ratio_fit_from_json", [](const std::string& text, const std::string& name) {
    return ratio_fit_from_json(text, name);
  });
}

}  // namespace viscard::python
