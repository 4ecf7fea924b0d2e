#include "io/cli/fit/predict_output.h"

#include "io/report/report_numbers.h"
#include "models/maths/interval.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

namespace viscard {
namespace {

// How a column is printed and drawn.
struct ShownQuantity {
  std::string label, unit;  // the unit in SI; empty for a plain number
};
ShownQuantity shown_quantity(const std::string& name) {
  if (name == "modulus_Pa") return {"relaxation modulus", "Pa"};
  if (name == "compliance_1_Pa") return {"creep compliance", "1/Pa"};
  if (name == "storage_modulus_Pa") return {"storage modulus", "Pa"};
  if (name == "loss_modulus_Pa") return {"loss modulus", "Pa"};
  if (name == "tan_delta") return {"tan delta", ""};
  if (name == "stress_Pa") return {"stress", "Pa"};
  if (name == "frequency_Hz") return {"frequency", "Hz"};
  if (name == "time_s") return {"time", "s"};
  return {name, ""};
}

std::string with_unit(double value, const std::string& unit) {
  const ShownUnit shown = shown_unit(unit, {value});
  return text_of(value * shown.per_si, 4) + (shown.text.empty() ? "" : " " + shown.text);
}

std::string percent(double share) {
  return std::isfinite(share) ? text_of(100.0 * share, 3) + " %" : "unknown";
}

void print_rows(const TestPrediction& prediction, std::ostream& out) {
  constexpr std::size_t kShown = 12;
  const std::size_t count = prediction.at.size();
  out << fmt::format("  {:>14}", prediction.argument);
  for (const PredictedCurve& one : prediction.curves) {
    out << fmt::format(" {:>20}", one.name);
    if (!one.curve.low_95.empty()) out << fmt::format("   {:>25}", "95 %");
  }
  out << "\n";
  for (std::size_t k = 0; k < std::min(kShown, count); ++k) {
    const std::size_t i = count <= kShown ? k : k * (count - 1) / (kShown - 1);
    out << fmt::format("  {:>14.6g}", prediction.at[i]);
    for (const PredictedCurve& one : prediction.curves) {
      out << fmt::format(" {:>20.6g}", one.curve.value[i]);
      if (one.curve.low_95.empty()) continue;
      out << fmt::format(
          "   {:<25}", fmt::format("{:.6g} to {:.6g}", one.curve.low_95[i], one.curve.high_95[i]));
    }
    if (!prediction.is_inside[i]) out << "   outside the window";
    out << "\n";
  }
}

void print_agreement(const Agreement& found, const std::string& file, std::ostream& out) {
  const ShownQuantity shown = shown_quantity(found.name);
  out << fmt::format("  against {}: {}, {}: rms {} ({}), worst {} at {:.4g}", file, shown.label,
                     counted(found.at.size(), "row"), with_unit(found.rms, shown.unit),
                     percent(found.rms_relative), with_unit(found.worst, shown.unit),
                     found.worst_at);
  if (std::isfinite(found.share_inside_band)) {
    out << fmt::format(", inside the band {}", percent(found.share_inside_band));
  }
  if (std::isfinite(found.share_inside_band_and_noise)) {
    out << fmt::format(", with the noise {}", percent(found.share_inside_band_and_noise));
  }
  if (!found.agrees.value_or(true)) out << ": they disagree";
  out << "\n";
  if (found.n_inside_window < found.at.size()) {
    out << fmt::format("    {} inside the window of the fit",
                       counted(found.n_inside_window, "row"));
    if (found.n_inside_window > 0) {
      out << ", rms there " << with_unit(found.rms_inside_window, shown.unit);
    }
    out << "\n";
  }
  if (found.n_left_out > 0) {
    out << fmt::format("    {} before the test left out\n", counted(found.n_left_out, "row"));
  }
}

// Splits a curve into its parts inside and outside the window. A part ends where the other begins,
// so that no gap is between them.
void add_parts(PlotPanel& panel, const TestPrediction& prediction, const PlotSeries& whole,
               const std::string& outside_label) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  for (const bool is_inside : {true, false}) {
    PlotSeries part = whole;
    bool is_any = false;
    for (std::size_t i = 0; i < prediction.at.size(); ++i) {
      const bool is_edge =
          !is_inside && ((i > 0 && !prediction.is_inside[i - 1]) ||
                         (i + 1 < prediction.at.size() && !prediction.is_inside[i + 1]));
      const bool is_here = prediction.is_inside[i] == is_inside || is_edge;
      is_any = is_any || prediction.is_inside[i] == is_inside;
      for (auto* column : {&part.y, &part.y_low, &part.y_high}) {
        if (!is_here && !column->empty()) (*column)[i] = kGap;
      }
    }
    if (!is_any) continue;
    if (!is_inside) {
      part.ink = Ink::kGrey;
      part.is_dashed = true;
      part.label = part.label.empty() ? "" : outside_label;
    }
    panel.series.push_back(part);
  }
}

PlotPanel panel_of(const PredictedFile& predicted, const PredictedCurve& one, std::size_t number) {
  const TestPrediction& prediction = predicted.prediction;
  const ShownQuantity argument = shown_quantity(prediction.argument);
  const ShownQuantity quantity = shown_quantity(one.name);
  const ShownUnit unit = shown_unit(quantity.unit, one.curve.value);
  PlotPanel panel;
  panel.x.label = argument.label + " (" + argument.unit + ")";
  panel.x.is_log = prediction.input_name.empty();
  panel.y.label = quantity.label + (unit.text.empty() ? "" : " (" + unit.text + ")");
  const auto [low, high] = std::minmax_element(one.curve.value.begin(), one.curve.value.end());
  panel.y.is_log = panel.x.is_log && *low > 0.0 && *high > 10.0 * *low;
  const std::string outside = number == 0 ? "outside the window of the fit" : "";
  if (!one.curve.low_95.empty()) {
    add_parts(panel, prediction,
              {.mark = Mark::kBand,
               .label = "95 % band",
               .x = prediction.at,
               .y_low = scaled(one.curve.low_95, unit.per_si),
               .y_high = scaled(one.curve.high_95, unit.per_si)},
              "");
  }
  for (const Agreement& found : predicted.agreement) {
    if (found.name != one.name) continue;
    panel.series.push_back({.mark = Mark::kPoints,
                            .label = "measured",
                            .x = found.at,
                            .y = scaled(found.measured, unit.per_si),
                            .ink = Ink::kVermillion});
  }
  add_parts(panel, prediction,
            {.mark = Mark::kLine,
             .label = "predicted",
             .x = prediction.at,
             .y = scaled(one.curve.value, unit.per_si)},
            outside);
  return panel;
}

}  // namespace

void print_prediction(const PredictedFile& predicted, std::ostream& out) {
  const TestPrediction& prediction = predicted.prediction;
  out << fmt::format("{}: {}, {}\n", predicted.name,
                     names_of_predicted_tests()[static_cast<std::size_t>(prediction.test)],
                     counted(prediction.at.size(), "point"));
  print_rows(prediction, out);
  const auto n_outside =
      std::count(prediction.is_inside.begin(), prediction.is_inside.end(), false);
  if (prediction.is_window_known) {
    out << fmt::format("  window of the fit: {:.4g} s to {:.4g} s; {} of {} outside it\n",
                       prediction.t_min_s, prediction.t_max_s, n_outside,
                       counted(prediction.at.size(), "point"));
  }
  if (predicted.has_band && predicted.systematic_relative > 0.0) {
    out << fmt::format(
        "  the band includes +-{:.2g} % of E0 that further tests on the same bench would not "
        "narrow\n",
        100.0 * kNormal95 * predicted.systematic_relative);
  }
  for (const Agreement& found : predicted.agreement) {
    print_agreement(found, predicted.against, out);
  }
  for (const std::string& note : predicted.notes) out << "  ! " << note << "\n";
}

Plot plot_of_prediction(const PredictedFile& predicted) {
  const TestPrediction& prediction = predicted.prediction;
  Plot plot{.title = predicted.name + ": predicted " +
                     names_of_predicted_tests()[static_cast<std::size_t>(prediction.test)],
            .description =
                "Predicted curve with its 95 % band; grey and dashed outside the window "
                "of the fit."};
  for (std::size_t i = 0; i < prediction.curves.size(); ++i) {
    plot.panels.push_back(panel_of(predicted, prediction.curves[i], i));
  }
  plot.height_px = static_cast<int>(300 * plot.panels.size() + 60);
  if (!prediction.input_name.empty()) {
    const ShownQuantity quantity = shown_quantity(prediction.input_name);
    const ShownUnit unit = shown_unit(quantity.unit, prediction.input);
    PlotPanel input;
    input.x = plot.panels.front().x;
    input.y.label = quantity.label + (unit.text.empty() ? "" : " (" + unit.text + ")");
    input.series.push_back(
        {.x = prediction.at, .y = scaled(prediction.input, unit.per_si), .ink = Ink::kBlack});
    input.height_share = 0.55;
    plot.panels.push_back(input);
    plot.panels.front().shares_x_with_below = true;
    plot.height_px += 170;
  }
  return plot;
}

}  // namespace viscard
