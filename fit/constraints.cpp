#include "fit/constraints.h"

#include <Eigen/Dense>
#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class Stem { kE0, kEInf, kModulus, kShare, kTime };

struct Name {
  Stem stem = Stem::kE0;
  int term = 0;  // from 1; 0: not of a term
};

Name name_of(const std::string& text) {
  if (text == "E0") return {Stem::kE0, 0};
  if (text == "E_inf") return {Stem::kEInf, 0};
  const std::pair<const char*, Stem> kinds[] = {
      {"E_", Stem::kModulus}, {"g_", Stem::kShare}, {"tau_", Stem::kTime}};
  for (const auto& [prefix, stem] : kinds) {
    if (!text.starts_with(prefix)) continue;
    char* end = nullptr;
    const long term = std::strtol(text.c_str() + std::strlen(prefix), &end, 10);
    if (*end == '\0' && term >= 1 && term <= 1000) return {stem, static_cast<int>(term)};
  }
  throw std::invalid_argument("'" + text +
                              "' is no parameter; there are E0, E_inf, and E_1, g_1, tau_1 ... for "
                              "each term");
}

double number_of(const std::string& text, const std::string& whole) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) {
    throw std::invalid_argument("'" + whole + "': '" + text +
                                "' is not a number; write NAME=VALUE or NAME=LOW:HIGH in SI");
  }
  return value;
}

// The parameters that constraints speak of, theta = (E_inf, E_i | E0, g_i; ln tau_i; the rest), and
// how a state follows from them.
class Parametrisation {
 public:
  Parametrisation(const SpectralModel& model, Index n_terms, bool by_shares)
      : model_(model), n_terms_(n_terms), by_shares_(by_shares) {
    has_equilibrium_ = model.n_common() > 0 && !model.common()[0].is_free;
  }
  // Where a parameter stands; -1 for E_inf of a liquid, which is zero anyway.
  Index position(const Name& name) const {
    if (name.stem == Stem::kE0 || name.stem == Stem::kEInf) return has_equilibrium_ ? 0 : -1;
    if (name.stem == Stem::kTime) return model_.n_common() + n_terms_ + name.term - 1;
    return model_.n_common() + name.term - 1;
  }
  Index size() const { return model_.n_common() + 2 * n_terms_ + model_.n_nuisances(); }

  Eigen::VectorXd theta_of(const SpectralState& state) const {
    Eigen::VectorXd theta(size());
    theta << state.coefficients, state.ln_tau, state.nuisance;
    if (by_shares_) {
      const Index n = model_.n_common();
      const double E0 = state.coefficients[0] + theta.segment(n, n_terms_).sum();
      theta.segment(n, n_terms_) /= E0;
      theta[0] = E0;
    }
    return theta;
  }
  SpectralState state_of(const Eigen::VectorXd& theta) const {
    SpectralState state;
    const Index n = model_.n_common();
    state.coefficients = theta.head(n + n_terms_);
    if (by_shares_) {
      const double E0 = theta[0];
      state.coefficients.segment(n, n_terms_) *= E0;
      state.coefficients[0] = E0 - state.coefficients.segment(n, n_terms_).sum();
    }
    state.ln_tau = theta.segment(n + n_terms_, n_terms_);
    state.nuisance = theta.tail(model_.n_nuisances());
    return state;
  }
  // d(coefficients, ln tau, nuisance)/d theta.
  Eigen::MatrixXd slopes(const Eigen::VectorXd& theta) const {
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Identity(size(), size());
    if (!by_shares_) return slopes;
    const Index n = model_.n_common();
    const double E0 = theta[0];
    slopes(0, 0) = 1.0 - theta.segment(n, n_terms_).sum();
    for (Index i = n; i < n + n_terms_; ++i) {
      slopes(i, 0) = theta[i];
      slopes(i, i) = E0;
      slopes(0, i) = -E0;
    }
    return slopes;
  }
  Eigen::VectorXd lower() const {
    Eigen::VectorXd low = Eigen::VectorXd::Constant(size(), -kInfinity);
    const Index n = model_.n_common();
    if (!model_.may_be_negative()) {
      low.segment(n, n_terms_).setZero();
      if (has_equilibrium_) low[0] = 0.0;
    }
    low.segment(n + n_terms_, n_terms_).setConstant(model_.ln_tau_min());
    for (Index k = 0; k < model_.n_nuisances(); ++k) {
      low[n + 2 * n_terms_ + k] = model_.nuisances()[static_cast<std::size_t>(k)].low;
    }
    return low;
  }
  Eigen::VectorXd upper() const {
    Eigen::VectorXd high = Eigen::VectorXd::Constant(size(), kInfinity);
    const Index n = model_.n_common();
    high.segment(n + n_terms_, n_terms_).setConstant(model_.ln_tau_max());
    for (Index k = 0; k < model_.n_nuisances(); ++k) {
      high[n + 2 * n_terms_ + k] = model_.nuisances()[static_cast<std::size_t>(k)].high;
    }
    return high;
  }
  const SpectralModel& model() const { return model_; }

 private:
  const SpectralModel& model_;
  Index n_terms_;
  bool by_shares_;
  bool has_equilibrium_ = false;
};

// Residuals in all parameters; scaled so that the solver's absolute thresholds do not know the
// unit.
class FullCost final : public ceres::CostFunction {
 public:
  explicit FullCost(const Parametrisation& form)
      : form_(form), scale_(1e6 / std::max(form.model().data().norm(), 1e-280)) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(form.size()));
    set_num_residuals(static_cast<int>(form.model().n_rows()));
  }
  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Eigen::VectorXd> theta(parameters[0], form_.size());
    const SpectralModel& model = form_.model();
    const SpectralState state = form_.state_of(theta);
    const Eigen::MatrixXd values = model.columns(state.ln_tau, state.nuisance, false).values;
    Eigen::Map<Eigen::VectorXd> out(residuals, model.n_rows());
    out = scale_ * (values * state.coefficients - model.data());
    if (!out.allFinite()) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        jacobians[0], model.n_rows(), form_.size()) =
        scale_ * full_jacobian(model, state) * form_.slopes(theta);
    return true;
  }

 private:
  const Parametrisation& form_;
  const double scale_;
};

struct Box {
  Eigen::VectorXd low, high;
};

Box box_of(const Parametrisation& form, const std::vector<ParameterConstraint>& constraints) {
  Box box{form.lower(), form.upper()};
  for (const ParameterConstraint& one : constraints) {
    const Name name = name_of(one.name);
    const Index at = form.position(name);
    if (at < 0) {
      throw std::invalid_argument(one.name + " cannot be constrained for a liquid");
    }
    const bool is_time = name.stem == Stem::kTime;
    box.low[at] = is_time ? std::log(one.low) : one.low;
    box.high[at] = is_time ? std::log(one.high) : one.high;
  }
  return box;
}

SpectralState solve_in_box(const Parametrisation& form, const Box& box,
                           const SpectralState& start) {
  Eigen::VectorXd theta = form.theta_of(start).cwiseMax(box.low).cwiseMin(box.high);
  ceres::Problem problem;
  problem.AddParameterBlock(theta.data(), static_cast<int>(theta.size()));
  std::vector<int> fixed;
  for (Index i = 0; i < theta.size(); ++i) {
    const int at = static_cast<int>(i);
    if (box.low[i] == box.high[i]) {
      fixed.push_back(at);
      continue;
    }
    if (std::isfinite(box.low[i])) problem.SetParameterLowerBound(theta.data(), at, box.low[i]);
    if (std::isfinite(box.high[i])) problem.SetParameterUpperBound(theta.data(), at, box.high[i]);
  }
  if (static_cast<Index>(fixed.size()) < theta.size() && !fixed.empty()) {
    problem.SetManifold(theta.data(),
                        new ceres::SubsetManifold(static_cast<int>(theta.size()), fixed));
  }
  problem.AddResidualBlock(new FullCost(form), nullptr, theta.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 500;
  options.function_tolerance = 1e-15;
  options.parameter_tolerance = 1e-13;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  SpectralState state = form.state_of(theta);
  const SpectralModel& model = form.model();
  state.rss = (model.columns(state.ln_tau, state.nuisance, false).values * state.coefficients -
               model.data())
                  .squaredNorm();
  state.is_converged = summary.IsSolutionUsable();
  return state;
}

// Times to start from: the constrained ones where they must be, the others spread over the range
// or, where there are as many, those of a smaller free fit.
SpectralState spread_start(const SpectralModel& model, const Parametrisation& form, const Box& box,
                           const SpectralFit& fit, Index n_terms) {
  Eigen::VectorXd ln_tau(n_terms);
  std::vector<Index> open;
  for (Index i = 0; i < n_terms; ++i) {
    const Index at = form.position({Stem::kTime, static_cast<int>(i) + 1});
    const bool is_pinned = box.high[at] - box.low[at] < 1e-12;
    ln_tau[i] = 0.5 * (box.low[at] + box.high[at]);
    if (!is_pinned) open.push_back(i);
  }
  const auto n_open = static_cast<Index>(open.size());
  const auto smaller = std::find_if(fit.path.begin(), fit.path.end(),
                                    [&](const SpectralState& s) { return s.n_terms() == n_open; });
  for (Index k = 0; k < n_open; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(n_open);
    const double spread = model.ln_tau_min() + share * (model.ln_tau_max() - model.ln_tau_min());
    const Index at =
        form.position({Stem::kTime, static_cast<int>(open[static_cast<std::size_t>(k)]) + 1});
    const double wanted = smaller != fit.path.end() ? smaller->ln_tau[k] : spread;
    ln_tau[open[static_cast<std::size_t>(k)]] = std::clamp(wanted, box.low[at], box.high[at]);
  }
  return solve_coefficients(model, ln_tau, fit.state.nuisance);
}

// Covariance of the parameters left free, carried to all: fixed ones and those on a bound have
// none.
Eigen::MatrixXd free_covariance(const Parametrisation& form, const Box& box,
                                const SpectralState& state, double variance) {
  const Eigen::VectorXd theta = form.theta_of(state);
  const Eigen::MatrixXd slopes = form.slopes(theta);
  std::vector<Index> free;
  for (Index i = 0; i < theta.size(); ++i) {
    const double reach = 1e-9 * (1.0 + std::abs(theta[i]));
    if (theta[i] > box.low[i] + reach && theta[i] < box.high[i] - reach) free.push_back(i);
  }
  if (free.empty()) return Eigen::MatrixXd::Zero(slopes.rows(), slopes.rows());  // all at a bound
  const Eigen::MatrixXd chosen = slopes(Eigen::all, free);
  const Eigen::MatrixXd jacobian = full_jacobian(form.model(), state) * chosen;
  const Eigen::VectorXd scale = jacobian.colwise().norm().transpose().cwiseMax(1e-300);
  const Eigen::MatrixXd scaled = jacobian * scale.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd inverse =
      (scaled.transpose() * scaled).completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::MatrixXd of_free =
      scale.cwiseInverse().asDiagonal() * inverse * scale.cwiseInverse().asDiagonal();
  return variance * chosen * of_free * chosen.transpose();
}

bool speaks_of_shares(const std::vector<ParameterConstraint>& constraints) {
  return std::any_of(constraints.begin(), constraints.end(), [](const ParameterConstraint& one) {
    const Stem stem = name_of(one.name).stem;
    return stem == Stem::kShare || stem == Stem::kE0;
  });
}

}  // namespace

ParameterConstraint constraint_from_text(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw std::invalid_argument("'" + text + "': write NAME=VALUE or NAME=LOW:HIGH in SI");
  }
  ParameterConstraint out{text.substr(0, equals), 0.0, 0.0};
  name_of(out.name);
  const std::string value = text.substr(equals + 1);
  const std::size_t colon = value.find(':');
  out.low = number_of(value.substr(0, colon), text);
  out.high = colon == std::string::npos ? out.low : number_of(value.substr(colon + 1), text);
  return out;
}

void validate(const std::vector<ParameterConstraint>& constraints, int n_terms) {
  bool has_moduli = false;
  for (const ParameterConstraint& one : constraints) {
    const Name name = name_of(one.name);
    if (name.term > n_terms) {
      throw std::invalid_argument(one.name + " is of a term that is not there; the fit has " +
                                  std::to_string(n_terms) + " terms");
    }
    if (!(one.low <= one.high) || (name.stem == Stem::kTime && !(one.low > 0.0))) {
      throw std::invalid_argument("the bounds of " + one.name +
                                  " must ascend, and times must be positive");
    }
    has_moduli = has_moduli || name.stem == Stem::kModulus || name.stem == Stem::kEInf;
  }
  if (has_moduli && speaks_of_shares(constraints)) {
    throw std::invalid_argument(
        "constrain either moduli (E_inf, E_i) or E0 and shares (g_i), not both at once");
  }
}

void constrain(const SpectralModel& model, const FitOptions& options, SpectralFit& fit) {
  const Index n_terms = options.n_terms.value_or(static_cast<int>(fit.state.n_terms()));
  validate(options.constraints, static_cast<int>(n_terms));
  const bool by_shares = speaks_of_shares(options.constraints);
  if (model.n_common() == 0 || model.common()[0].is_free) {
    throw std::invalid_argument("parameters of a liquid cannot be constrained");
  }
  const Parametrisation form(model, n_terms, by_shares);
  const Box box = box_of(form, options.constraints);
  SpectralState best = solve_in_box(form, box, spread_start(model, form, box, fit, n_terms));
  if (fit.state.n_terms() == n_terms) {
    const SpectralState other = solve_in_box(form, box, fit.state);
    if (other.rss < best.rss) best = other;
  }
  fit.state = best;
  fit.rss = best.rss + model.hidden_rss(best.ln_tau, best.nuisance, best.coefficients);
  const auto n_parameters = static_cast<double>(form.size());
  fit.variance = fit.rss / std::max(1.0, model.n_samples() - n_parameters);
  fit.noise = {};
  double inflation = 1.0;
  if (!options.white_noise) {
    fit.noise =
        autoregression(model.residual_series(best.ln_tau, best.nuisance, best.coefficients));
    inflation = fit.noise.inflation();
  }
  fit.covariance = free_covariance(form, box, best, fit.variance * inflation);
  for (const ParameterConstraint& one : options.constraints) {
    char text[160];
    if (one.low == one.high) {
      std::snprintf(text, sizeof text, "%s was fixed at %.6g", one.name.c_str(), one.low);
    } else {
      std::snprintf(text, sizeof text, "%s was held between %.6g and %.6g", one.name.c_str(),
                    one.low, one.high);
    }
    fit.notes.push_back({"constrained", 0, text});
  }
}

}  // namespace viscard
