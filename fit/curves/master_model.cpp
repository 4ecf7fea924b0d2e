#include "fit/curves/master_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace viscard {
namespace {

using Index = Eigen::Index;

// A term's value and its derivative by ln tau or ln a, at u = ln(t/(a tau)) or -ln(w a tau).
struct Response {
  double value = 0.0, slope = 0.0;
};

Response relaxation(double u) {
  if (u > 6.7) return {};  // exp(-800)
  const double x = std::exp(u);
  const double value = std::exp(-x);
  return {value, x * value};
}

// x^2/(1 + x^2) and x/(1 + x^2) with x = exp(-u), without overflow.
Response storage(double u) {
  const double value =
      u > 0.0 ? std::exp(-2.0 * u) / (1.0 + std::exp(-2.0 * u)) : 1.0 / (1.0 + std::exp(2.0 * u));
  return {value, 2.0 * value * (1.0 - value)};
}

Response loss(double u) {
  const double value = 0.5 / std::cosh(std::min(std::abs(u), 350.0));
  return {value, value * (1.0 - 2.0 * storage(u).value)};
}

constexpr double kVerticalSd = 0.1, kVerticalReach = 1.5;

std::vector<double> temperatures_of(const std::vector<MasterSegment>& segments) {
  std::vector<double> temperature_C;
  for (const MasterSegment& segment : segments) temperature_C.push_back(segment.temperature_C);
  return temperature_C;
}

}  // namespace

MasterModel::MasterModel(const std::vector<MasterSegment>& segments, std::size_t reference,
                         const std::vector<double>& start, const FitOptions& options,
                         const MasterShape& shape)
    : form_(shape.form, temperatures_of(segments), reference, shape.curvature_sd),
      reference_(static_cast<Index>(reference)),
      has_vertical_(shape.has_vertical),
      with_equilibrium_(!options.is_liquid) {
  const Eigen::VectorXd at_start =
      Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Index>(start.size()));
  nuisances_ = form_.nuisances(at_start);
  if (shape.form == ShiftFormKind::kFixed) fixed_ln_a_ = at_start;
  fixed_ln_b_ = Eigen::Map<const Eigen::VectorXd>(shape.fixed_ln_b.data(),
                                                  static_cast<Index>(shape.fixed_ln_b.size()));
  if (has_vertical_) add_vertical(segments.size());
  std::vector<double> values;
  double largest = 0.0;
  for (const MasterSegment& segment : segments) {
    for (const double value : segment.value) largest = std::max(largest, std::abs(value));
  }
  double lowest_ln = 1e300, highest_ln = -1e300;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const MasterSegment& segment = segments[k];
    const bool is_dma = !segment.loss.empty();
    for (std::size_t i = 0; i < segment.value.size(); ++i) {
      const double ln_argument = is_dma ? -std::log(2.0 * std::numbers::pi * segment.argument[i])
                                        : std::log(segment.argument[i]);
      const auto slot = static_cast<Index>(k);
      rows_.push_back({is_dma ? Kind::kStorage : Kind::kRelaxation, ln_argument, slot});
      values.push_back(segment.value[i]);
      if (is_dma) {
        rows_.push_back({Kind::kLoss, ln_argument, slot});
        values.push_back(segment.loss[i]);
      }
      lowest_ln = std::min(lowest_ln, ln_argument - start[k]);
      highest_ln = std::max(highest_ln, ln_argument - start[k]);
    }
  }
  const auto count = static_cast<Index>(values.size());
  data_.resize(count);
  sigma_.resize(count);
  for (Index i = 0; i < count; ++i) {
    const double value = values[static_cast<std::size_t>(i)];
    sigma_[i] = shape.noise * std::max(std::abs(value), 1e-3 * largest);
    data_[i] = value / sigma_[i];
  }
  if (with_equilibrium_) common_.push_back({"E_inf_Pa", /*is_free=*/false});
  may_be_negative_ = options.allow_negative;
  ln_tau_min_ = lowest_ln - std::log(3.0);
  ln_tau_max_ = highest_ln + std::log(3.0);
}

void MasterModel::add_vertical(std::size_t n_segments) {
  for (std::size_t k = 0; k < n_segments; ++k) {
    if (static_cast<Index>(k) == reference_) continue;
    nuisances_.push_back({"ln_b_" + std::to_string(k + 1), 0.0, -kVerticalReach, kVerticalReach,
                          0.1, 0.0, kVerticalSd});
  }
}

Eigen::VectorXd MasterModel::ln_a(const Eigen::VectorXd& nuisance) const {
  if (fixed_ln_a_.size() > 0) return fixed_ln_a_;
  return form_.ln_a(nuisance.head(form_.n_parameters()));
}

Eigen::VectorXd MasterModel::ln_b(const Eigen::VectorXd& nuisance) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(rows_.empty() ? 0 : rows_.back().segment + 1);
  if (fixed_ln_b_.size() > 0) return fixed_ln_b_;
  if (!has_vertical_) return all;
  Index next = form_.n_parameters();
  for (Index k = 0; k < all.size(); ++k) {
    if (k != reference_) all[k] = nuisance[next++];
  }
  return all;
}

// The derivatives of one row by all nuisances; by_ln_a: those of its terms by its own ln a.
void MasterModel::fill_slopes(Index row, const Eigen::VectorXd& by_ln_a,
                              const Eigen::MatrixXd& shift_slopes, ModelColumns& out) const {
  const Index segment = rows_[static_cast<std::size_t>(row)].segment;
  for (Index j = 0; j < form_.n_parameters(); ++j) {
    const double share = shift_slopes(segment, j);
    if (share == 0.0) continue;
    out.nuisance_slopes[static_cast<std::size_t>(j)].row(row).tail(by_ln_a.size()) =
        share * by_ln_a.transpose();
  }
  if (!has_vertical_ || segment == reference_) return;
  const Index slot = form_.n_parameters() + (segment < reference_ ? segment : segment - 1);
  out.nuisance_slopes[static_cast<std::size_t>(slot)].row(row) = out.values.row(row);
}

ModelColumns MasterModel::columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                                  bool with_slopes) const {
  const Index n_terms = ln_tau.size();
  ModelColumns out;
  out.values = Eigen::MatrixXd::Zero(n_rows(), n_common() + n_terms);
  if (with_slopes) {
    out.term_slopes = Eigen::MatrixXd::Zero(n_rows(), n_terms);
    out.nuisance_slopes.assign(static_cast<std::size_t>(n_nuisances()),
                               Eigen::MatrixXd::Zero(n_rows(), n_common() + n_terms));
  }
  const Eigen::VectorXd shift = ln_a(nuisance);
  const Eigen::VectorXd factor = ln_b(nuisance).array().exp();
  const Eigen::MatrixXd shift_slopes =
      with_slopes ? form_.slopes(nuisance.head(form_.n_parameters())) : Eigen::MatrixXd();
  Eigen::VectorXd by_ln_a(n_terms);
  for (Index r = 0; r < n_rows(); ++r) {
    const Row& row = rows_[static_cast<std::size_t>(r)];
    const double weight = factor[row.segment] / sigma_[r];
    const double ln_reduced = row.ln_argument - shift[row.segment];
    if (with_equilibrium_ && row.kind != Kind::kLoss) out.values(r, 0) = weight;
    for (Index i = 0; i < n_terms; ++i) {
      const double u = ln_reduced - ln_tau[i];
      const Response response = row.kind == Kind::kRelaxation ? relaxation(u)
                                : row.kind == Kind::kStorage  ? storage(u)
                                                              : loss(u);
      out.values(r, n_common() + i) = weight * response.value;
      by_ln_a[i] = weight * response.slope;
    }
    if (!with_slopes) continue;
    out.term_slopes.row(r) = by_ln_a.transpose();
    fill_slopes(r, by_ln_a, shift_slopes, out);
  }
  return out;
}

}  // namespace viscard
