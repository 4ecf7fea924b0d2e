#include "io/flow/planning/study_output.h"

#include "io/basics/inputs.h"
#include "io/config/config_file.h"
#include "models/maths/result_visitor.h"

#include <fmt/format.h>

namespace viscard {
namespace {

void show_errors(ResultVisitor& v, const ProtocolStudy& study, const ProtocolRow& row) {
  std::size_t i = 0;
  v.list("errors", "of the wanted quantities", row.errors, [&](const ErrorCauses& causes) {
    const bool is_given = i < row.errors.size();
    v("quantity", is_given ? study.wanted[i].name : "", "its name");
    v("half_width_95", causes.half_width_95(), "of its interval, relative, with systematic parts");
    v("worst_half_width_95", is_given ? row.worst_half_width[i] : 0.0,
      "the largest over the doubt in the guess");
    v.object("standard_errors", "relative standard errors by cause", [&] {
      v("noise", causes.noise, "of the readings, with all that is fitted beside the moduli");
      v("gain_drift", causes.gain_drift, "of the load cell before contact");
      v("frame", causes.frame, "doubt in the stiffness of the frame");
      v("calibration", causes.calibration, "doubt in the calibration of the load cell");
      v("geometry", causes.geometry, "doubt in punch, layer and Poisson ratio");
    });
    ++i;
  });
}

void show_row(ResultVisitor& v, const ProtocolStudy& study, const ProtocolRow& row) {
  const TestPlan& plan = row.plan;
  v("time_s", row.total_s, "at the rig");
  v("touches", row.touches, "how often the test is carried out on the specimen");
  v("protocol", plan.protocol, "of the test file");
  v("depth_m", plan.depth_m, "depth");
  v("ramp_s", plan.ramp_s, "duration of the ramp");
  v("hold_s", plan.hold_s, "hold at full depth");
  v("unload_to_fraction", plan.unload_to_fraction, "share of the depth after the unloading");
  v("recovery_s", plan.recovery_s, "hold there; 0: no unloading");
  v("peak_force_N", row.peak_force_N, "elastic, at full depth");
  v("weakest_term", row.weakest_term,
    "smallest modulus of a term over its standard error; below 6 the fit may not find it");
  show_errors(v, study, row);
  v("shortfall", row.shortfall,
    "largest half-width over its tolerance; 1 or less: all that is wanted is met");
  v("pareto", row.is_on_front, "whether nothing quicker is as accurate");
  v("given", row.is_given, "whether it is the test of --test");
}

PlotSeries points_of(const ProtocolStudy& study, bool is_front) {
  PlotSeries series{.mark = is_front ? Mark::kLine : Mark::kPoints};
  for (const ProtocolRow& row : study.rows) {
    if (is_front ? !row.is_on_front : row.is_on_front || row.is_given) continue;
    series.x.push_back(row.total_s / 60.0);
    series.y.push_back(row.shortfall);
  }
  return series;
}

PlotSeries single_point(const ProtocolRow& row, const char* label, Ink ink) {
  return {.mark = Mark::kPoints,
          .label = label,
          .x = {row.total_s / 60.0},
          .y = {row.shortfall},
          .ink = ink,
          .size = 4.0};
}

}  // namespace

void show_keys(ResultVisitor& v, const TestStudy& study) {
  const ProtocolStudy& protocols = study.protocols;
  std::size_t i = 0;
  v.list("wanted", "what is wanted", protocols.wanted, [&](const WantedQuantity& one) {
    v("quantity", one.name, "its name");
    v("tolerance", one.tolerance, "relative half-width of its 95 % interval");
    v("beyond_reach", i < protocols.wanted.size() && protocols.is_beyond_reach[i],
      "whether the systematic parts alone exceed it; the shortfall then counts without them");
    ++i;
  });
  v("guess", study.guess_text, "where the guess of the material comes from");
  v.list("rows", "the front and what is near it, by time", protocols.rows,
         [&](const ProtocolRow& row) { show_row(v, protocols, row); });
  v("tried", protocols.n_tried, "number of tests that were compared");
  v("loses_terms", protocols.loses_terms, "whether no test shows all terms of the guess clearly");
  v.or_null("recommended", protocols.advised,
            "number in rows, from 0; null: no test fits into the time");
  v("meets_all", protocols.meets_all, "whether it meets all that is wanted");
  v.or_null("at_equal_time", protocols.at_equal_time,
            "the best row that takes no longer than the given test; null: none was given");
  const bool has_rows = !protocols.rows.empty();
  v("limits", has_rows ? limits_of(study) : std::vector<std::string>{},
    "what no test mends, in words");
  v("text", has_rows ? advice_of(study) : "", "the recommended test in words");
}

std::string csv_from_test_study(const TestStudy& study, const std::string& command) {
  const ProtocolStudy& protocols = study.protocols;
  std::string text = fmt::format(
      "{}time_s,touches,depth_m,ramp_s,hold_s,"
      "unload_to_fraction,recovery_s,shortfall,pareto,given",
      head_of_table(command));
  for (const WantedQuantity& one : protocols.wanted) {
    text += fmt::format(",{0}_half_width_95,{0}_worst_half_width_95", one.name);
  }
  text += "\n";
  for (const ProtocolRow& row : protocols.rows) {
    const TestPlan& plan = row.plan;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}", row.total_s, row.touches, plan.depth_m,
                        plan.ramp_s, plan.hold_s, plan.unload_to_fraction, plan.recovery_s,
                        row.shortfall, row.is_on_front ? 1 : 0, row.is_given ? 1 : 0);
    for (std::size_t i = 0; i < row.errors.size(); ++i) {
      text += fmt::format(",{},{}", row.errors[i].half_width_95(), row.worst_half_width[i]);
    }
    text += "\n";
  }
  return text;
}

Plot plot_from_test_study(const TestStudy& study) {
  const ProtocolStudy& protocols = study.protocols;
  PlotPanel panel;
  panel.x = {.label = "time at the rig (min)", .is_log = true};
  panel.y = {.label = "largest half-width over its tolerance", .is_log = true};
  PlotSeries front = points_of(protocols, true), others = points_of(protocols, false);
  front.label = "Pareto front";
  front.ink = Ink::kGrey;
  others.label = "near the front";
  others.size = 2.0;
  panel.series.push_back(front);
  if (!others.x.empty()) panel.series.push_back(others);
  if (!protocols.rows.empty()) {
    panel.series.push_back(
        {.mark = Mark::kLine,
         .label = "all that is wanted",
         .x = {protocols.rows.front().total_s / 60.0, protocols.rows.back().total_s / 60.0},
         .y = {1.0, 1.0},
         .ink = Ink::kBlack,
         .is_dashed = true});
  }
  for (const ProtocolRow& row : protocols.rows) {
    if (row.is_given) panel.series.push_back(single_point(row, "the given test", Ink::kVermillion));
  }
  if (protocols.advised) {
    panel.series.push_back(
        single_point(protocols.rows[*protocols.advised], "recommended", Ink::kGreen));
  }
  return {.title = "What accuracy costs at the rig: " + study.bench.specimen.id,
          .description =
              "Predicted 95 % half-width over its tolerance, the largest of all wanted "
              "quantities and over the doubt in the guess, against the time at the rig.",
          .panels = {panel},
          .width_px = 860,
          .height_px = 520};
}

std::string toml_of_advice(const TestStudy& study, const std::string& command) {
  if (!study.protocols.advised) return "";
  const ProtocolRow& row = study.protocols.rows[*study.protocols.advised];
  return fmt::format(
      "# Recommended by {} (viscard {}).\n# {}\n{}{}", command, VISCARD_VERSION, advice_of(study),
      row.touches > 1
          ? fmt::format("# To be carried out with viscard capture --repeat {}.\n", row.touches)
          : "",
      toml_from_test(row.plan));
}

}  // namespace viscard
