#include "fit/laws/fit_mixing_ratio.h"

#include "fit/laws/ratio_estimates.h"
#include "fit/laws/ratio_forms.h"
#include "fit/laws/scatter_levels.h"
#include "fit/laws/touch_pool.h"
#include "models/maths/dense.h"
#include "models/maths/text_of_number.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Generalised least squares at given spreads, and the log likelihood there.
struct Solution {
  Eigen::VectorXd beta;
  Eigen::MatrixXd covariance;
  double log_likelihood = -std::numeric_limits<double>::infinity();
};

class Likelihood {
 public:
  Likelihood(const RatioModel& shape, const std::vector<RatioEstimate>& estimates, bool restricted)
      : estimates_(estimates), restricted_(restricted) {
    for (const RatioEstimate& one : estimates) designs_.push_back(design_at(shape, one.ratio));
  }

  Solution at(const Spreads& spreads) const {
    const Index size = designs_.front().cols();
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
    double twice = 0.0;  // -2 log likelihood
    for (std::size_t s = 0; s < estimates_.size(); ++s) {
      Eigen::MatrixXd variance = estimates_[s].covariance;
      add_spreads(spreads, variance);
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
  bool restricted_;
};

// shape: numbers of terms, ratios and specimens.
RatioModel fitted_form(const std::vector<RatioEstimate>& estimates, const RatioModel& shape,
                       const RatioForm& form, bool restricted) {
  RatioModel model = shape;
  model.form = form;
  const Likelihood likelihood(model, estimates, restricted);
  Spreads spreads{0.05, 0.05, 0.05};
  constexpr int kSweeps = 4;
  const std::size_t kinds = model.n_terms > 0 ? 3 : 1;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const Spreads before = spreads;
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      spreads[kind] = best_spread([&](double spread) {
        Spreads at = spreads;
        at[kind] = spread;
        return likelihood.at(at).log_likelihood;
      });
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
  double n_values = 0.0;
  for (const RatioEstimate& one : estimates) n_values += static_cast<double>(one.theta.size());
  model.bic = -2.0 * model.log_likelihood + model.n_parameters * std::log(n_values);
  return model;
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
    // Every specimen was pressed on the same bench; the specimen that its uncertainty affects most
    // determines the value.
    MaterialUncertainty& all = *common.uncertainty;
    if (one.uncertainty->systematic_relative > all.systematic_relative) {
      all.systematic_relative = one.uncertainty->systematic_relative;
      all.systematic_parts = one.uncertainty->systematic_parts;
    }
    const auto& raw = one.provenance.raw_files;
    auto& files = common.provenance.raw_files;
    files.insert(files.end(), raw.begin(), raw.end());
  }
  common.nu = first.nu + of_others;
  common.E0_Pa = first.E0_Pa;
  return common;
}

void add_flags(RatioFit& fit) {
  const auto n_ratios = static_cast<int>(fit.law.ratios.size());
  if (fit.law.n_specimens == n_ratios) {
    fit.flags.push_back({"one-specimen-per-ratio", 0,
                         "every ratio was measured once: scatter between specimens cannot be "
                         "separated from a misfit of the law, and the interval includes both"});
  }
  for (const Scatter& scatter : fit.scatter) {
    if (scatter.quantity != "ln_E0" || !(scatter.ratio.interval_95.low > 0.0)) continue;
    // With one specimen at each ratio this level also contains the scatter between specimens, which
    // the law allows for.
    if (!is_identified(scatter.specimen)) continue;
    fit.flags.push_back({"ratio-scatter", 0,
                         "E0 of the ratios scatters about the law by " +
                             text_of(100.0 * scatter.ratio.deviation, 2) + " % (at least " +
                             text_of(100.0 * scatter.ratio.interval_95.low, 2) +
                             " %), which the specimens do not explain: intervals between the "
                             "measured ratios are too narrow"});
  }
  constexpr double kStrong = 10.0;  // Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773
  if (!reaches_all_ratios(fit.best, fit.best.form) && fit.law.bic - fit.best.bic > kStrong) {
    fit.flags.push_back({"law-misfits", 0,
                         "the law describes the measured ratios much worse than separate values "
                         "for each ratio do (BIC " +
                             std::to_string(static_cast<int>(fit.law.bic - fit.best.bic)) +
                             " higher): predictions between them are not reliable"});
  }
}

// Numbers of terms, ratios and specimens.
RatioModel shape_of(const std::vector<RatioEstimate>& specimens, bool own_terms) {
  RatioModel shape;
  shape.ratios = distinct_ratios(specimens);
  shape.n_specimens = static_cast<int>(specimens.size());
  if (own_terms) shape.own_terms.resize(shape.ratios.size());
  for (const RatioEstimate& one : specimens) {
    const int n = static_cast<int>(one.theta.size() / 2);
    shape.n_terms = std::max(shape.n_terms, n);
    if (!own_terms) continue;
    const auto at = std::find(shape.ratios.begin(), shape.ratios.end(), one.ratio);
    shape.own_terms[static_cast<std::size_t>(at - shape.ratios.begin())] = n;
  }
  return shape;
}

void check_records(const std::vector<Material>& records, int n_specimens, std::size_t n_ratios) {
  constexpr int kFewest = 3;
  if (n_specimens < kFewest) {
    std::string text = "a joint fit needs at least three specimens; there " +
                       std::string(n_specimens == 1 ? "is " : "are ") + std::to_string(n_specimens);
    if (records.size() > static_cast<std::size_t>(n_specimens)) {
      text += " (" + std::to_string(records.size()) +
              " records, but repeats on one specimen count as one specimen)";
    }
    throw std::invalid_argument(text);
  }
  if (n_ratios < 2) {
    throw std::invalid_argument(
        "all specimens have the same mixing ratio; a law in the ratio needs at least two");
  }
}

void list_specimens(const std::vector<Material>& records,
                    const std::vector<RatioEstimate>& estimates, RatioFit& fit) {
  std::map<int, int> n_touches;
  for (std::size_t s = 0; s < records.size(); ++s) {
    fit.specimens.push_back({records[s].name, records[s].mixing_ratio, records[s].E0_Pa,
                             std::sqrt(estimates[s].covariance(0, 0)), estimates[s].specimen + 1,
                             ++n_touches[estimates[s].specimen]});
  }
}

}  // namespace

RatioFit fit_mixing_ratio(const std::vector<Material>& records, const MixingOptions& options) {
  const std::vector<RatioEstimate> estimates = ratio_estimates_of(
      records, options.own_terms ? EqualTerms::kAtEachRatio : EqualTerms::kEverywhere);
  check_records(records, count_specimens(estimates), distinct_ratios(estimates).size());
  RatioFit fit;
  list_specimens(records, estimates, fit);
  const Spreads touch = touch_spreads_of(estimates);
  const std::vector<RatioEstimate> specimens = pooled_touches(estimates, touch);
  RatioModel shape = shape_of(specimens, options.own_terms);
  shape.touch_ln_E0 = touch[0];
  shape.touch_ln_g = touch[1];
  shape.touch_ln_tau = touch[2];
  check_forms(options, shape.n_terms);
  for (const RatioForm& form : forms_to_try(shape, options)) {
    const RatioModel model = fitted_form(specimens, shape, form, /*restricted=*/false);
    fit.forms.push_back({form, model.n_parameters, model.log_likelihood, model.bic});
  }
  std::stable_sort(
      fit.forms.begin(), fit.forms.end(),
      [](const RatioComparison& a, const RatioComparison& b) { return a.bic < b.bic - 1e-9; });
  const auto refitted = [&](const RatioComparison& from) {
    RatioModel model = fitted_form(specimens, shape, from.form, /*restricted=*/true);
    model.log_likelihood = from.log_likelihood;
    model.bic = from.bic;
    return model;
  };
  const auto law =
      std::find_if(fit.forms.begin(), fit.forms.end(),
                   [&](const RatioComparison& row) { return reaches_all_ratios(shape, row.form); });
  fit.best = refitted(fit.forms.front());
  fit.law = refitted(*law);
  fit.scatter = scatter_levels(estimates, fit.law);
  fit.common = common_of(records);
  add_flags(fit);
  return fit;
}

}  // namespace viscard
