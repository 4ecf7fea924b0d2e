#include "models/pillar/time/viscoelastic_system.h"

#include "models/maths/require.h"
#include "models/pillar/time/step_weights.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {

SymmetricSparse stiffness_at(const ViscoelasticSystem& system, double shear_factor,
                             double bulk_factor) {
  SymmetricSparse matrix = system.elastic;
  if (system.incompressible) bulk_factor = 1.0;
  matrix.coeffs() += shear_factor * system.shear.coeffs() + bulk_factor * system.bulk.coeffs();
  return matrix;
}

Eigen::VectorXd shear_times(const ViscoelasticSystem& system, const Eigen::VectorXd& u) {
  return system.by_shear ? system.by_shear(u) : times(system.shear, u);
}

Eigen::VectorXd bulk_times(const ViscoelasticSystem& system, const Eigen::VectorXd& u) {
  return system.by_bulk ? system.by_bulk(u) : times(system.bulk, u);
}

StiffnessFactor::Product product_at(const ViscoelasticSystem& system, double shear_factor,
                                    double bulk_factor) {
  if (!system.by_shear) return {};
  const double bulk = system.incompressible ? 1.0 : bulk_factor;
  return [&system, shear_factor, bulk](const Eigen::VectorXd& u, const Eigen::VectorXd& source) {
    return Eigen::VectorXd(times(system.elastic, u) + shear_factor * shear_times(system, u) +
                           bulk * bulk_times(system, source));
  };
}

ViscoelasticStepper::ViscoelasticStepper(const ViscoelasticSystem& system, int order)
    : system_(&system), matrix_(system.shear), order_(order) {
  require_value(order >= 1 && order <= 5, "order of the time steps", order, "", "from 1 to 5");
  const auto n_terms = static_cast<Eigen::Index>(system.terms.size());
  g_.resize(n_terms);
  k_.resize(n_terms);
  for (Eigen::Index i = 0; i < n_terms; ++i) {
    g_[i] = system.terms[static_cast<std::size_t>(i)].g;
    k_[i] = system.terms[static_cast<std::size_t>(i)].k;
  }
  decay_.resize(n_terms);
  memory_ = Eigen::MatrixXd::Zero(system.load.size(), n_terms);
  increments_ = Eigen::MatrixXd::Zero(system.load.size(), order - 1);
  displacement_vector_ = Eigen::VectorXd::Zero(system.load.size());
  if (system.incompressible) factor_.constrain(system.bulk);
}

void ViscoelasticStepper::prepare(double dt_s) {
  if (dt_s == 0.0) earlier_s_.clear();  // a jump has no slope in common with its neighbours
  std::vector<double> lengths_s{dt_s};
  lengths_s.insert(lengths_s.end(), earlier_s_.begin(), earlier_s_.end());
  if (lengths_s == factored_s_) return;
  std::vector<double> earlier_over_h;
  for (const double earlier_s : earlier_s_) earlier_over_h.push_back(earlier_s / dt_s);
  const StepWeights step_weights(earlier_over_h);
  weights_.resize(step_weights.count(), g_.size());
  double shear = 1.0;
  double bulk = 1.0;
  for (Eigen::Index i = 0; i < g_.size(); ++i) {
    const double x = dt_s / system_->terms[static_cast<std::size_t>(i)].tau_s;
    decay_[i] = std::exp(-x);
    weights_.col(i) = step_weights.at(x);
    shear -= g_[i] * (1.0 - weights_(0, i));
    bulk -= k_[i] * (1.0 - weights_(0, i));
  }
  matrix_ = stiffness_at(*system_, shear, bulk);
  factor_.factor(matrix_);
  load_response_ = factor_.solve(system_->load);
  factored_s_ = lengths_s;
  ++factorisations_;
}

void ViscoelasticStepper::advance(double dt_s, Control control, double value) {
  if (!(dt_s >= 0.0) || !std::isfinite(dt_s)) {
    throw std::invalid_argument("time step of " + text_of(dt_s) +
                                " s; steps must be finite and not negative");
  }
  prepare(dt_s);
  const auto n_earlier = static_cast<Eigen::Index>(earlier_s_.size());
  memory_ = memory_ * decay_.asDiagonal();
  if (n_earlier > 0) {
    memory_ += increments_.leftCols(n_earlier) * weights_.bottomRows(n_earlier);
  }
  // Force of the body at the end of the step without motion: the residual to be balanced.
  const Eigen::VectorXd& u = displacement_vector_;
  Eigen::VectorXd carried = times(system_->elastic, u);
  carried += times(system_->shear, (1.0 - g_.sum()) * u + memory_ * g_);
  if (!system_->incompressible) {
    carried += times(system_->bulk, (1.0 - k_.sum()) * u + memory_ * k_);
  }
  Eigen::VectorXd change = factor_.solve(-carried);
  if (control == Control::kForce) {
    force_ = value;
  } else {
    const double wanted = value - displacement();
    force_ = (wanted - system_->load.dot(change)) / system_->load.dot(load_response_);
  }
  change += force_ * load_response_;
  displacement_vector_ += change;
  memory_ += change * weights_.row(0);
  remember(dt_s, change);
}

void ViscoelasticStepper::remember(double dt_s, const Eigen::VectorXd& increment) {
  if (order_ == 1 || dt_s == 0.0) return;
  for (Eigen::Index m = increments_.cols() - 1; m > 0; --m) {
    increments_.col(m) = increments_.col(m - 1);
  }
  increments_.col(0) = increment;
  earlier_s_.insert(earlier_s_.begin(), dt_s);
  earlier_s_.resize(std::min(earlier_s_.size(), static_cast<std::size_t>(order_ - 1)));
}

}  // namespace viscard
