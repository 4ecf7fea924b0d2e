#include "fit/laws/law_search.h"

#include "fit/search/nnls.h"
#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

bool is_constant_column(const CommonColumn& column) {
  return column.name.rfind("E_inf", 0) == 0 || column.name == "J_g";
}

Eigen::Vector2d place_of(const LawPoint& point) {
  return {point.ln_tau, point.exponent};
}

}  // namespace

LawColumns columns_on_grid(const SpectralModel& model, const Eigen::VectorXd& nuisance) {
  LawColumns out{grid_for_times(model.ln_tau_min(), model.ln_tau_max()), {}, {}};
  out.terms.resize(model.n_rows(), out.grid.count);
  // Some at a time: a long history holds all samples of each column while it averages them.
  constexpr Eigen::Index kAtOnce = 8;
  for (Eigen::Index first = 0; first < out.grid.count; first += kAtOnce) {
    const Eigen::Index count = std::min(kAtOnce, out.grid.count - first);
    Eigen::VectorXd ln_tau(count);
    for (Eigen::Index i = 0; i < count; ++i) ln_tau[i] = out.grid.at(first + i);
    const Eigen::MatrixXd values = model.columns(ln_tau, nuisance, /*with_slopes=*/false).values;
    out.terms.middleCols(first, count) = values.rightCols(count);
    if (first == 0) out.common = values.leftCols(model.n_common());
  }
  return out;
}

LawSearch::LawSearch(const SpectralModel& model, const LawColumns& columns, LawKind kind,
                     bool is_creep)
    : model_(model), columns_(columns), is_creep_(is_creep), form_(law_form(kind, is_creep)) {
  const auto& common = model.common();
  for (std::size_t j = 0; j < common.size(); ++j) {
    if (common[j].name == "fluidity") continue;  // a law has its own flow
    if (is_constant_column(common[j]) && !form_.has_constant) continue;
    if (is_constant_column(common[j])) constant_ = used_.size();
    used_.push_back(static_cast<Eigen::Index>(j));
    is_free_.push_back(common[j].is_free);
  }
  is_free_.push_back(false);  // the amplitude
  constexpr double kBeyond = 3.0;
  ln_low_ = model.ln_tau_min() - kBeyond;
  ln_high_ = model.ln_tau_max() + kBeyond;
}

LawPoint LawSearch::at(double ln_tau, double exponent) const {
  LawPoint point{ln_tau, exponent};
  point.weights = weights_on_grid(spectrum(exponent), ln_tau, columns_.grid);
  const auto n_used = static_cast<Eigen::Index>(used_.size());
  Eigen::MatrixXd columns(model_.n_rows(), n_used + 1);
  for (Eigen::Index j = 0; j < n_used; ++j) {
    columns.col(j) = columns_.common.col(used_[static_cast<std::size_t>(j)]);
  }
  columns.col(n_used) = kernel(point);
  point.linear = least_squares_with_signs(columns, model_.data(), is_free_);
  point.residual = model_.data() - columns * point.linear;
  point.rss = point.residual.squaredNorm();
  return point;
}

const DecaySpectrum& LawSearch::spectrum(double exponent) const {
  if (!last_ || last_exponent_ != exponent) {
    last_.emplace(form_.shape, exponent, is_creep_);
    last_exponent_ = exponent;
  }
  return *last_;
}

LawPoint LawSearch::within(double ln_tau, double exponent) const {
  return at(form_.has_time ? std::clamp(ln_tau, ln_low_, ln_high_) : ln_tau,
            std::clamp(exponent, kLeastExponent, kMostExponent));
}

LawPoint LawSearch::best() const {
  const double low = model_.ln_tau_min(), high = model_.ln_tau_max();
  std::vector<LawPoint> points;
  const int n_times = form_.has_time ? 12 : 0;
  for (const double exponent : {0.08, 0.2, 0.35, 0.5, 0.65, 0.8, 0.92}) {
    for (int i = 0; i <= n_times; ++i) {
      // The unit time of a power law is the middle of the record.
      const double share = form_.has_time ? static_cast<double>(i) / n_times : 0.5;
      points.push_back(at(low + share * (high - low), exponent));
    }
  }
  std::sort(points.begin(), points.end(),
            [](const LawPoint& a, const LawPoint& b) { return a.rss < b.rss; });
  const LawPoint best = refined(points[0]);
  const LawPoint other = refined(points[1]);
  return other.rss < best.rss ? other : best;
}

bool LawSearch::is_at_bound(const LawPoint& point) const {
  constexpr double kTouch = 1e-6;
  if (!(point.amplitude() > 0.0)) return true;
  if (point.exponent < kLeastExponent + kTouch || point.exponent > kMostExponent - kTouch) {
    return true;
  }
  return form_.has_time && (point.ln_tau < ln_low_ + kTouch || point.ln_tau > ln_high_ - kTouch);
}

LawPoint LawSearch::moved(const LawPoint& point, Eigen::Index shape, double step) const {
  const bool is_time = form_.has_time && shape == 0;
  return within(point.ln_tau + (is_time ? step : 0.0), point.exponent + (is_time ? 0.0 : step));
}

LawPoint LawSearch::refined(LawPoint point) const {
  constexpr int kMostSteps = 40;
  // A gain of this share moves no parameter by a hundredth of its error below 1e5 samples.
  constexpr double kDone = 1e-9;
  constexpr double kStep = 1e-4, kLost = 1e8;
  double damping = 1e-3;
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::MatrixXd slopes(point.residual.size(), n_shapes());
    for (Eigen::Index k = 0; k < n_shapes(); ++k) {
      const LawPoint up = moved(point, k, kStep), down = moved(point, k, -kStep);
      slopes.col(k) = (up.residual - down.residual) / (place_of(up) - place_of(down)).norm();
    }
    const Eigen::MatrixXd normal = slopes.transpose() * slopes;
    const Eigen::VectorXd gradient = slopes.transpose() * point.residual;
    bool is_lower = false;
    double gain = 0.0;
    for (; !is_lower && damping < kLost; damping *= is_lower ? 0.2 : 5.0) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() *= 1.0 + damping;
      const Eigen::VectorXd change = -SymmetricFactor(damped).solve(gradient);
      if (!change.allFinite()) return point;
      LawPoint next = within(point.ln_tau + (form_.has_time ? change[0] : 0.0),
                             point.exponent + change[n_shapes() - 1]);
      is_lower = next.rss < point.rss;
      if (!is_lower) continue;
      gain = point.rss - next.rss;
      point = std::move(next);
    }
    if (!is_lower || gain <= kDone * point.rss) return point;
  }
  return point;
}

}  // namespace viscard
