#include "fit/laws/fractional_diagnosis.h"

#include "models/maths/mittag_leffler.h"
#include "models/maths/result_visitor.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

struct Candidate {
  double ln_tau = 0.0, alpha = 1.0;
  double equilibrium = 0.0, branch = 0.0;
  double chi_square = std::numeric_limits<double>::infinity();
};

// Averages of a fit, and exponentials at times evenly spaced in ln t (column j: time exp(ln_first +
// j kStep)). The fractional decay is a weighted sum of them:
//   E_alpha(-(t/tau)^alpha) = int K(ln T - ln tau) exp(-t/T) d ln T   (Cole & Cole's distribution)
// The cumulative weight up to s = ln T - ln tau is 1/2 + atan(tan(pi alpha/2) tanh(alpha s/2))/(pi
// alpha) (Gorenflo & Mainardi (1997), p. 223, integrated).
class Averages {
 public:
  explicit Averages(const FitCurves& curves)
      : time_s_(to_eigen(curves.time_s)), measured_(to_eigen(curves.measured)) {
    weight_ = to_eigen(curves.sigma).square().inverse();
    const auto first = std::find_if(curves.time_s.begin(), curves.time_s.end(),
                                    [](double t_s) { return t_s > 0.0; });
    ln_from_ = std::log(*first);
    ln_to_ = std::log(curves.time_s.back());
    ln_first_ = ln_from_ - kMargin;
    const auto count = static_cast<Index>((ln_to_ - ln_from_ + 2.0 * kMargin) / kStep) + 1;
    decays_.resize(time_s_.size(), count);
    for (Index j = 0; j < count; ++j) {
      decays_.col(j) =
          (-time_s_ * std::exp(-ln_first_ - kStep * static_cast<double>(j))).exp().matrix();
    }
  }
  double ln_from() const { return ln_from_; }
  double ln_to() const { return ln_to_; }

  // Both moduli by non-negative least squares, with the decay from the weighted sum.
  Candidate with_moduli(double ln_tau, double alpha) const {
    if (!(alpha > 0.02 && alpha <= 1.0)) return {};
    return solved(ln_tau, alpha, (decays_ * shares(ln_tau, alpha)).array());
  }
  // The same with the decay accurate to thirteen digits. Just below alpha = 1 its integral
  // converges slowly, and the weighted sum, accurate to four digits, is used.
  Candidate exactly(double ln_tau, double alpha) const {
    if (alpha > 0.9 && alpha < 1.0) return with_moduli(ln_tau, alpha);
    Eigen::ArrayXd decay(time_s_.size());
    for (Index i = 0; i < decay.size(); ++i) {
      const double t_s = time_s_[i];
      const double x = t_s > 0.0 ? std::exp(alpha * (std::log(t_s) - ln_tau)) : 0.0;
      decay[i] = mittag_leffler_decay(alpha, x);
    }
    return solved(ln_tau, alpha, decay);
  }

 private:
  static constexpr double kStep = 0.05, kMargin = 6.0;

  static Eigen::ArrayXd to_eigen(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Index>(values.size()));
  }

  // Weight of each column. A weight between two columns is split by distance; weights beyond the
  // range go to the first and last column.
  Eigen::VectorXd shares(double ln_tau, double alpha) const {
    constexpr int kParts = 8;
    const Index count = decays_.cols();
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(count);
    const double steep = std::tan(0.5 * std::numbers::pi * std::min(alpha, 1.0 - 1e-9));
    const auto up_to = [&](double ln_T) {
      return 0.5 + std::atan(steep * std::tanh(0.5 * alpha * (ln_T - ln_tau))) /
                       (std::numbers::pi * alpha);
    };
    double last = up_to(ln_first_);
    shares[0] = last;
    for (Index j = 0; j + 1 < count; ++j) {
      for (int k = 1; k <= kParts; ++k) {
        const double now =
            up_to(ln_first_ + kStep * (static_cast<double>(j) + static_cast<double>(k) / kParts));
        const double place = (static_cast<double>(k) - 0.5) / kParts;
        shares[j] += (now - last) * (1.0 - place);
        shares[j + 1] += (now - last) * place;
        last = now;
      }
    }
    shares[count - 1] += 1.0 - last;
    return shares;
  }

  Candidate solved(double ln_tau, double alpha, const Eigen::ArrayXd& b) const {
    Candidate out{ln_tau, alpha};
    const double n = weight_.sum(), sb = (weight_ * b).sum(), sbb = (weight_ * b * b).sum();
    const double sy = (weight_ * measured_).sum(), sby = (weight_ * b * measured_).sum();
    const double determinant = n * sbb - sb * sb;
    if (determinant > 1e-12 * n * sbb) {
      out.branch = (n * sby - sb * sy) / determinant;
      out.equilibrium = (sy - out.branch * sb) / n;
    }
    if (out.branch <= 0.0) {
      out.branch = 0.0;
      out.equilibrium = sy / n;
    } else if (out.equilibrium < 0.0) {
      out.equilibrium = 0.0;
      out.branch = sby / sbb;
    }
    out.chi_square = (weight_ * (measured_ - out.equilibrium - out.branch * b).square()).sum();
    return out;
  }

  Eigen::ArrayXd time_s_, measured_, weight_;
  double ln_from_ = 0.0, ln_to_ = 0.0, ln_first_ = 0.0;
  Eigen::MatrixXd decays_;
};

// The best point of a coarse grid over time and exponent.
Candidate best_on_grid(const Averages& data) {
  Candidate best;
  const double ln_from = data.ln_from(), ln_to = data.ln_to();
  constexpr int kTimes = 16, kPowers = 8;
  for (int i = 0; i <= kTimes; ++i) {
    for (int k = 1; k <= kPowers; ++k) {
      const Candidate one = data.with_moduli(ln_from + (ln_to - ln_from) * i / kTimes,
                                             static_cast<double>(k) / kPowers);
      if (one.chi_square < best.chi_square) best = one;
    }
  }
  return best;
}

// Pattern search (Hooke & Jeeves, J. ACM 8 (1961) 212): eight neighbours, steps that halve.
Candidate sharpened(const Averages& data, Candidate best, double ln_step, double alpha_step) {
  constexpr std::array kSigns{-1.0, 0.0, 1.0};
  constexpr double kFine = 2e-4;
  while (alpha_step > kFine) {
    const Candidate centre = best;
    for (const double i : kSigns) {
      for (const double k : kSigns) {
        if (i == 0.0 && k == 0.0) continue;
        const double alpha = std::min(1.0, centre.alpha + k * alpha_step);
        const Candidate one = data.with_moduli(centre.ln_tau + i * ln_step, alpha);
        if (one.chi_square < best.chi_square) best = one;
      }
    }
    if (best.chi_square < centre.chi_square) continue;
    ln_step *= 0.5;
    alpha_step *= 0.5;
  }
  return best;
}

}  // namespace

void show_keys(ResultVisitor& v, const FractionalDiagnosis& fractional) {
  v("E_inf_Pa", fractional.model.equilibrium_Pa, "its plateau at long times");
  v("E_1_Pa", fractional.model.branch_Pa, "what relaxes");
  v("tau_s", fractional.model.tau_s, "its time");
  v("alpha", fractional.model.alpha, "its exponent");
  v("chi_square", fractional.chi_square, "of this model");
  v("series_chi_square", fractional.series_chi_square, "of the series");
  v("bic_difference", fractional.bic_difference, "to the series; negative: this model is better");
}

std::optional<FractionalDiagnosis> diagnose_fractional(const FitResult& fit) {
  const FitCurves& curves = fit.curves;
  const std::size_t count = curves.time_s.size();
  constexpr std::size_t kLeast = 5;
  const bool is_step = fit.kind == FitKind::kRelaxation && curves.motion_start_s.empty();
  if (!is_step || count < kLeast || !(fit.noise.sigma > 0.0)) return std::nullopt;
  if (!(curves.time_s.back() > 0.0)) return std::nullopt;
  const Averages data(curves);
  const Candidate found =
      sharpened(data, best_on_grid(data), (data.ln_to() - data.ln_from()) / 32.0, 1.0 / 16.0);
  const Candidate best = data.exactly(found.ln_tau, found.alpha);
  FractionalDiagnosis out;
  out.model = {best.equilibrium, best.branch, std::exp(best.ln_tau), best.alpha};
  out.chi_square = best.chi_square;
  for (std::size_t i = 0; i < count; ++i) {
    const double off = (curves.measured[i] - curves.fitted[i]) / curves.sigma[i];
    out.series_chi_square += off * off;
  }
  const double n_seen = static_cast<double>(fit.n_samples) / fit.noise.inflation;
  const double more = 3.0 - 2.0 * static_cast<double>(fit.terms.size());
  out.bic_difference = (out.chi_square - out.series_chi_square) / fit.noise.inflation +
                       more * std::log(std::max(2.0, n_seen));
  return out;
}

}  // namespace viscard
