#include "io/flow/scenes/scene_uncertainty.h"
#include "models/maths/result_visitor.h"

namespace viscard {
namespace {

void show_causes(ResultVisitor& v, const ResultUncertainty& result, const SceneUncertainty& all) {
  std::size_t i = 0;
  v.list("causes", "one for each input", result.causes, [&](const CauseShare& cause) {
    v("input", i < all.inputs.size() ? all.inputs[i].name : "", "its name");
    v("share", cause.share, "of the input alone");
    v("share_standard_error", cause.standard_error, "of a sampled share");
    v("share_with_others", cause.with_others, "also jointly with others");
    ++i;
  });
}

void show_result(ResultVisitor& v, const ResultUncertainty& result, const SceneUncertainty& all) {
  show_causes(v, result, all);
  v("interval_95", result.interval_95, "[low, high]; [null, null]: there is none");
  v("interval_end_error", result.end_error, "standard error of the ends, of a sampled interval");
  v("linear_disagreement", result.linear_disagreement,
    "of the linear answer at the ends of the intervals, in the unit; null: no answer there");
  v("name", result.name, "its name");
  v.when(!result.no_interval.empty(), [&] {
    v("no_interval", result.no_interval, "why there is none; absent if there is one");
  });
  v("numerical_error", result.numerical_error, "of the computation; not part of the interval");
  v("share_jointly", share_jointly(result), "of several inputs together");
  v("standard_uncertainty", result.standard_uncertainty, "in the unit");
  v("unit", result.unit, "its unit");
  v("value", result.value, "with every input at its value");
}

}  // namespace

double share_jointly(const ResultUncertainty& result) {
  double rest = result.standard_uncertainty > 0.0 ? 1.0 : 0.0;
  for (const CauseShare& cause : result.causes) rest -= cause.share;
  return rest;
}

void show_keys(ResultVisitor& v, const SceneUncertainty& uncertainty) {
  std::size_t i = 0;
  v("answers", uncertainty.n_answers, "of the scene that were computed");
  v("derivative_error", uncertainty.slope_error, "largest, relative to the standard uncertainty");
  v("failed", uncertainty.n_failed,
    "samples without an answer, which count as beyond either end of an interval");
  v("failed_share", uncertainty.failed_share,
    "of the samples of the intervals; above 0.025 there is no interval");
  v("first_order_answers", uncertainty.n_first_order,
    "that reuse the solution, for derivatives; not among answers");
  v.list("inputs", "the causes", uncertainty.inputs, [&](const UncertainInput& input) {
    const bool is_given = i < uncertainty.inputs.size();
    v.word("derivatives", is_given && uncertainty.by_solver[i] ? "solver" : "differences",
           {"solver", "differences"},
           "from one solution that the solver reuses, or differences of whole answers");
    v("name", input.name, "key in the scene, or part of a material file");
    v("text", is_given ? uncertainty.descriptions[i] : "", "value and spread");
    ++i;
  });
  v.object("mesh", "that was sampled on", [&] {
    v("degree", uncertainty.mesh.degree, "of the elements");
    v("error", uncertainty.mesh_error, "of deviations on it, relative to the standard uncertainty");
    v("layers", uncertainty.mesh.layers, "at the rim");
  });
  v.word("method", uncertainty.method(), {"linear", "quadratic", "sobol"},
         "linear in the inputs, quadratic (or the logarithm is), or sampled on a Sobol' sequence");
  v("notes", uncertainty.notes, "what to keep in mind");
  v("reason", uncertainty.reason, "why");
  v.list("results", "results and frequencies of modes", uncertainty.results,
         [&](const ResultUncertainty& result) { show_result(v, result, uncertainty); });
}

}  // namespace viscard
