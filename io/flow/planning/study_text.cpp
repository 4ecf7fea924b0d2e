// The text of a study of tests: its table, its advice, and the limits that no test can change.
#include "io/flow/planning/study_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace viscard {
namespace {

std::string percent(double relative) {
  return fmt::format("{:.2g} %", 100.0 * relative);
}

std::string touches_text(int n) {
  return n == 1 ? "one touch" : fmt::format("{} touches", n);
}

// "depth 0.13 mm in 1 s, hold 60 s, back to 10 % for 20 s".
std::string text_of_plan(const TestPlan& plan) {
  if (plan.protocol != "ramp-hold") return plan.name + " (" + plan.protocol + ")";
  std::string text = fmt::format("depth {:.3g} mm in {:g} s, hold {:g} s", 1e3 * plan.depth_m,
                                 plan.ramp_s, plan.hold_s);
  if (plan.recovery_s > 0.0) {
    text += fmt::format(", back to {:.0f} % for {:g} s", 100.0 * plan.unload_to_fraction,
                        plan.recovery_s);
  }
  return text;
}

std::string errors_text(const ProtocolStudy& study, const ProtocolRow& row) {
  std::string text;
  for (std::size_t i = 0; i < study.wanted.size(); ++i) {
    text += fmt::format("{}{} +- {} (noise {})", i > 0 ? ", " : "", study.wanted[i].name,
                        percent(row.errors[i].half_width_95()),
                        percent(row.errors[i].without_systematic_95()));
  }
  return text;
}

// The largest of the parts that no test changes.
struct NamedHalfWidth {
  double half_width = 0.0;
  std::string cause, remedy;
};

NamedHalfWidth largest_part(const ErrorCauses& causes) {
  const NamedHalfWidth parts[] = {{kNormal95 * causes.frame, "the frame's stiffness",
                                   "measure it better (viscard calibrate --compliance)"},
                                  {kNormal95 * causes.calibration, "the load cell's calibration",
                                   "calibrate it better (viscard calibrate)"},
                                  {kNormal95 * causes.geometry, "the geometry of punch and layer",
                                   "measure punch and layer better, or pour a thicker layer"}};
  return *std::max_element(
      std::begin(parts), std::end(parts),
      [](const NamedHalfWidth& a, const NamedHalfWidth& b) { return a.half_width < b.half_width; });
}

}  // namespace

std::vector<std::string> limits_of(const TestStudy& study) {
  const ProtocolStudy& protocols = study.protocols;
  std::vector<std::string> limits;
  for (std::size_t i = 0; i < protocols.wanted.size(); ++i) {
    if (!protocols.is_beyond_reach[i] || protocols.rows.empty()) continue;
    const NamedHalfWidth part = largest_part(protocols.rows.front().errors[i]);
    limits.push_back(fmt::format(
        "{}: {} alone makes +- {}, so no test reaches {}; {}. The tests are compared without the "
        "systematic parts of {}",
        protocols.wanted[i].name, part.cause, percent(part.half_width),
        percent(protocols.wanted[i].tolerance), part.remedy, protocols.wanted[i].name));
  }
  if (protocols.loses_terms) {
    limits.push_back(
        "no test shows all terms of the guess clearly: the fit may find fewer, and then its errors "
        "are not those shown");
  }
  double slowest_s = 0.0;
  for (const MaterialTerm& term : study.guess.terms) slowest_s = std::max(slowest_s, term.tau_s);
  limits.push_back(
      fmt::format("the guess has no term slower than {:.2g} s; if the material may have one, give "
                  "a guess that has "
                  "it (--guess), or hold longer",
                  slowest_s));
  return limits;
}

std::string advice_of(const TestStudy& study) {
  const ProtocolStudy& protocols = study.protocols;
  if (!protocols.advised) return "no test fits into the time";
  const ProtocolRow& row = protocols.rows[*protocols.advised];
  std::string text =
      fmt::format("{}, {}: {:.1f} min, {}", text_of_plan(row.plan), touches_text(row.touches),
                  row.total_s / 60.0, errors_text(protocols, row));
  if (!protocols.meets_all) {
    text += fmt::format(
        "; no test within the time meets all that is wanted (off by a factor of {:.2g})",
        row.shortfall);
  }
  return text;
}

void print_test_study(const TestStudy& study, std::ostream& out) {
  const ProtocolStudy& protocols = study.protocols;
  out << fmt::format("{} on {}; guess: {}; {} tests tried\n", study.bench.specimen.id,
                     study.bench.rig.name, study.guess_text, protocols.n_tried);
  out << fmt::format("  {:>6} {:>7} {:>6} {:>6} {:>6} {:>7} {:>8}", "min", "touches", "mm",
                     "ramp s", "hold s", "back to", "there s");
  for (const WantedQuantity& one : protocols.wanted) {
    out << fmt::format(" {:>12} {:>8} {:>8}", one.name + " +-", "noise", "at worst");
  }
  out << "\n";
  for (const ProtocolRow& row : protocols.rows) {
    if (!row.is_on_front && !row.is_given) continue;
    const TestPlan& plan = row.plan;
    out << fmt::format(
        "{} {:>6.2f} {:>7} {:>6.3f} {:>6g} {:>6g} {:>7} {:>8g}", row.is_given ? "=" : "*",
        row.total_s / 60.0, row.touches, 1e3 * plan.depth_m, plan.ramp_s, plan.hold_s,
        plan.recovery_s > 0.0 ? fmt::format("{:.0f} %", 100.0 * plan.unload_to_fraction) : "-",
        plan.recovery_s);
    for (std::size_t i = 0; i < row.errors.size(); ++i) {
      out << fmt::format(" {:>12} {:>8} {:>8}", percent(row.errors[i].half_width_95()),
                         percent(row.errors[i].without_systematic_95()),
                         percent(row.worst_half_width[i]));
    }
    out << "\n";
  }
  out << "  * on the Pareto front: nothing takes less time at the rig and is as accurate (within 2 "
         "%); = "
         "the given test\n  half-widths of 95 % intervals; noise: without the systematic parts of "
         "frame, "
         "calibration and geometry; at worst: with them, over the doubt in the guess\n";
  for (const std::string& limit : limits_of(study)) out << limit << "\n";
  out << "recommended: " << advice_of(study) << "\n";
  if (protocols.at_equal_time && !protocols.rows[*protocols.at_equal_time].is_given) {
    const ProtocolRow& row = protocols.rows[*protocols.at_equal_time];
    out << fmt::format("in the time of the given test: {}, {}: {}\n", text_of_plan(row.plan),
                       touches_text(row.touches), errors_text(protocols, row));
  }
}

}  // namespace viscard
