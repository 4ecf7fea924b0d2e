#include "io/cli/scene/cost_output.h"

#include "io/basics/inputs.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <cmath>

namespace viscard {
namespace {

// "AMD EPYC, 2 cores, load 1.3 before; this program got 93 % of a core".
std::string text_of_machine(const CostMachine& machine) {
  return fmt::format("{}, {}, load {:.1f} before; this program got {:.0f} % of a core",
                     machine.processor.empty() ? "processor unknown" : machine.processor,
                     counted(static_cast<std::size_t>(machine.cores), "core"), machine.load,
                     100.0 * machine.share);
}

void print_rows(const CostStudy& study, std::ostream& out) {
  out << fmt::format("  {:<36} {:<28} {:>8} {:>10} {:>10} {:>8} {:>9}\n", "discretisation",
                     "effects", "unknowns", "CPU (ms)", "wall (ms)", "MB", "error");
  for (const CostRow& row : study.rows) {
    out << fmt::format("{} {:<36} {:<28} {:>8} {:>10.3g} {:>10.3g} {:>8.2f} {:>9.1e}\n",
                       row.is_on_front ? "*" : " ", row.discretisation, row.effects, row.unknowns,
                       1e3 * row.cpu_s, 1e3 * row.wall_s, 1e-6 * row.memory_B, row.error);
  }
  for (const PredictedRow& row : study.predicted) {
    out << fmt::format("~ {:<36} {:<28} {:>8.0f} {:>10.2g} {:>10} {:>8.2g} {:>9}\n",
                       row.discretisation, row.effects, row.unknowns, 1e3 * row.cpu_s, "-",
                       1e-6 * row.memory_B, "-");
  }
  for (const FailedRow& row : study.failed) {
    out << fmt::format("- {:<36} {:<28} no answer: {}\n", row.discretisation, row.effects,
                       row.reason);
  }
}

void print_legend(const CostStudy& study, std::ostream& out) {
  out << "  * on the Pareto front: nothing takes less processor time and is as accurate\n"
         "  effects: 'all on' leaves nothing out, so its error is that of the mesh; 'without ...' "
         "leaves out\n    one effect of the scene, 'as planned' those that viscard plan leaves "
         "out; "
         "their errors contain that\n";
  if (study.predicted.empty()) return;
  out << fmt::format(
      "  ~ predicted: {} more did not fit into the budget of {:g} s; --budget gives more time\n",
      study.left_out, study.budget_s);
  for (const CostLaw& law : study.laws) {
    const std::string fixed = law.fixed_s > 0.0 ? fmt::format("{:.2g} s + ", law.fixed_s) : "";
    out << fmt::format("    {}: CPU time about {}{:.1e} s x unknowns^{:.2f}\n", law.kind, fixed,
                       law.seconds, law.exponent);
  }
}

}  // namespace

std::string csv_from_study(const CostStudy& study, const std::string& command) {
  std::string text = fmt::format(
      "{}# {}\n"
      "discretisation,effects,unknowns,wall_s,memory_B,error,pareto,cpu_s,predicted\n",
      head_of_table(command), text_of_machine(study.machine));
  for (const CostRow& row : study.rows) {
    text += fmt::format("\"{}\",\"{}\",{},{},{},{},{},{},0\n", row.discretisation, row.effects,
                        row.unknowns, row.wall_s, row.memory_B, row.error, row.is_on_front ? 1 : 0,
                        row.cpu_s);
  }
  for (const PredictedRow& row : study.predicted) {
    text += fmt::format("\"{}\",\"{}\",{:.0f},,{:.0f},,0,{:.3g},1\n", row.discretisation,
                        row.effects, row.unknowns, row.memory_B, row.cpu_s);
  }
  return text;
}

void print_study(const CostStudy& study, const std::string& path, std::ostream& out) {
  out << fmt::format("{}; reference {}, {}\non {}\n", path, study.reference,
                     std::isfinite(study.reference_error)
                         ? fmt::format("known to {:.1e}", study.reference_error)
                         : "whose error is not known: " + study.why_alone,
                     text_of_machine(study.machine));
  print_rows(study, out);
  print_legend(study, out);
  if (const auto linear = factor_over_linear(study, 1e-3)) {
    out << fmt::format("linear elements need {:.3g} times the time of {} for an error of 0.1 %{}\n",
                       linear->factor, linear->quickest,
                       linear->is_extrapolated ? " (extrapolated from the two finest)" : "");
  }
  out << "recommended for a tolerance of (processor time)\n";
  for (const CostAdvice& advice : study.advice) out << "  " << advice.text << "\n";
  for (const std::string& note : study.notes) out << "  note: " << note << "\n";
}

}  // namespace viscard
