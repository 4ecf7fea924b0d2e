#include "io/basics/atomic_file.h"
#include "io/cost/effect_savings.h"
#include "io/cost/study_cost.h"
#include "io/flow/scenes/answer_scene.h"
#include "io/flow/scenes/compared_answers.h"
#include "io/flow/scenes/named_values.h"
#include "io/flow/scenes/scene_uncertainty.h"
#include "io/pictures/scene_picture.h"
#include "io/python/job.h"
#include "io/python/keywords.h"
#include "io/python/parts.h"
#include "io/python/values.h"
#include "models/answer/effect_estimate.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <memory>

namespace viscard::python {
namespace {

namespace py = pybind11;
constexpr double kNoPillar = std::numeric_limits<double>::quiet_NaN();

// A scene of a file, or from text that Python has composed of a dict.
SceneFile scene_of(const std::optional<std::string>& text, const std::string& path,
                   std::optional<double> tolerance, const std::string& plausible) {
  const Plausible judged = judged_by(plausible, Plausible::kScene);
  SceneFile file = text ? scene_from_toml(*text, path, {}, judged) : read_scene(path, judged);
  if (tolerance) set_tolerance(*tolerance, file.scene);
  return file;
}

py::list modes_list(const SceneAnswer& answer) {
  const std::vector<NamedValue> named = named_values(answer);  // the modes stand behind the results
  py::list out;
  for (std::size_t i = 0; i < answer.modes.size(); ++i) {
    const SceneMode& mode = answer.modes[i];
    py::dict one;
    one["name"] = named[answer.results.size() + i].name;
    one["family"] = mode.family;
    one["harmonic"] = mode.harmonic;
    one["frequency_Hz"] = mode.frequency_Hz;
    one["error_estimate"] = mode.error_estimate;
    one["damping_ratio"] = mode.damping_ratio;
    out.append(one);
  }
  return out;
}

py::dict curves_dict_of(std::vector<SceneCurve>& curves) {
  py::dict out;
  for (SceneCurve& curve : curves) {
    py::dict one;
    one["unit"] = curve.unit;
    one["x_name"] = curve.x_name;
    one["x"] = array_of(std::move(curve.x));
    one["value"] = array_of(std::move(curve.value));
    one["error"] = array_of(std::move(curve.error));
    out[py::str(curve.name)] = one;
  }
  return out;
}

// rows x columns, NaN where no pillar has a value.
py::array matrix_of(const SceneArray& array, const SceneMap& map, const std::vector<double>& from) {
  py::array_t<double> matrix({array.rows, array.columns});
  for (int i = 0; i < array.rows; ++i) {
    for (int j = 0; j < array.columns; ++j) matrix.mutable_at(i, j) = kNoPillar;
  }
  for (std::size_t at = 0; at < map.pillar.size() && at < from.size(); ++at) {
    const ScenePillar& one = array.pillars[map.pillar[at]];
    matrix.mutable_at(one.row - 1, one.column - 1) = from[at];
  }
  return matrix;
}

py::dict maps_dict(const SceneAnswer& answer) {
  py::dict out;
  for (const SceneMap& map : answer.maps) {
    py::dict one;
    one["unit"] = map.unit;
    one["value"] = matrix_of(answer.array, map, map.value);
    one["error"] = matrix_of(answer.array, map, map.error);
    out[py::str(map.name)] = one;
  }
  return out;
}

// Points x components: three of a displacement (r, theta, z), one of a scalar.
py::array field_matrix(const SectionField& field) {
  const py::ssize_t n_components = field.is_vector ? 3 : 1;
  const auto n_points = static_cast<py::ssize_t>(field.value.size());
  py::array_t<double> matrix({n_points, n_components});
  for (py::ssize_t i = 0; i < n_points; ++i) {
    for (py::ssize_t j = 0; j < n_components; ++j) {
      matrix.mutable_at(i, j) =
          field.value[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  return matrix;
}

py::list fields_list(std::vector<SectionGrid> grids) {
  py::list out;
  for (SectionGrid& grid : grids) {
    py::dict one;
    one["name"] = grid.name;
    one["harmonic"] = grid.harmonic;
    py::array_t<int> quads({static_cast<py::ssize_t>(grid.quads.size()), py::ssize_t{4}});
    for (std::size_t i = 0; i < grid.quads.size(); ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        quads.mutable_at(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(j)) =
            grid.quads[i][j];
      }
    }
    one["quads"] = quads;
    py::dict fields;
    for (const SectionField& field : grid.fields) {
      py::dict values;
      values["unit"] = field.unit;
      values["value"] = field_matrix(field);
      fields[py::str(field.name)] = values;
    }
    one["values"] = fields;
    one["x_m"] = array_of(std::move(grid.x_m));
    one["z_m"] = array_of(std::move(grid.z_m));
    out.append(one);
  }
  return out;
}

struct SceneOutcome {
  SceneAnswer answer;
  double tolerance = 0.0;  // relative
  std::optional<SceneUncertainty> uncertainty;
  std::optional<ComparedAnswers> compared;
  std::vector<SectionGrid> fields;
};

// The scene to compare with, before any work.
std::optional<OtherScene> other_of(const std::optional<std::string>& compare, const SceneFile& file,
                                   const std::string& path, std::optional<double> tolerance,
                                   const std::string& plausible) {
  try {
    return other_scene(compare, file, path, tolerance, judged_by(plausible, Plausible::kScene));
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
}

py::dict simulate_scene(const std::optional<std::string>& text, const std::string& path,
                        std::optional<double> tolerance, bool with_fields, bool with_uncertainty,
                        std::optional<std::size_t> samples,
                        const std::optional<std::string>& compare, const std::string& plausible,
                        const py::object& progress) {
  SceneOutcome found = in_background({.progress = progress}, [=](Job& job) {
    const SceneFile file = scene_of(text, path, tolerance, plausible);
    const std::optional<OtherScene> other = other_of(compare, file, path, tolerance, plausible);
    SceneOutcome outcome;
    outcome.tolerance = common(file.scene).tolerance;
    outcome.answer = answer_scene(
        file, path, [&](double done, const std::string& point) { job.report(done, point); });
    add_notes_of_file(file, outcome.answer);
    if (other) {
      const SceneAnswer beside =
          answer_scene(other->file, other->path,
                       [&](double done, const std::string& point) { job.report(done, point); });
      outcome.compared =
          compare_answers({file.scene, outcome.answer}, {other->file.scene, beside}, other->path);
    }
    if (with_fields && file.sweep.is_empty()) {
      outcome.fields = solution_fields(file.scene, outcome.answer.discretisation);
    }
    if (with_uncertainty) {
      const UncertainScene scene(file, text ? *text : read_file(path), path);
      outcome.uncertainty = scene_uncertainty(scene, outcome.answer,
                                              {.n_samples = samples, .progress = [&](double done) {
                                                 job.report(done, "uncertainty");
                                               }});
    }
    return outcome;
  });
  SceneAnswer& answer = found.answer;
  py::dict out, results;
  for (const SceneResult& result : answer.results) {
    results[py::str(result.name)] =
        py::make_tuple(result.value, result.unit, result.error_estimate);
  }
  out["results"] = results;
  out["modes"] = modes_list(answer);
  out["tolerance"] =
      values_from_keys([&](ResultVisitor& v) { show_tolerance(v, answer, found.tolerance); });
  out["effects"] = values_from_keys([&](ResultVisitor& v) {
    v("effects", answer.effects, "every effect and why it is on or off");
  })["effects"];
  out["maps"] = maps_dict(answer);
  out["curves"] = curves_dict_of(answer.curves);
  out["x_m"] = array_over(answer.array.pillars, [](const ScenePillar& p) { return p.x_m; });
  out["y_m"] = array_over(answer.array.pillars, [](const ScenePillar& p) { return p.y_m; });
  out["notes"] = answer.notes;
  out["unknowns"] = answer.unknowns;
  out["fields"] = fields_list(std::move(found.fields));
  out["compared"] = py::none();
  if (found.compared) {
    out["compared"] = values_from_keys([&](ResultVisitor& v) { show_keys(v, *found.compared); });
  }
  out["uncertainty"] = py::none();
  if (found.uncertainty) {
    out["uncertainty"] =
        values_from_keys([&](ResultVisitor& v) { show_keys(v, *found.uncertainty); });
  }
  return out;
}

// Reads and plans a scene; nothing is solved.
py::dict check_scene(const std::optional<std::string>& text, const std::string& path,
                     const std::string& name, const std::string& plausible) {
  const Scene scene = scene_of(text, path, std::nullopt, plausible).scene;
  with_lines_of(path, [&] { return checked_plan(scene); });
  py::dict out;
  out["kind"] = kind_of(scene);
  out["svg"] = svg_from_scene(scene, name);
  return out;
}

PythonResult plan_scene(const std::optional<std::string>& text, const std::string& path,
                        std::optional<double> tolerance, const std::string& plausible) {
  const auto found = in_background({}, [=](Job& job) {
    const Scene scene = scene_of(text, path, tolerance, plausible).scene;
    const ScenePlan plan = with_lines_of(path, [&] { return checked_plan(scene); });
    auto shown = std::make_shared<ShownPlan>(ShownPlan{
        plan.effects, {}, plan.left_out, common(scene).tolerance, common(plan.reduced).tolerance});
    job.report(0.5, "plan");
    try {
      shown->savings = effect_savings(scene);
    } catch (const std::runtime_error&) {  // the plan itself solves nothing and stands
    }
    return shown;
  });
  return {"viscard-plan/1", {path}, [found](ResultVisitor& v) { show_keys(v, *found); }, {}};
}

PythonResult cost_scene(const std::optional<std::string>& text, const std::string& path,
                        const py::object& budget, const py::object& cpu_budget,
                        const std::string& plausible, const py::object& progress) {
  const auto positive = [](const char* name, const py::object& value) {
    const std::optional<double> s = quantity_from(name, value, "s");
    if (s && !(*s > 0.0)) {
      throw OptionError(fmt::format("{} is {:g} s; it must be positive, such as 60s", name, *s));
    }
    return s;
  };
  const double budget_s = positive("budget", budget).value_or(60.0);
  const std::optional<double> cpu_budget_s = positive("cpu_budget", cpu_budget);
  const auto study = in_background({.progress = progress}, [=](Job& job) {
    CostOptions options{.budget_s = budget_s, .cpu_budget_s = cpu_budget_s};
    options.progress = [&](double done, const std::string& row) { job.report(done, row); };
    const Scene scene = scene_of(text, path, std::nullopt, plausible).scene;
    return std::make_shared<const CostStudy>(
        with_lines_of(path, [&] { return study_cost(scene, options); }));
  });
  return {"viscard-cost/1", {path}, [study](ResultVisitor& v) { show_keys(v, *study); }, {}};
}

}  // namespace

void add_scenes(py::module_& module) {
  module.def("simulate", &simulate_scene);
  module.def("check_scene", &check_scene);
  module.def("plan", &plan_scene);
  module.def("cost", &cost_scene);
}

}  // namespace viscard::python
