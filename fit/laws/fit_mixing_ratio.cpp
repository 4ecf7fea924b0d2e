#include "fit/laws/fit_mixing_ratio.h"

#include "fit/laws/ratio_estimates.h"
#include "models/maths/dense.h"
#include "models/maths/text_of_number.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

using Index = Eigen::Index;

using Spreads = std::array<double, 3>;  // of ln E0, ln g, ln tau

// Generalised least squares at given spreads, and the log likelihood there.
struct Solution {
  Eigen::VectorXd beta;
  Eigen::MatrixXd covariance;
  double log_likelihood = -std::numeric_limits<double>::infinity();
};

class Likelihood {
 public:
  Likelihood(const RatioModel& shape, const std::vector<RatioEstimate>& estimates, bool restricted)
      : estimates_(estimates), n_terms_(shape.n_terms), restricted_(restricted) {
    for (const RatioEstimate& one : estimates) designs_.push_back(design_at(shape, one.ratio));
  }

  Solution at(const Spreads& spreads) const {
    const Index size = designs_.front().cols();
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
    double twice = 0.0;  // -2 log likelihood
    for (std::size_t s = 0; s < estimates_.size(); ++s) {
      Eigen::MatrixXd variance = estimates_[s].covariance;
      for (Index k = 0; k < variance.rows(); ++k) {
        const std::size_t kind = k == 0 ? 0 : (k <= n_terms_ ? 1 : 2);
        variance(k, k) += spreads[kind] * spreads[kind];
      }
      const Cholesky factor(variance);
      if (!factor.is_definite()) return {};
      const Eigen::MatrixXd design = factor.solve_lower(designs_[s]);
      const Eigen::VectorXd theta = factor.solve_lower(estimates_[s].theta);
      normal += design.transpose() * design;
      right += design.transpose() * theta;
      twice += theta.squaredNorm() + static_cast<double>(theta.size()) * std::log(kTwoPi) +
               factor.log_determinant();
    }
    const SymmetricFactor solver(normal);
    Solution out;
    out.beta = solver.solve(right);
    out.covariance = solver.solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(size, size)));
    twice -= right.dot(out.beta);
    if (restricted_) {
      twice += solver.log_determinant() - static_cast<double>(size) * std::log(kTwoPi);
    }
    out.log_likelihood = -0.5 * twice;
    return out;
  }

 private:
  static constexpr double kTwoPi = 2.0 * std::numbers::pi;
  const std::vector<RatioEstimate>& estimates_;
  std::vector<Eigen::MatrixXd> designs_;
  Index n_terms_;
  bool restricted_;
};

// Best spread of one kind with the others held: a scan of its logarithm and of zero, refined by
// golden section. The likelihood may have its maximum at zero.
double best_spread(const Likelihood& likelihood, Spreads spreads, std::size_t kind) {
  const auto at = [&](double spread) {
    spreads[kind] = spread;
    return likelihood.at(spreads).log_likelihood;
  };
  constexpr double kLow = -9.5, kHigh = 1.5, kStep = 1.0;  // ln of the spread
  double best = at(0.0), best_ln = -std::numeric_limits<double>::infinity();
  for (double ln = kLow; ln <= kHigh; ln += kStep) {
    const double value = at(std::exp(ln));
    if (value > best + 1e-12) {
      best = value;
      best_ln = ln;
    }
  }
  if (!std::isfinite(best_ln)) return 0.0;
  double low = best_ln - kStep, high = best_ln + kStep;
  constexpr double kGolden = 1.0 / std::numbers::phi;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = at(std::exp(a)), at_b = at(std::exp(b));
  while (high - low > 1e-4) {
    if (at_a > at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = at(std::exp(a));
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = at(std::exp(b));
    }
  }
  return std::exp(0.5 * (low + high));
}

RatioModel fitted_form(const std::vector<RatioEstimate>& estimates, const RatioForm& form,
                       bool restricted) {
  RatioModel model;
  model.form = form;
  model.n_terms = static_cast<int>(estimates.front().theta.size() / 2);
  model.ratios = distinct_ratios(estimates);
  model.n_specimens = static_cast<int>(estimates.size());
  const Likelihood likelihood(model, estimates, restricted);
  Spreads spreads{0.05, 0.05, 0.05};
  constexpr int kSweeps = 4;
  const std::size_t kinds = model.n_terms > 0 ? 3 : 1;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const Spreads before = spreads;
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      spreads[kind] = best_spread(likelihood, spreads, kind);
    }
    double change = 0.0;
    for (std::size_t k = 0; k < kinds; ++k) {
      change = std::max(change, std::abs(spreads[k] - before[k]));
    }
    if (change < 1e-4) break;
  }
  if (kinds == 1) spreads[1] = spreads[2] = 0.0;
  // With as many values as specimens there is no scatter to estimate.
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    const int first = kind == 0 ? 0 : 1 + (kind == 2 ? model.n_terms : 0);
    if (!has_known_spread(model, first)) spreads[kind] = 0.0;
  }
  const Solution solution = likelihood.at(spreads);
  model.coefficients = solution.beta;
  model.covariance = solution.covariance;
  model.spread_ln_E0 = spreads[0];
  model.spread_ln_g = spreads[1];
  model.spread_ln_tau = spreads[2];
  model.log_likelihood = solution.log_likelihood;
  model.n_parameters = static_cast<int>(solution.beta.size()) + static_cast<int>(kinds);
  const auto n_values =
      static_cast<double>(estimates.size()) * static_cast<double>(estimates.front().theta.size());
  model.bic = -2.0 * model.log_likelihood + model.n_parameters * std::log(n_values);
  return model;
}

void check_shared(const std::vector<std::string>& names, int n_terms) {
  for (const std::string& name : names) {
    bool is_known = false;
    for (int i = 1; i <= n_terms; ++i) {
      is_known |= name == "g_" + std::to_string(i) || name == "tau_" + std::to_string(i);
    }
    if (is_known) continue;
    throw std::invalid_argument("'" + name + "' cannot be shared: there are E0, g, tau, and g_i " +
                                "and tau_i of " +
                                counted(static_cast<std::size_t>(n_terms), "term"));
  }
}

// All forms that these data can distinguish. The named ones come first, so that they win ties.
std::vector<RatioForm> forms_to_try(std::size_t n_ratios, int n_terms,
                                    const MixingOptions& options) {
  constexpr auto kAny = RatioVariable::kLogRatio;
  std::vector<RatioForm> forms{{kAny, kPerRatio, 0, 0},
                               {kAny, kPerRatio, kPerRatio, 0},
                               {kAny, kPerRatio, kPerRatio, kPerRatio}};
  const int highest = n_ratios >= 4 ? options.max_degree : std::min(options.max_degree, 1);
  for (const RatioVariable variable : options.variables) {
    for (int E0 = 0; E0 <= highest; ++E0) {
      for (int g = 0; g <= (n_terms > 0 ? 1 : 0); ++g) {
        for (int tau = 0; tau <= (n_terms > 0 ? 1 : 0); ++tau) {
          forms.push_back({variable, E0, g, tau});
        }
      }
    }
  }
  std::erase_if(forms, [&](const RatioForm& form) {
    return (options.share_E0 && form.E0_degree != 0) || (options.share_g && form.g_degree != 0) ||
           (options.share_times && form.tau_degree != 0);
  });
  std::vector<RatioForm> once;
  for (RatioForm& form : forms) {
    form.same = options.shared;
    if (n_terms == 0 && form.g_degree == kPerRatio) continue;
    if (std::find(once.begin(), once.end(), form) == once.end()) once.push_back(form);
  }
  return once;
}

Material common_of(const std::vector<Material>& specimens) {
  Material common;
  const Material& first = specimens.front();
  common.rho_kg_m3 = first.rho_kg_m3;
  common.T_ref_C = first.T_ref_C;
  common.shift = first.shift;
  common.valid = first.valid;
  common.provenance = first.provenance;
  common.provenance.raw_files.clear();
  common.uncertainty.emplace();
  double of_others = 0.0;
  for (const Material& one : specimens) {
    of_others += (one.nu - first.nu) / static_cast<double>(specimens.size());
    if (common.rho_kg_m3 == 0.0) common.rho_kg_m3 = one.rho_kg_m3;
    if (one.T_ref_C != common.T_ref_C) {
      common.T_ref_C.reset();
      common.shift.reset();
    }
    common.valid.t_min_s = std::max(common.valid.t_min_s, one.valid.t_min_s);
    common.valid.t_max_s = std::min(common.valid.t_max_s, one.valid.t_max_s);
    common.valid.strain_max = std::min(common.valid.strain_max, one.valid.strain_max);
    double& systematic = common.uncertainty->systematic_relative;
    systematic = std::max(systematic, one.uncertainty->systematic_relative);
    const auto& raw = one.provenance.raw_files;
    auto& all = common.provenance.raw_files;
    all.insert(all.end(), raw.begin(), raw.end());
  }
  common.nu = first.nu + of_others;
  common.E0_Pa = first.E0_Pa;
  return common;
}

void add_flags(const std::vector<RatioEstimate>& estimates, RatioFit& fit) {
  if (estimates.size() == fit.law.ratios.size()) {
    fit.flags.push_back({"one-specimen-per-ratio", 0,
                         "every ratio was measured once: scatter between specimens cannot be "
                         "separated from a misfit of the law, and the interval includes both"});
  }
  constexpr double kStrong = 10.0;  // Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773
  if (!is_law(fit.best.form) && fit.law.bic - fit.best.bic > kStrong) {
    fit.flags.push_back({"law-misfits", 0,
                         "the law describes the measured ratios much worse than separate values "
                         "for each ratio do (BIC " +
                             std::to_string(static_cast<int>(fit.law.bic - fit.best.bic)) +
                             " higher): predictions between them are not reliable"});
  }
}

}  // namespace

RatioFit fit_mixing_ratio(const std::vector<Material>& specimens, const MixingOptions& options) {
  if (specimens.size() < 3) {
    throw std::invalid_argument("a joint fit needs at least three specimens; there " +
                                std::string(specimens.size() == 1 ? "is " : "are ") +
                                std::to_string(specimens.size()));
  }
  const std::vector<RatioEstimate> estimates = ratio_estimates_of(specimens);
  const std::size_t n_ratios = distinct_ratios(estimates).size();
  if (n_ratios < 2) {
    throw std::invalid_argument(
        "all specimens have the same mixing ratio; a law in the ratio needs at least two");
  }
  RatioFit fit;
  for (std::size_t s = 0; s < specimens.size(); ++s) {
    fit.specimens.push_back({specimens[s].name, specimens[s].mixing_ratio, specimens[s].E0_Pa,
                             std::sqrt(estimates[s].covariance(0, 0))});
  }
  const int n_terms = static_cast<int>(specimens.front().terms.size());
  check_shared(options.shared, n_terms);
  for (const RatioForm& form : forms_to_try(n_ratios, n_terms, options)) {
    const RatioModel model = fitted_form(estimates, form, /*restricted=*/false);
    fit.forms.push_back({form, model.n_parameters, model.log_likelihood, model.bic});
  }
  std::stable_sort(
      fit.forms.begin(), fit.forms.end(),
      [](const RatioComparison& a, const RatioComparison& b) { return a.bic < b.bic - 1e-9; });
  const auto refitted = [&](const RatioComparison& from) {
    RatioModel model = fitted_form(estimates, from.form, /*restricted=*/true);
    model.log_likelihood = from.log_likelihood;
    model.bic = from.bic;
    return model;
  };
  const auto law = std::find_if(fit.forms.begin(), fit.forms.end(),
                                [](const RatioComparison& row) { return is_law(row.form); });
  fit.best = refitted(fit.forms.front());
  fit.law = refitted(*law);
  fit.common = common_of(specimens);
  add_flags(estimates, fit);
  return fit;
}

}  // namespace viscard
