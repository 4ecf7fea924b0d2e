#include "fit/large_strain/large_strain_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

std::shared_ptr<const std::vector<StretchCourse>> courses_of(
    const std::vector<LargeStrainTest>& tests) {
  std::vector<StretchCourse> courses;
  for (const LargeStrainTest& test : tests) {
    courses.emplace_back(test.deformation, history_of(test));
  }
  return std::make_shared<const std::vector<StretchCourse>>(std::move(courses));
}

// The shortest step, but not above `least` (0: none yet).
double least_step(const std::vector<double>& time_s, double least) {
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double step = time_s[i] - time_s[i - 1];
    if (step > 0.0 && (least == 0.0 || step < least)) least = step;
  }
  return least;
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
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const LargeStrainTest& test = tests[t];
    const double least = kLeastShare * largest_stress(test.nominal_stress_Pa) / scale_Pa_;
    for (std::size_t i = 0; i < test.stretch.size(); ++i) {
      const double stress = test.nominal_stress_Pa[i] / scale_Pa_;
      const bool is_relative = options.weight == StressWeight::kRelative;
      const double weight = is_relative ? 1.0 / std::max(std::abs(stress), least) : 1.0;
      readings_.push_back(
          {test.deformation, test.stretch[i], weight, weight * stress, t, test.before.size() + i});
      largest_excess_ = std::max(largest_excess_, excess_at(test.deformation, test.stretch[i]));
    }
  }
  if (std::all_of(tests.begin(), tests.end(), has_times)) {
    courses_ = courses_of(tests);
    for (const LargeStrainTest& test : tests) {
      longest_test_s_ = std::max(longest_test_s_, test.time_s.back() - test.time_s.front());
      least_step_s_ = least_step(test.time_s, least_step_s_);
    }
  }
  if (options.modulus) {
    modulus_ = options.modulus->value_Pa / scale_Pa_;
    modulus_se_ = options.modulus->se_Pa / scale_Pa_;
    is_long_term_ = options.modulus->is_long_term;
    set_scatter(std::numeric_limits<double>::infinity());
  }
  fill_data();
}

void LargeStrainRows::set_scatter(double scatter) {
  // An exact value weighs this much more than all readings together, which may move it by the inverse
  // square. With terms a larger weight leaves their search on a narrow ridge; it holds to 1e-6.
  known_weight_ =
      modulus_se_ > 0.0 ? scatter / modulus_se_ : std::numeric_limits<double>::infinity();
  limit_known_modulus(courses_ ? kExactWithTerms : kExact);
}

void LargeStrainRows::limit_known_modulus(double share) {
  if (!(modulus_ > 0.0)) return;
  const double most = share * std::sqrt(static_cast<double>(readings_.size())) / modulus_;
  modulus_weight_ = std::min(known_weight_, most);
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
  if (!terms_.empty()) return relaxed_columns(form, shapes, with_slopes);
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
  add_modulus_row(form, shapes, out);
  return out;
}

void LargeStrainRows::add_modulus_row(HyperelasticForm form, const Eigen::VectorXd& shapes,
                                      Columns& out) const {
  if (data_.size() == n_readings()) return;
  const Eigen::Index last = n_readings();
  const double weight = modulus_weight_ * modulus_share();
  out.values.row(last) = weight * youngs_columns(form, shapes).transpose();
  for (std::size_t j = 0; j < out.slopes.size(); ++j) {
    const auto k = static_cast<Eigen::Index>(j);
    const double step = 1e-6 * std::max(1.0, std::abs(shapes[k]));
    Eigen::VectorXd up = shapes, down = shapes;
    up[k] += step;
    down[k] -= step;
    out.slopes[j].row(last) =
        weight / (2.0 * step) * (youngs_columns(form, up) - youngs_columns(form, down)).transpose();
  }
}

double LargeStrainRows::modulus_share() const {
  double share = 1.0;
  if (is_long_term_) {
    for (const RubberTerm& term : terms_) share -= term.g;
  }
  return share;
}

LargeStrainRows::Columns LargeStrainRows::relaxed_columns(HyperelasticForm form,
                                                          const Eigen::VectorXd& shapes,
                                                          bool with_slopes) const {
  // All points of each test: the moduli, then the slopes by each shape.
  std::vector<std::vector<Eigen::MatrixXd>> of_tests;
  for (const StretchCourse& course : *courses_) {
    const auto unit = course.unit_stress(form, shapes, with_slopes);
    std::vector<Eigen::MatrixXd> all;
    for (std::size_t k = 0; k <= unit.slopes.size(); ++k) {
      const StretchCourse::Stress& stress = k == 0 ? unit.values : unit.slopes[k - 1];
      const Eigen::MatrixXd at_once = course.instantaneous(stress);
      all.push_back(at_once);
      for (const RubberTerm& term : terms_) {
        all.back() += term.g * (course.relaxed(stress, term.tau_s, false).values - at_once);
      }
    }
    of_tests.push_back(std::move(all));
  }
  const Eigen::MatrixXd blank = Eigen::MatrixXd::Zero(data_.size(), viscard::n_moduli(form));
  Columns out{blank, std::vector<Eigen::MatrixXd>(of_tests.front().size() - 1, blank)};
  for (Eigen::Index i = 0; i < n_readings(); ++i) {
    const Reading& at = readings_[static_cast<std::size_t>(i)];
    const auto& all = of_tests[at.test];
    const auto point = static_cast<Eigen::Index>(at.point);
    out.values.row(i) = at.weight * all[0].row(point);
    for (std::size_t k = 0; k < out.slopes.size(); ++k) {
      out.slopes[k].row(i) = at.weight * all[k + 1].row(point);
    }
  }
  add_modulus_row(form, shapes, out);
  return out;
}

LargeStrainRows::Parts LargeStrainRows::parts(const HyperelasticLaw& law,
                                              const std::vector<double>& tau_s,
                                              bool with_slopes) const {
  const auto n = static_cast<Eigen::Index>(tau_s.size());
  std::vector<Parts> of_tests;
  for (const StretchCourse& course : *courses_) {
    const auto stress = course.unit_stress(law.form, law.shapes, false).values.times(law.moduli_Pa);
    Parts one{course.instantaneous(stress), Eigen::MatrixXd(course.size(), n),
              Eigen::MatrixXd(with_slopes ? course.size() : 0, n)};
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto part = course.relaxed(stress, tau_s[static_cast<std::size_t>(k)], with_slopes);
      one.relaxed.col(k) = part.values.col(0);
      if (with_slopes) one.by_ln_tau.col(k) = part.by_ln_tau.col(0);
    }
    of_tests.push_back(std::move(one));
  }
  Parts out{Eigen::VectorXd(data_.size()), Eigen::MatrixXd::Zero(data_.size(), n),
            Eigen::MatrixXd::Zero(data_.size(), n)};
  for (Eigen::Index i = 0; i < n_readings(); ++i) {
    const Reading& at = readings_[static_cast<std::size_t>(i)];
    const Parts& one = of_tests[at.test];
    const auto point = static_cast<Eigen::Index>(at.point);
    out.at_once[i] = at.weight * one.at_once[point];
    out.relaxed.row(i) = at.weight * one.relaxed.row(point);
    if (with_slopes) out.by_ln_tau.row(i) = at.weight * one.by_ln_tau.row(point);
  }
  if (data_.size() == n_readings()) return out;
  // The modulus at rest at once, and what is left of it after all relaxation.
  const double modulus = modulus_weight_ * youngs_modulus_Pa(law);
  out.at_once[n_readings()] = modulus;
  out.relaxed.row(n_readings()).setConstant(is_long_term_ ? 0.0 : modulus);
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
