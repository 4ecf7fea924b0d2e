#include "fit/fit_master_curve.h"

#include "fit/assembly/assemble_result.h"
#include "fit/curves/master_model.h"
#include "fit/intervals/flags.h"
#include "fit/intervals/left_out.h"
#include "fit/samples/clean_data.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

using Index = Eigen::Index;
constexpr double kSameTemperature_K = 1.0;

std::string celsius(double temperature_C) {
  return text_of(temperature_C, 4) + " C";
}

// Rows sorted by temperature and split where it rises by more than the width of a segment.
std::vector<std::vector<std::size_t>> rows_by_temperature(
    const std::vector<double>& temperature_C) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < temperature_C.size(); ++i) {
    if (std::isfinite(temperature_C[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return temperature_C[a] < temperature_C[b];
  });
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t row : order) {
    const bool is_new = groups.empty() || temperature_C[row] - temperature_C[groups.back().back()] >
                                              kSameTemperature_K;
    if (is_new) groups.emplace_back();
    groups.back().push_back(row);
  }
  return groups;
}

std::vector<MasterSegment> segments_of(const MasterData& data, std::size_t& n_left_out) {
  const std::size_t size = data.argument.size();
  const bool is_dma = !data.loss_Pa.empty();
  if (data.temperature_C.size() != size || data.modulus_Pa.size() != size ||
      (is_dma && data.loss_Pa.size() != size)) {
    throw std::invalid_argument("the columns of a master curve differ in length");
  }
  std::vector<MasterSegment> segments;
  n_left_out = size;
  for (std::vector<std::size_t>& rows : rows_by_temperature(data.temperature_C)) {
    std::erase_if(rows, [&](std::size_t i) {
      return !(data.argument[i] > 0.0) || !std::isfinite(data.modulus_Pa[i]) ||
             (is_dma && !std::isfinite(data.loss_Pa[i]));
    });
    if (rows.empty()) continue;
    std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
      return data.argument[a] < data.argument[b];
    });
    MasterSegment segment;
    for (const std::size_t i : rows) {
      segment.temperature_C += data.temperature_C[i] / static_cast<double>(rows.size());
      segment.argument.push_back(data.argument[i]);
      segment.value.push_back(data.modulus_Pa[i]);
      if (is_dma) segment.loss.push_back(data.loss_Pa[i]);
    }
    n_left_out -= rows.size();
    constexpr std::size_t kLeastRows = 3;
    if (rows.size() < kLeastRows) {
      throw std::runtime_error("only " + counted(rows.size(), "row") + " at " +
                               celsius(segment.temperature_C) + "; a segment needs at least three");
    }
    segments.push_back(std::move(segment));
  }
  if (segments.size() < 2) {
    throw std::runtime_error(
        "a master curve needs segments at two or more temperatures (1 K apart)");
  }
  return segments;
}

// The weights of rows are relative to their values, so a zero would outweigh all other rows.
void check_moduli(const MasterSegment& segment) {
  const bool is_dma = !segment.loss.empty();
  for (std::size_t i = 0; i < segment.value.size(); ++i) {
    if (segment.value[i] != 0.0 || (is_dma && segment.loss[i] != 0.0)) continue;
    throw std::runtime_error("the modulus at " + celsius(segment.temperature_C) + " and " +
                             text_of(segment.argument[i]) + (is_dma ? " Hz" : " s") +
                             " is zero: this is not a measurement. Remove the row");
  }
  check_sign(segment.value, is_dma ? "a storage modulus" : "a relaxation modulus",
             is_dma ? "storage_modulus_Pa" : "modulus_Pa");
}

// Difference of ln(argument) between `to` and `from` at equal values: the average over crossings,
// with more weight for steep ones. Weight 0: the values do not overlap.
struct Offset {
  double sum = 0.0, weight = 0.0;
};
void add_crossings(const MasterSegment& from, const MasterSegment& to, double sign,
                   Offset& offset) {
  for (std::size_t j = 0; j < to.value.size(); ++j) {
    for (std::size_t i = 1; i < from.value.size(); ++i) {
      const double before = from.value[i - 1] - to.value[j];
      const double after = from.value[i] - to.value[j];
      if (before * after > 0.0 || before == after) continue;
      // Noise around zero has no logarithm to compare.
      if (!(from.value[i - 1] > 0.0 && from.value[i] > 0.0)) continue;
      const double ln_before = std::log(from.argument[i - 1]);
      const double step = std::log(from.argument[i]) - ln_before;
      if (!(step > 0.0)) continue;
      const double at = ln_before + step * before / (before - after);
      const double steepness = std::log(from.value[i] / from.value[i - 1]) / step;
      offset.sum += sign * (std::log(to.argument[j]) - at) * steepness * steepness;
      offset.weight += steepness * steepness;
    }
  }
}

// ln a of every segment from its neighbours; the reference has 0.
std::vector<double> start_shifts(const std::vector<MasterSegment>& segments,
                                 std::size_t reference) {
  std::vector<double> ln_a(segments.size(), 0.0);
  for (std::size_t k = 1; k < segments.size(); ++k) {
    Offset offset;
    add_crossings(segments[k - 1], segments[k], 1.0, offset);
    add_crossings(segments[k], segments[k - 1], -1.0, offset);
    if (!(offset.weight > 0.0)) {
      throw std::runtime_error("the moduli at " + celsius(segments[k - 1].temperature_C) + " and " +
                               celsius(segments[k].temperature_C) +
                               " have no value in common, so they cannot be shifted onto each "
                               "other; measure a temperature in between, or longer records");
    }
    const double later = offset.sum / offset.weight;  // of segment k, at the same modulus
    ln_a[k] = ln_a[k - 1] + (segments[k].loss.empty() ? later : -later);
  }
  const double zero = ln_a[reference];
  for (double& one : ln_a) one -= zero;
  return ln_a;
}

std::size_t reference_of(const std::vector<MasterSegment>& segments,
                         const std::optional<double>& T_ref_C) {
  if (!T_ref_C) return segments.size() / 2;
  std::string there;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    if (std::abs(segments[k].temperature_C - *T_ref_C) <= kSameTemperature_K) return k;
    there += (k > 0 ? ", " : "") + celsius(segments[k].temperature_C);
  }
  throw std::runtime_error("no segment was measured at " + celsius(*T_ref_C) + "; there are " +
                           there);
}

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

void fill_curves(const MasterModel& model, const std::vector<MasterSegment>& segments,
                 const std::vector<ShiftFactor>& factors, const SpectralFit& fit,
                 FitResult& result) {
  const Eigen::VectorXd fitted = model.fitted(fit.state);
  const Eigen::VectorXd sigma = model.row_sigma();
  struct Point {
    double argument, measured, fitted, sigma;
  };
  std::vector<Point> points;
  Index row = 0;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const bool is_dma = !segments[k].loss.empty();
    const double sign = is_dma ? 1.0 : -1.0;  // reduced frequency f a_T, reduced time t/a_T
    for (std::size_t i = 0; i < segments[k].value.size(); ++i, row += is_dma ? 2 : 1) {
      points.push_back({segments[k].argument[i] * std::exp(sign * factors[k].ln_a),
                        segments[k].value[i], fitted[row] * sigma[row],
                        result.noise.sigma * sigma[row]});
    }
  }
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.argument < b.argument; });
  for (const Point& point : points) {
    result.curves.add(point.argument, point.measured, point.fitted, point.sigma);
  }
  result.curves.unit = "Pa";
}

}  // namespace

bool has_several_temperatures(const std::vector<double>& temperature_C) {
  return rows_by_temperature(temperature_C).size() > 1;
}

MasterCurve fit_master_curve(const MasterData& data, const FitOptions& options) {
  std::size_t n_left_out = 0;
  const std::vector<MasterSegment> segments = segments_of(data, n_left_out);
  for (const MasterSegment& segment : segments) check_moduli(segment);
  const std::size_t reference = reference_of(segments, data.T_ref_C);
  const MasterModel model(segments, reference, start_shifts(segments, reference), options);
  const SpectralFit fit = fit_spectrum(model, blocks_of(segments), options);

  MasterCurve curve;
  curve.T_ref_C = segments[reference].temperature_C;
  const Index first = model.n_common() + 2 * fit.state.n_terms();
  const Index n_shifts = model.n_nuisances();
  const Eigen::MatrixXd covariance = fit.covariance.block(first, first, n_shifts, n_shifts);
  std::vector<ShiftFactor> others;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    ShiftFactor factor{segments[k].temperature_C, 0.0, 0.0};
    if (k != reference) {
      const auto n = static_cast<Index>(others.size());
      factor.ln_a = fit.state.nuisance[n];
      factor.ln_a_se = std::sqrt(std::max(0.0, covariance(n, n)));
      others.push_back(factor);
    }
    curve.factors.push_back(factor);
  }
  curve.laws = fit_shift_laws(others, covariance, curve.T_ref_C);

  FitResult& result = curve.fit;
  result.kind = data.loss_Pa.empty() ? FitKind::kRelaxation : FitKind::kDma;
  fill_result(model, fit, relaxation_series_of(model, options.is_liquid), result);
  result.n_samples = data.argument.size() - n_left_out;
  add_left_out(result, left_out::kNotANumber, n_left_out);
  flag_left_out(result);
  fill_window(segments, curve.factors, result);
  add_identifiability_flags(model, fit.state, fit.covariance,
                            {0.0, 0.0, result.fit_from_s, result.fit_to_s}, result);
  if (options.with_curves) fill_curves(model, segments, curve.factors, fit, result);
  return curve;
}

}  // namespace viscard
