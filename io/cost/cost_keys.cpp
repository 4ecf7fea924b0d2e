// The keys of plans and studies of cost.
#include "io/cost/effect_savings.h"
#include "io/cost/study_cost.h"
#include "models/maths/result_visitor.h"

#include <cmath>

namespace viscard {
namespace {

void show_mesh(ResultVisitor& v, const std::string& discretisation, const std::string& effects) {
  v("discretisation", discretisation, "mesh and steps");
  v("effects", effects, "which effects are on");
}

void show_row(ResultVisitor& v, const CostRow& row) {
  v("cpu_s", row.cpu_s, "processor time");
  show_mesh(v, row.discretisation, row.effects);
  v("error", row.error, "relative error");
  v("memory_B", row.memory_B, "memory");
  v("pareto", row.is_on_front, "whether nothing cheaper is as accurate");
  v("predicted", false, "false: it was run");
  v("unknowns", row.unknowns, "of the mesh");
  v("wall_s", row.wall_s, "time");
}

void show_predicted(ResultVisitor& v, const PredictedRow& row) {
  v("cpu_s", row.cpu_s, "processor time");
  show_mesh(v, row.discretisation, row.effects);
  v("memory_B", row.memory_B, "memory");
  v("predicted", true, "false: it was run");
  v("unknowns", std::round(row.unknowns), "of the mesh");
}

void show_laws(ResultVisitor& v, const CostStudy& study) {
  v.list("cost_laws", "time against unknowns", study.laws, [&](const CostLaw& law) {
    v("exponent", law.exponent, "of the unknowns");
    v("fixed_s", law.fixed_s, "that no mesh changes");
    v("kind", law.kind, "of what");
    v("seconds", law.seconds, "for one unknown");
  });
}

void show_linear_elements(ResultVisitor& v, const CostStudy& study) {
  const auto found = study.rows.empty() ? std::nullopt : factor_over_linear(study, 1e-3);
  const LinearFactor factor = found.value_or(LinearFactor{});
  v.object(
      "linear_elements", "what linear elements cost more; null: the rows do not show it",
      [&] {
        v("error", factor.error, "at this error");
        v("extrapolated", factor.is_extrapolated, "whether linear elements did not reach it");
        v("factor", factor.factor, "processor time over that of the quickest");
        v("quickest", factor.quickest, "the quickest");
      },
      !found);
}

void show_machine(ResultVisitor& v, const CostMachine& machine) {
  v.object("machine", "where it ran", [&] {
    v("cores", machine.cores, "their number");
    v("load", machine.load, "of the machine before");
    v("processor", machine.processor, "its name");
    v("processor_share", machine.share, "share of a core that the program got");
  });
}

}  // namespace

void show_keys(ResultVisitor& v, const ShownPlan& plan) {
  v("effects", plan.effects, "every effect and why it is on or off");
  v("left_out", plan.left_out, "sum of what is left out");
  v("mesh_tolerance", plan.mesh_tolerance, "what mesh and steps may take");
  v.list("savings", "what leaving out saves", plan.savings, [&](const EffectSaving& one) {
    v("cpu_s", one.cpu_s, "processor time with it");
    v("cpu_s_without", one.cpu_s_without, "without it");
    v("discretisation", one.discretisation, "on this mesh");
    v("effect", one.effect, "its name");
    v("unknowns", one.unknowns, "with it");
    v("unknowns_without", one.unknowns_without, "without it");
  });
  v("tolerance", plan.tolerance, "of the scene or --tol");
}

void show_keys(ResultVisitor& v, const CostStudy& study) {
  v("budget_s", study.budget_s, "time that was allowed");
  show_laws(v, study);
  show_linear_elements(v, study);
  show_machine(v, study.machine);
  v("notes", study.notes, "remarks, in words");
  v.list("predicted_rows", "what did not fit into the budget", study.predicted,
         [&](const PredictedRow& row) { show_predicted(v, row); });
  v.list("recommendations", "the cheapest for each tolerance", study.advice,
         [&](const CostAdvice& one) {
           v.or_null("row", one.row < 0 ? std::nullopt : std::optional(one.row),
                     "number in rows, from 0; null: none");
           v("text", one.text, "in words");
           v("tolerance", one.tolerance, "relative error");
         });
  v("reference", study.reference, "what errors are measured against");
  v("reference_error", study.reference_error, "its own error; null: not known");
  v.list("rows", "what was run", study.rows, [&](const CostRow& row) { show_row(v, row); });
  v("rows_left_out", study.left_out, "that the budget left out");
  v.list("rows_without_answer", "meshes that have no answer", study.failed,
         [&](const FailedRow& row) {
           show_mesh(v, row.discretisation, row.effects);
           v("reason", row.reason, "why it has none, in words");
         });
  v("tolerance", study.tolerance, "of the scene");
  v("wall_s", study.wall_s, "time that it took");
}

}  // namespace viscard
