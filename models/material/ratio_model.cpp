#include "models/material/ratio_model.h"

#include "models/maths/distributions.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

int degree_of(const RatioModel& model, int parameter) {
  if (parameter == 0) return model.form.E0_degree;
  if (!model.own_terms.empty()) return kPerRatio;
  const std::string name = parameter <= model.n_terms
                               ? "g_" + std::to_string(parameter)
                               : "tau_" + std::to_string(parameter - model.n_terms);
  const auto& same = model.form.same;
  if (std::find(same.begin(), same.end(), name) != same.end()) return 0;
  return parameter <= model.n_terms ? model.form.g_degree : model.form.tau_degree;
}

// n_terms: at the ratio of the parameter.
double spread_of(const RatioModel& model, int parameter, int n_terms) {
  if (parameter == 0) return model.spread_ln_E0;
  return parameter <= n_terms ? model.spread_ln_g : model.spread_ln_tau;
}

Index position_of(const RatioModel& model, double ratio) {
  const auto found = std::find_if(model.ratios.begin(), model.ratios.end(), [&](double measured) {
    return std::abs(measured - ratio) <= 1e-9 * std::abs(ratio);
  });
  return found == model.ratios.end() ? -1 : found - model.ratios.begin();
}

// The entries of X(ratio) that belong to one parameter.
Eigen::RowVectorXd row_at(const RatioModel& model, double ratio, int parameter) {
  const int degree = degree_of(model, parameter);
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(n_columns(model, parameter));
  if (degree == kPerRatio) {
    const Index position = position_of(model, ratio);
    require(position >= 0, "ratio " + text_of(ratio) +
                               " was not measured, and this form holds for measured ratios only");
    row[position] = 1.0;
    return row;
  }
  const ScaledVariable scaled = scale_of(model);
  const double x = (variable_of(model.form.variable, ratio) - scaled.middle) / scaled.half;
  for (int power = 0; power <= degree; ++power) row[power] = std::pow(x, power);
  return row;
}

// beta holds the coefficients of ln E0, then ln g_i and ln tau_i of each ratio.
Eigen::MatrixXd design_with_own_terms(const RatioModel& model, double ratio, Index position) {
  Index columns = n_columns(model, 0), first = 0, size = 0;
  for (std::size_t r = 0; r < model.own_terms.size(); ++r) {
    if (static_cast<Index>(r) == position) {
      first = columns;
      size = 2 * model.own_terms[r];
    }
    columns += 2 * model.own_terms[r];
  }
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(1 + size, columns);
  design.row(0).head(n_columns(model, 0)) = row_at(model, ratio, 0);
  design.block(1, first, size, size).setIdentity();
  return design;
}

// theta and its covariance for a new specimen.
struct Prediction {
  Eigen::VectorXd theta;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd quantile;  // of Student's t, for each parameter
};

Prediction predict(const RatioModel& model, double ratio) {
  const Eigen::MatrixXd design = design_at(model, ratio);
  Prediction out{design * model.coefficients, design * model.covariance * design.transpose(),
                 Eigen::VectorXd(design.rows())};
  const int n_terms = static_cast<int>(design.rows() / 2);
  for (Index k = 0; k < design.rows(); ++k) {
    const int parameter = static_cast<int>(k);
    if (!has_known_spread(model, parameter)) {
      out.quantile[k] = kNormal95;
      continue;
    }
    out.covariance(k, k) += std::pow(spread_of(model, parameter, n_terms), 2);
    out.quantile[k] = student_t_975(model.n_specimens - n_columns(model, parameter));
  }
  return out;
}

Interval around(double value, double half_width) {
  return {value - half_width, value + half_width};
}

// From value/exp(ln_half_width) to value*exp(ln_half_width).
Interval scaled_by(double value, double ln_half_width) {
  return {value * std::exp(-ln_half_width), value * std::exp(ln_half_width)};
}

// Derivatives of E_inf, E_i, ln tau_i with respect to theta.
Eigen::MatrixXd slopes_of_moduli(const Prediction& from, int n_terms) {
  const double E0_Pa = std::exp(from.theta[0]);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(1 + 2 * n_terms, 1 + 2 * n_terms);
  double rest = 1.0;
  for (Index i = 1; i <= n_terms; ++i) {
    const double g = std::exp(from.theta[i]);
    rest -= g;
    slopes(0, i) = -E0_Pa * g;
    slopes(i, 0) = slopes(i, i) = E0_Pa * g;
    slopes(n_terms + i, n_terms + i) = 1.0;
  }
  slopes(0, 0) = E0_Pa * rest;
  return slopes;
}

MaterialUncertainty uncertainty_of(const Prediction& from, int n_terms, double E_inf_Pa) {
  MaterialUncertainty out;
  const auto error = [&](Index k) { return std::sqrt(from.covariance(k, k)); };
  const auto lognormal = [&](Index k) {
    const Interval ln = around(from.theta[k], from.quantile[k] * error(k));
    return Interval{std::exp(ln.low), std::exp(ln.high)};
  };
  const Eigen::MatrixXd slopes = slopes_of_moduli(from, n_terms);
  out.covariance = slopes * from.covariance * slopes.transpose();
  out.E0_Pa_95 = lognormal(0);
  const double worst = from.quantile.maxCoeff();
  const double ln_E_inf_se = std::sqrt(out.covariance(0, 0)) / E_inf_Pa;
  const double E_inf_quantile = ln_E_inf_se > 0.0 ? from.quantile[0] : worst;
  out.E_inf_Pa_95 = scaled_by(E_inf_Pa, E_inf_quantile * ln_E_inf_se);
  out.covariance_parameters = {"E_inf_Pa"};
  for (int i = 1; i <= n_terms; ++i) {
    out.covariance_parameters.push_back("E_" + std::to_string(i) + "_Pa");
  }
  for (Index i = 1; i <= n_terms; ++i) {
    out.covariance_parameters.push_back("ln_tau_" + std::to_string(i));
    TermUncertainty term;
    const double modulus_Pa = std::exp(from.theta[0] + from.theta[i]);
    term.modulus_se_Pa = std::sqrt(out.covariance(i, i));
    term.ln_tau_se = error(n_terms + i);
    const double ln_half = from.quantile[i] * term.modulus_se_Pa / modulus_Pa;
    term.modulus_Pa_95 = scaled_by(modulus_Pa, ln_half);
    term.g_95 = lognormal(i);
    term.tau_s_95 = lognormal(n_terms + i);
    out.terms.push_back(term);
  }
  return out;
}

bool is_in_range(const RatioFit& fit, double ratio) {
  return ratio >= fit.law.ratios.front() && ratio <= fit.law.ratios.back();
}

std::string outside_range(const RatioFit& fit, double ratio) {
  return "ratio " + text_of(ratio) + " lies outside the measured range, " +
         text_of(fit.law.ratios.front()) + " to " + text_of(fit.law.ratios.back());
}

void check_range(const RatioFit& fit, double ratio, bool may_extrapolate) {
  require_positive("mixing ratio", ratio);
  require(may_extrapolate || is_in_range(fit, ratio),
          outside_range(fit, ratio) +
              ", where no data support the law. Pass --extrapolate to use it all the same; the "
              "card will carry a warning");
}

// For each of the three spreads, the name of its parameters and the number of the first.
std::vector<std::pair<std::string, int>> first_of_each_kind(int n_terms) {
  if (n_terms == 0) return {{"E0", 0}};
  return {{"E0", 0}, {"g", 1}, {"tau", n_terms + 1}};
}

}  // namespace

double variable_of(RatioVariable variable, double ratio) {
  switch (variable) {
    case RatioVariable::kLogRatio:
      return std::log(ratio);
    case RatioVariable::kRatio:
      return ratio;
    case RatioVariable::kCrosslinkerShare:
      return 1.0 / (1.0 + ratio);
  }
  return 0.0;
}

ScaledVariable scale_of(const RatioModel& model) {
  const double a = variable_of(model.form.variable, model.ratios.front());
  const double b = variable_of(model.form.variable, model.ratios.back());
  return {0.5 * (a + b), a == b ? 1.0 : 0.5 * (b - a)};
}

bool operator==(const RatioForm& a, const RatioForm& b) {
  const bool same_degrees = a.E0_degree == b.E0_degree && a.g_degree == b.g_degree &&
                            a.tau_degree == b.tau_degree && a.same == b.same;
  const bool uses_variable = a.E0_degree > 0 || a.g_degree > 0 || a.tau_degree > 0;
  return same_degrees && (a.variable == b.variable || !uses_variable);
}

bool is_law(const RatioForm& form) {
  return form.E0_degree >= 0 && form.g_degree >= 0 && form.tau_degree >= 0;
}

int n_columns(const RatioModel& model, int parameter) {
  const int degree = degree_of(model, parameter);
  return degree == kPerRatio ? static_cast<int>(model.ratios.size()) : degree + 1;
}

Eigen::MatrixXd design_at(const RatioModel& model, double ratio) {
  const Index position = position_of(model, ratio);
  if (!model.own_terms.empty()) return design_with_own_terms(model, ratio, position);
  const int size = 1 + 2 * model.n_terms;
  Index columns = 0;
  for (int k = 0; k < size; ++k) columns += n_columns(model, k);
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(size, columns);
  Index column = 0;
  for (int k = 0; k < size; ++k) {
    design.row(k).segment(column, n_columns(model, k)) = row_at(model, ratio, k);
    column += n_columns(model, k);
  }
  return design;
}

bool has_known_spread(const RatioModel& model, int parameter) {
  return model.n_specimens > n_columns(model, parameter);
}

Material material_at_ratio(const RatioFit& fit, double ratio, bool may_extrapolate) {
  check_range(fit, ratio, may_extrapolate);
  const bool is_measured = position_of(fit.best, ratio) >= 0;
  const RatioModel& model = is_measured ? fit.best : fit.law;
  require(is_measured || model.own_terms.empty(),
          "ratio " + text_of(ratio) +
              " was not measured, and with --own-terms the terms are known at measured ratios "
              "only; fit again without it");
  const Prediction from = predict(model, ratio);
  const int n_terms = static_cast<int>(from.theta.size() / 2);
  Material material = fit.common;
  material.mixing_ratio = ratio;
  material.E0_Pa = std::exp(from.theta[0]);
  double rest = 1.0;
  for (Index i = 1; i <= n_terms; ++i) {
    const double g = std::exp(from.theta[i]);
    material.terms.push_back({g, g, std::exp(from.theta[n_terms + i])});
    rest -= g;
  }
  require(rest > 0.0, "at ratio " + text_of(ratio) +
                          " the law lets the whole modulus relax; it is not valid there");
  material.uncertainty = uncertainty_of(from, n_terms, material.E0_Pa * rest);
  if (fit.common.uncertainty) {
    material.uncertainty->systematic_relative = fit.common.uncertainty->systematic_relative;
    material.uncertainty->systematic_parts = fit.common.uncertainty->systematic_parts;
  }
  material.name += (material.name.empty() ? "ratio " : " ") + text_of(ratio) + ":1";
  material.flags = fit.flags;
  std::string unknown;
  for (const auto& [name, parameter] : first_of_each_kind(n_terms)) {
    if (!has_known_spread(model, parameter)) unknown += (unknown.empty() ? "" : ", ") + name;
  }
  if (!unknown.empty()) {
    material.flags.push_back({"spread-unknown", 0,
                              "too few specimens to estimate the scatter of " + unknown +
                                  " between specimens; the intervals are those of the specimen "
                                  "that was measured"});
  }
  if (!is_in_range(fit, ratio)) {
    material.flags.push_back({"extrapolated-ratio", 0, outside_range(fit, ratio)});
  }
  return material;
}

RatioBand ratio_band(const RatioFit& fit, int count) {
  RatioBand band;
  const double low = fit.law.ratios.front(), high = fit.law.ratios.back();
  for (int i = 0; i < count; ++i) {
    const double ratio = i + 1 == count ? high : low + (high - low) * i / (count - 1);
    const Prediction at = predict(fit.law, ratio);
    const double half = at.quantile[0] * std::sqrt(at.covariance(0, 0));
    band.ratio.push_back(ratio);
    band.E0_Pa.push_back(std::exp(at.theta[0]));
    band.E0_low_Pa.push_back(std::exp(at.theta[0] - half));
    band.E0_high_Pa.push_back(std::exp(at.theta[0] + half));
  }
  return band;
}

}  // namespace viscard
