#include "io/flow/planning/study_output.h"

#include "io/config/config_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace viscard {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_errors(const ProtocolStudy& study, const ProtocolRow& row) {
  Json errors = Json::array();
  for (std::size_t i = 0; i < row.errors.size(); ++i) {
    const ErrorCauses& causes = row.errors[i];
    errors.push_back({{"quantity", study.wanted[i].name},
                      {"half_width_95", causes.half_width_95()},
                      {"worst_half_width_95", row.worst_half_width[i]},
                      {"standard_errors",
                       {{"noise", causes.noise},
                        {"gain_drift", causes.gain_drift},
                        {"frame", causes.frame},
                        {"calibration", causes.calibration},
                        {"geometry", causes.geometry}}}});
  }
  return errors;
}

Json json_of_row(const ProtocolStudy& study, const ProtocolRow& row) {
  const TestPlan& plan = row.plan;
  return {{"time_s", row.total_s},
          {"touches", row.touches},
          {"protocol", plan.protocol},
          {"depth_m", plan.depth_m},
          {"ramp_s", plan.ramp_s},
          {"hold_s", plan.hold_s},
          {"unload_to_fraction", plan.unload_to_fraction},
          {"recovery_s", plan.recovery_s},
          {"peak_force_N", row.peak_force_N},
          {"weakest_term", row.weakest_term},
          {"errors", json_of_errors(study, row)},
          {"shortfall", row.shortfall},
          {"pareto", row.is_on_front},
          {"given", row.is_given}};
}

Json json_of_index(const std::optional<std::size_t>& index) {
  return index ? Json(*index) : Json();
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

Json json_from_test_study(const TestStudy& study) {
  const ProtocolStudy& protocols = study.protocols;
  Json wanted = Json::array(), rows = Json::array();
  for (std::size_t i = 0; i < protocols.wanted.size(); ++i) {
    wanted.push_back({{"quantity", protocols.wanted[i].name},
                      {"tolerance", protocols.wanted[i].tolerance},
                      {"beyond_reach", static_cast<bool>(protocols.is_beyond_reach[i])}});
  }
  for (const ProtocolRow& row : protocols.rows) rows.push_back(json_of_row(protocols, row));
  return {{"wanted", wanted},
          {"guess", study.guess_text},
          {"rows", rows},
          {"tried", protocols.n_tried},
          {"loses_terms", protocols.loses_terms},
          {"recommended", json_of_index(protocols.advised)},
          {"meets_all", protocols.meets_all},
          {"at_equal_time", json_of_index(protocols.at_equal_time)},
          {"limits", limits_of(study)},
          {"text", advice_of(study)}};
}

std::string csv_from_test_study(const TestStudy& study, const std::string& command) {
  const ProtocolStudy& protocols = study.protocols;
  std::string text = fmt::format(
      "# {} (viscard {})\ntime_s,touches,depth_m,ramp_s,hold_s,"
      "unload_to_fraction,recovery_s,shortfall,pareto,given",
      command, VISCARD_VERSION);
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
