#include "fit/fit_master_curve.h"

#include "fit/assembly/assemble_result.h"
#include "fit/curves/master_model.h"
#include "fit/intervals/flags.h"
#include "fit/intervals/left_out.h"
#include "fit/intervals/positive_intervals.h"
#include "fit/isotherm_checks.h"
#include "fit/master_segments.h"
#include "fit/master_shifts.h"
#include "fit/master_start.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Rows of neighbouring arguments at one temperature form a block and are left out together.
std::vector<int> blocks_of(const std::vector<MasterSegment>& segments) {
  std::vector<int> blocks;
  int block = 0;
  for (const MasterSegment& segment : segments) {
    const std::size_t rows = segment.value.size() * (segment.loss.empty() ? 1 : 2);
    constexpr std::size_t kRowsPerBlock = 6;
    for (std::size_t i = 0; i < rows; ++i) {
      if (i % kRowsPerBlock == 0) ++block;
      blocks.push_back(block);
    }
  }
  return blocks;
}

void fill_window(const std::vector<MasterSegment>& segments,
                 const std::vector<ShiftFactor>& factors, FitResult& result) {
  result.fit_from_s = 1e300;
  result.fit_to_s = 0.0;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    for (const double argument : segments[k].argument) {
      const double time_s =
          segments[k].loss.empty() ? argument : 1.0 / (2.0 * std::numbers::pi * argument);
      const double reduced_s = time_s * std::exp(-factors[k].ln_a);
      result.fit_from_s = std::min(result.fit_from_s, reduced_s);
      result.fit_to_s = std::max(result.fit_to_s, reduced_s);
    }
  }
}

// One row of all segments as it lies on the master curve.
struct ShiftedRow {
  double argument = 0.0, measured = 0.0, fitted = 0.0, sigma = 0.0;
  double loss_measured = 0.0, loss_fitted = 0.0, loss_sigma = 0.0;
};

void fill_curves(const std::vector<MasterSegment>& segments, const ShiftFits& shifts,
                 const std::vector<ShiftFactor>& factors, FitResult& result) {
  const Eigen::VectorXd sigma = shifts.model->row_sigma();
  const Eigen::VectorXd fitted = shifts.model->fitted(shifts.fit.state).cwiseProduct(sigma);
  std::vector<ShiftedRow> rows;
  Index at = 0;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const MasterSegment& segment = segments[k];
    const bool is_dma = !segment.loss.empty();
    const double sign = is_dma ? 1.0 : -1.0;  // reduced frequency f a_T, reduced time t/a_T
    const double down = std::exp(-factors[k].ln_b);
    const double error = down * result.noise.sigma;
    for (std::size_t i = 0; i < segment.value.size(); ++i, at += is_dma ? 2 : 1) {
      ShiftedRow row{segment.argument[i] * std::exp(sign * factors[k].ln_a),
                     down * segment.value[i], down * fitted[at], error * sigma[at]};
      if (is_dma) {
        row.loss_measured = down * segment.loss[i];
        row.loss_fitted = down * fitted[at + 1];
        row.loss_sigma = error * sigma[at + 1];
      }
      rows.push_back(row);
    }
  }
  std::sort(rows.begin(), rows.end(),
            [](const ShiftedRow& a, const ShiftedRow& b) { return a.argument < b.argument; });
  for (const ShiftedRow& row : rows) {
    result.curves.add(row.argument, row.measured, row.fitted, row.sigma);
    if (result.kind == FitKind::kDma) {
      result.curves.add_loss(row.loss_measured, row.loss_fitted, row.loss_sigma);
    }
  }
  result.curves.unit = "Pa";
}

const char* name_of_form(ShiftFormKind form) {
  constexpr const char* kNames[] = {"fixed", "free", "arrhenius", "wlf", "smooth"};
  return kNames[static_cast<std::size_t>(form)];
}

void flag_left_out(const MasterSegments& all, FitResult& result) {
  if (all.left_out.empty()) return;
  std::string names;
  for (const std::string& one : all.left_out) names += (names.empty() ? "" : ", ") + one;
  result.flags.push_back({"isotherms-left-out", 0,
                          counted(all.left_out.size(), "isotherm") +
                              (all.left_out.size() == 1 ? " was" : " were") +
                              " left out of the master curve: " + names});
}

// Isotherms without a modulus in common lie as far apart as the others let a law or a smooth curve say, or else as
// far as was given.
void flag_apart(const MasterStart& start, MasterCurve& curve) {
  if (start.apart.empty()) return;
  std::string names;
  for (const std::string& one : start.apart) names += (names.empty() ? "" : ", ") + one;
  const std::string what = "the isotherms at " + names + " have no modulus in common. ";
  const std::size_t needed = curve.form == "wlf" ? 2 : 1;  // parameters of the form
  if (curve.form != "free" && start.n_overlaps >= needed) {
    curve.fit.flags.push_back(
        {"isotherms-apart", 0,
         what + "How far apart they lie follows from the temperature law of the other shifts "
                "alone; measure a temperature in between, or longer records"});
    return;
  }
  curve.fit.flags.push_back(
      {"shifts-not-determined", 0,
       what + "No row and no law shows how far apart they lie; this follows from the start values. "
              "Measure a temperature in between, or longer records"});
  curve.fit.is_trustworthy = false;
}

// Flags free shifts that no smooth curve describes, or that clearly differ from the smooth ones.
void flag_shifts(const ShiftFits& shifts, MasterCurve& curve) {
  const auto percent = [](double share) { return text_of(100.0 * share, 2) + " %"; };
  const auto log10_a = [](double ln_a) { return text_of(ln_a / std::log(10.0), 4); };
  if (shifts.form == ShiftFormKind::kFree && curve.factors.size() > 2) {
    curve.fit.flags.push_back(
        {"shifts-not-smooth", 0,
         "no smooth curve of the shift factors over temperature describes the data as well as "
         "free factors do (residual " +
             percent(shifts.smooth_rms) + " instead of " + percent(shifts.free_rms) +
             "), so the free ones were taken. Check the temperatures and the moduli of single "
             "isotherms"});
    return;
  }
  constexpr double kVisible = 0.1 * std::numbers::ln10, kStandardErrors = 3.0;
  std::string where;
  std::size_t worst = 0;
  double most = 0.0;
  for (std::size_t k = 0; k < curve.factors.size(); ++k) {
    const ShiftFactor &taken = curve.factors[k], &free = curve.free_factors[k];
    const double apart = std::abs(taken.ln_a - free.ln_a);
    if (apart < kVisible || apart < kStandardErrors * free.ln_a_se) continue;
    where += (where.empty() ? "" : ", ") + celsius(taken.temperature_C);
    if (apart <= most) continue;
    most = apart;
    worst = k;
  }
  if (where.empty()) return;
  curve.fit.flags.push_back({"shifts-differ", 0,
                             "free shift factors differ from the smooth ones at " + where +
                                 ", most at " + celsius(curve.factors[worst].temperature_C) +
                                 " (log10 a_T " + log10_a(curve.free_factors[worst].ln_a) +
                                 " free, " + log10_a(curve.factors[worst].ln_a) +
                                 " smooth); the smooth ones describe the data as "
                                 "well (residual " +
                                 percent(shifts.taken_rms) + ", free " + percent(shifts.free_rms) +
                                 ") and were taken"});
}

// The material stores a law, even if no law describes the factors well.
void flag_law(MasterCurve& curve) {
  const TemperatureShift* law = curve.laws.better();
  if (law == nullptr || curve.form == "wlf" || curve.form == "arrhenius") return;
  double most = 0.0, where_C = curve.T_ref_C;
  for (const ShiftFactor& factor : curve.factors) {
    const double off = std::abs(ln_shift_factor(*law, factor.temperature_C) - factor.ln_a);
    if (off <= most) continue;
    most = off;
    where_C = factor.temperature_C;
  }
  constexpr double kVisible = 0.1 * std::numbers::ln10;
  if (most < kVisible) return;
  curve.fit.flags.push_back(
      {"shift-law-misfit", 0,
       std::string("neither WLF nor Arrhenius describes the shift factors; the ") +
           (law->law == ShiftLaw::kWlf ? "WLF" : "Arrhenius") +
           " law of the material is off by up to " + text_of(most / std::numbers::ln10, 2) +
           " decades, at " + celsius(where_C) +
           ". Use the factors themselves, or fit fewer temperatures"});
}

// Isotherms that slip vertically without showing it elsewhere move their shift factors by far more than the rows
// tell. Where a law describes the factors well, their scatter about it is measured, and widens the errors of
// all (Birge, Phys. Rev. 40 (1932) 207).
void widen_by_scatter(MasterCurve& curve) {
  constexpr double kLawHolds = 0.1 * std::numbers::ln10, kDeviations = 4.0;
  const TemperatureShift* law = curve.laws.better();
  if (law == nullptr) return;
  for (const ShiftFactor& factor : curve.free_factors) {
    const double off = ln_shift_factor(*law, factor.temperature_C) - factor.ln_a;
    if (std::abs(off) > kLawHolds) return;
  }
  const bool is_wlf = law->law == ShiftLaw::kWlf;
  const double chi2 = is_wlf ? curve.laws.wlf_chi2 : curve.laws.arrhenius_chi2;
  const double spare = static_cast<double>(curve.free_factors.size()) - (is_wlf ? 3.0 : 2.0);
  // So far above its mean never by chance.
  if (spare < 1.0 || !(chi2 > spare + kDeviations * std::sqrt(2.0 * spare))) return;
  const double ratio = std::sqrt(chi2 / spare);
  for (auto* factors : {&curve.factors, &curve.free_factors}) {
    for (ShiftFactor& factor : *factors) factor.ln_a_se *= ratio;
  }
  curve.fit.flags.push_back(
      {"shifts-scatter", 0,
       "the shift factors scatter about their law by " + text_of(ratio, 2) +
           " times their errors from the rows, as isotherms do that slip vertically (geometry, "
           "temperature, a new clamping). Their errors are widened by that; the moduli slip, too. "
           "--vertical-shift on fits a factor for each isotherm"});
}

void flag_vertical(MasterCurve& curve) {
  if (!curve.has_vertical_shift) return;
  const auto by_size = [](const ShiftFactor& a, const ShiftFactor& b) {
    return std::abs(a.ln_b) < std::abs(b.ln_b);
  };
  const ShiftFactor& most = *std::max_element(curve.factors.begin(), curve.factors.end(), by_size);
  curve.fit.flags.push_back(
      {"vertical-shift", 0,
       "the moduli of the isotherms needed vertical shifts too, most at " +
           celsius(most.temperature_C) + " (a factor of " + text_of(std::exp(most.ln_b), 4) +
           "). The material holds at the reference temperature; at others its moduli change by "
           "these factors, which cards do not contain"});
}

}  // namespace

void validate(const std::vector<StartShift>& shifts) {
  constexpr double kMost = 40.0;  // glass to rubber is 15 to 30 decades
  for (const StartShift& one : shifts) {
    const std::string option =
        "--start-shift " + text_of(one.temperature_C) + "=" + text_of(one.log10_a);
    if (!std::isfinite(one.temperature_C)) {
      throw std::invalid_argument(option + ": the temperature is no number");
    }
    if (std::abs(one.log10_a) <= kMost) continue;
    throw std::invalid_argument(option + ": log10 a_T lies between -" + text_of(kMost) + " and " +
                                text_of(kMost) +
                                " decades; write the logarithm of the shift factor, such as "
                                "--start-shift 40=-1.2");
  }
}

bool has_several_temperatures(const std::vector<double>& temperature_C) {
  return n_isotherms(temperature_C) > 1;
}

MasterCurve fit_master_curve(const MasterData& data, const FitOptions& options) {
  validate(data.start_shifts);
  MasterSegments all = segments_of(data);
  const MasterStart start = master_start(all, data, options);
  const ShiftFits shifts = fit_shifts(all.segments, start, blocks_of(all.segments), options);
  const SpectralFit& fit = shifts.fit;

  MasterCurve curve;
  curve.T_ref_C = all.segments[start.reference].temperature_C;
  curve.factors = shift_factors(*shifts.model, all.segments, fit.state, fit.covariance);
  curve.free_factors = shifts.free_factors;
  curve.laws = shifts.laws;
  curve.form = name_of_form(shifts.form);
  // A law that describes the rows as well as free factors becomes the law of the material.
  if (shifts.form == ShiftFormKind::kWlf && curve.laws.wlf) curve.laws.wlf_is_better = true;
  if (shifts.form == ShiftFormKind::kArrhenius && curve.laws.arrhenius) {
    curve.laws.wlf_is_better = false;
  }
  curve.has_vertical_shift = shifts.has_vertical;
  curve.residual = shifts.taken_rms;
  curve.free_residual = shifts.free_rms;
  curve.left_out = all.left_out;
  curve.start_given = data.start_shifts;
  curve.is_start_as_given = start.is_as_given;

  FitResult& result = curve.fit;
  result.kind = data.loss_Pa.empty() ? FitKind::kRelaxation : FitKind::kDma;
  fill_result(*shifts.model, fit, relaxation_series_of(*shifts.model, options.is_liquid), result);
  result.n_samples = data.argument.size() - all.n_left_out;
  add_left_out(result, left_out::kNotANumber, all.n_left_out - all.n_of_isotherms);
  add_left_out(result, left_out::kIsotherm, all.n_of_isotherms);
  flag_left_out(result);
  fill_window(all.segments, curve.factors, result);
  add_identifiability_flags(*shifts.model, fit.state, fit.covariance,
                            {0.0, 0.0, result.fit_from_s, result.fit_to_s}, result);
  if (result.kind == FitKind::kDma) {
    report_highest_storage(1.0 / (2.0 * std::numbers::pi * result.fit_from_s), result);
  }
  flag_left_out(all, result);
  check_isotherms(all.segments, shifts, curve.factors, options, result);
  flag_apart(start, curve);
  widen_by_scatter(curve);
  flag_shifts(shifts, curve);
  flag_law(curve);
  flag_vertical(curve);
  if (options.with_curves) fill_curves(all.segments, shifts, curve.factors, result);
  result.noise.sigma *= shifts.noise;  // rows with priors are divided by their noise
  keep_intervals_positive(options, result);
  return curve;
}

}  // namespace viscard
