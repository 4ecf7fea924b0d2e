#include "io/flow/validation_keys.h"

#include "models/maths/result_visitor.h"
#include "models/pillar/validate_material.h"

namespace viscard {
namespace {

void show_curve(ResultVisitor& v, const ValidationCurve& curve, const std::string& quantity) {
  const auto show_answer = [&] { v(quantity, curve.solver, "answer of the solver"); };
  const bool is_first = quantity < "exact_";  // keys stand in the order of their names
  v("at_time_s", curve.at_time_s, "when");
  if (is_first) show_answer();
  v("exact_" + quantity, curve.exact, "exact answer");
  v("largest_relative_error", curve.largest_relative_error,
    "largest difference from the exact answer");
  v("solver_error_estimate", curve.solver_error_estimate, "what the solver estimated");
  v("steps", curve.steps, "time steps");
  if (!is_first) show_answer();
  v("time_s", curve.time_s, "times");
}

}  // namespace

void show_keys(ResultVisitor& v, const ValidationResult& result, const std::string& name) {
  v.object("creep", "the test of creep", [&] { show_curve(v, result.creep, "displacement_m"); });
  v("diameter_m", result.diameter_m, "of the pillar");
  v("exact_method", result.exact_method, "where the exact answer comes from");
  v("length_m", result.length_m, "of the pillar");
  v("material", name, "name of the material");
  v("max_error", result.tolerance, "largest relative error allowed");
  v("notes", result.notes, "what to keep in mind");
  v("passed", result.passed, "whether both tests are within max_error");
  v("pressure_Pa", result.pressure_Pa, "in creep");
  v.object("relaxation", "the test of relaxation",
           [&] { show_curve(v, result.relaxation, "stress_Pa"); });
  v("strain", result.strain, "in relaxation");
  v("unknowns", result.unknowns, "of the mesh");
}

}  // namespace viscard
