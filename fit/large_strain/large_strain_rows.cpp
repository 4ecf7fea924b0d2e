#include "fit/large_strain/large_strain_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

double largest_stress(const std::vector<double>& stress_Pa) {
  double largest = 0.0;
  for (const double value : stress_Pa) largest = std::max(largest, std::abs(value));
  return largest;
}

double excess_at(Deformation deformation, double stretch) {
  const Eigen::Vector3d direction = strain_direction(deformation);
  double sum = 0.0;
  for (const double d : direction) sum += std::expm1(2.0 * d * std::log(stretch));
  return sum;
}

}  // namespace

LargeStrainRows::LargeStrainRows(const std::vector<LargeStrainTest>& tests,
                                 const LargeStrainOptions& options) {
  double scale_Pa = 0.0;
  for (const LargeStrainTest& test : tests) {
    scale_Pa = std::max(scale_Pa, largest_stress(test.nominal_stress_Pa));
  }
  scale_Pa_ = scale_Pa > 0.0 ? scale_Pa : 1.0;
  constexpr double kLeastShare = 0.01;
  for (const LargeStrainTest& test : tests) {
    const double least = kLeastShare * largest_stress(test.nominal_stress_Pa) / scale_Pa_;
    for (std::size_t i = 0; i < test.stretch.size(); ++i) {
      const double stress = test.nominal_stress_Pa[i] / scale_Pa_;
      const bool is_relative = options.weight == StressWeight::kRelative;
      const double weight = is_relative ? 1.0 / std::max(std::abs(stress), least) : 1.0;
      readings_.push_back({test.deformation, test.stretch[i], weight, weight * stress});
      largest_excess_ = std::max(largest_excess_, excess_at(test.deformation, test.stretch[i]));
    }
  }
  if (options.modulus) {
    modulus_ = options.modulus->value_Pa / scale_Pa_;
    modulus_se_ = options.modulus->se_Pa / scale_Pa_;
    set_scatter(std::numeric_limits<double>::infinity());
  }
  fill_data();
}

void LargeStrainRows::set_scatter(double scatter) {
  // An exact value weighs a million times as much as all readings together.
  constexpr double kExact = 1e6;
  const double exact = kExact * std::sqrt(static_cast<double>(readings_.size())) / modulus_;
  modulus_weight_ = modulus_se_ > 0.0 ? std::min(scatter / modulus_se_, exact) : exact;
  fill_data();
}

void LargeStrainRows::fill_data() {
  const bool is_known = modulus_weight_ > 0.0;
  data_.resize(n_readings() + (is_known ? 1 : 0));
  for (Eigen::Index i = 0; i < n_readings(); ++i) {
    data_[i] = readings_[static_cast<std::size_t>(i)].value;
  }
  if (is_known) data_[n_readings()] = modulus_weight_ * modulus_;
}

LargeStrainRows::Columns LargeStrainRows::columns(HyperelasticForm form,
                                                  const Eigen::VectorXd& shapes,
                                                  bool with_slopes) const {
  Columns out{Eigen::MatrixXd(data_.size(), viscard::n_moduli(form)), {}};
  const Eigen::Index n_slopes = with_slopes ? viscard::n_shapes(form) : 0;
  out.slopes.assign(static_cast<std::size_t>(n_slopes),
                    Eigen::MatrixXd::Zero(data_.size(), viscard::n_moduli(form)));
  for (Eigen::Index i = 0; i < n_readings(); ++i) {
    const Reading& at = readings_[static_cast<std::size_t>(i)];
    const StressColumns unit = stress_columns(form, shapes, at.deformation, at.stretch);
    out.values.row(i) = at.weight * unit.values.transpose();
    for (Eigen::Index k = 0; k < n_slopes; ++k) {
      out.slopes[static_cast<std::size_t>(k)].row(i) =
          at.weight * unit.shape_slopes.col(k).transpose();
    }
  }
  if (data_.size() == n_readings()) return out;
  const Eigen::Index last = n_readings();
  out.values.row(last) = modulus_weight_ * youngs_columns(form, shapes).transpose();
  for (Eigen::Index k = 0; k < n_slopes; ++k) {
    const double step = 1e-6 * std::max(1.0, std::abs(shapes[k]));
    Eigen::VectorXd up = shapes, down = shapes;
    up[k] += step;
    down[k] -= step;
    out.slopes[static_cast<std::size_t>(k)].row(last) =
        modulus_weight_ / (2.0 * step) *
        (youngs_columns(form, up) - youngs_columns(form, down)).transpose();
  }
  return out;
}

LargeStrainRows LargeStrainRows::thinned(std::size_t most) const {
  if (readings_.size() <= most) return *this;
  LargeStrainRows out = *this;
  out.readings_.clear();
  const double step = static_cast<double>(readings_.size()) / static_cast<double>(most);
  for (std::size_t i = 0; i < most; ++i) {
    out.readings_.push_back(readings_[static_cast<std::size_t>(static_cast<double>(i) * step)]);
  }
  out.fill_data();
  return out;
}

}  // namespace viscard
