#include "models/hyperelastic/finite_viscoelasticity.h"

#include "models/maths/branch_step.h"
#include "models/maths/require.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

void check_history(const Course& history) {
  for (std::size_t i = 0; i < history.size(); ++i) {
    const std::string point = " of point " + std::to_string(i + 1) + " of a history";
    require_value(true, "the time" + point, history[i].time_s, "s", "finite");
    require_positive("the stretch" + point, history[i].value, "");
    require(i == 0 || history[i].time_s >= history[i - 1].time_s,
            "the time" + point + " is before the one of the point before it");
  }
}

}  // namespace

void validate(const std::vector<RubberTerm>& terms) {
  double sum = 0.0;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    require_value(terms[i].g >= 0.0, "g_" + number, terms[i].g, "", "at least 0");
    require_positive("tau_" + number, terms[i].tau_s, "s");
    sum += terms[i].g;
  }
  constexpr double kRounding = 1e-12;
  require_value(sum <= 1.0 + kRounding, "the sum of all g", sum, "", "at most 1");
}

StretchCourse::StretchCourse(Deformation deformation, const Course& history)
    : deformation_(deformation) {
  check_history(history);
  constexpr double kMostStrain = 0.02;
  double time_s = history.empty() ? 0.0 : history.front().time_s, stretch = 1.0;
  for (const CoursePoint& point : history) {
    const double dt_s = point.time_s - time_s;
    const double change = std::abs(std::log(point.value / stretch));
    const bool is_jump = !(dt_s > 0.0);
    const int n = is_jump ? 1 : std::max(1, static_cast<int>(std::ceil(change / kMostStrain)));
    for (int k = 1; k <= n; ++k) {
      const double at = k == n ? point.value : stretch + (point.value - stretch) * k / n;
      log_stretch_.push_back(std::log(at));
      dt_s_.push_back(dt_s / n);
    }
    at_.push_back(log_stretch_.size() - 1);
    time_s = point.time_s;
    stretch = point.value;
  }
}

StretchCourse::UnitStress StretchCourse::unit_stress(HyperelasticForm form,
                                                     const Eigen::VectorXd& shapes,
                                                     bool with_slopes) const {
  const auto n_steps = static_cast<Eigen::Index>(log_stretch_.size());
  const Eigen::Index n = n_moduli(form);
  const Stress blank{Eigen::MatrixXd(n, n_steps), Eigen::MatrixXd(n, n_steps)};
  UnitStress out{blank, {}};
  if (with_slopes) out.slopes.assign(static_cast<std::size_t>(n_shapes(form)), blank);
  const Eigen::Vector3d direction = strain_direction(deformation_);
  for (Eigen::Index i = 0; i < n_steps; ++i) {
    const Eigen::Vector3d log_strain = log_stretch_[static_cast<std::size_t>(i)] * direction;
    const double by_first = std::exp(-2.0 * log_strain[0]),
                 by_third = std::exp(-2.0 * log_strain[2]);
    const PrincipalColumns kirchhoff = principal_columns(form, shapes, log_strain, with_slopes);
    const auto put = [&](const Eigen::Matrix3Xd& of_energy, Stress& stress) {
      const Eigen::RowVectorXd mean = of_energy.colwise().mean();
      stress.first.col(i) = by_first * (of_energy.row(0) - mean).transpose();
      stress.third.col(i) = by_third * (of_energy.row(2) - mean).transpose();
    };
    put(kirchhoff.values, out.values);
    for (std::size_t k = 0; k < out.slopes.size(); ++k) {
      put(kirchhoff.shape_slopes[k], out.slopes[k]);
    }
  }
  return out;
}

double StretchCourse::nominal(std::size_t step, double first, double third) const {
  const Eigen::Vector3d direction = strain_direction(deformation_);
  const double e = log_stretch_[step];
  return std::exp(direction[0] * e) * first -
         std::exp((2.0 * direction[2] - direction[0]) * e) * third;
}

Eigen::MatrixXd StretchCourse::instantaneous(const Stress& stress) const {
  Eigen::MatrixXd out(size(), stress.first.rows());
  for (Eigen::Index i = 0; i < size(); ++i) {
    const std::size_t step = at_[static_cast<std::size_t>(i)];
    const auto at = static_cast<Eigen::Index>(step);
    for (Eigen::Index j = 0; j < out.cols(); ++j) {
      out(i, j) = nominal(step, stress.first(j, at), stress.third(j, at));
    }
  }
  return out;
}

StretchCourse::Relaxed StretchCourse::relaxed(const Stress& stress, double tau_s,
                                              bool with_slope) const {
  const Eigen::Index n = stress.first.rows();
  Relaxed out{Eigen::MatrixXd(size(), n), Eigen::MatrixXd(with_slope ? size() : 0, n)};
  // Columns: H_1, H_3. Rows: the columns of the model.
  Eigen::MatrixX2d h = Eigen::MatrixX2d::Zero(n, 2), slope = h, old = h, change = h;
  BranchStep weights;
  double last_dt_s = -1.0;
  Eigen::Index point = 0;
  for (std::size_t step = 0; step < log_stretch_.size(); ++step) {
    const auto at = static_cast<Eigen::Index>(step);
    if (dt_s_[step] != last_dt_s) weights = BranchStep(dt_s_[step], tau_s, with_slope);
    last_dt_s = dt_s_[step];
    change.col(0) = stress.first.col(at) - old.col(0);
    change.col(1) = stress.third.col(at) - old.col(1);
    if (with_slope) {
      slope = weights.decay * slope + weights.x * weights.decay * h + weights.gain_slope * change;
    }
    h = weights.decay * h + weights.gain * change;
    old += change;
    if (step != at_[static_cast<std::size_t>(point)]) continue;
    for (Eigen::Index j = 0; j < n; ++j) {
      out.values(point, j) = nominal(step, h(j, 0), h(j, 1));
      if (with_slope) out.by_ln_tau(point, j) = nominal(step, slope(j, 0), slope(j, 1));
    }
    ++point;
  }
  return out;
}

std::vector<double> nominal_stress_Pa(const HyperelasticLaw& law,
                                      const std::vector<RubberTerm>& terms, Deformation deformation,
                                      const Course& history) {
  validate(law);
  validate(terms);
  const StretchCourse course(deformation, history);
  const auto stress = course.unit_stress(law.form, law.shapes, false).values.times(law.moduli_Pa);
  const Eigen::MatrixXd at_once = course.instantaneous(stress);
  Eigen::VectorXd sum = at_once.col(0);
  for (const RubberTerm& term : terms) {
    sum += term.g * (course.relaxed(stress, term.tau_s, false).values - at_once).col(0);
  }
  return {sum.begin(), sum.end()};
}

}  // namespace viscard
