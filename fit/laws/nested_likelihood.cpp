#include "fit/laws/nested_likelihood.h"

#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace viscard {
namespace {

// Independent values of one mean, reduced to their weighted mean. The density of the values is that
// of the mean times exp(-minus_twice/2), but for a constant.
struct Pooled {
  double mean = 0.0, variance = 0.0, minus_twice = 0.0;
};

// add: variance to add to that of each member.
template <typename Members>
Pooled pooled(const Members& members, double add) {
  Pooled out;
  double weight = 0.0;
  for (const auto& one : members) {
    const double w = 1.0 / (one.variance + add);
    weight += w;
    out.mean += w * (one.value - members.front().value);
    out.minus_twice -= std::log(w);
  }
  out.mean = members.front().value + out.mean / weight;
  out.variance = 1.0 / weight;
  out.minus_twice += std::log(weight);
  for (const auto& one : members) {
    out.minus_twice += std::pow(one.value - out.mean, 2) / (one.variance + add);
  }
  return out;
}

}  // namespace

NestedLikelihood::NestedLikelihood(const std::vector<NestedRecord>& records, const RatioModel& law,
                                   int degree) {
  std::map<double, std::map<int, Specimen>> by_ratio;
  int n_specimens = 0;
  double mean = 0.0;
  const auto n = static_cast<double>(records.size());
  for (const NestedRecord& one : records) {
    Specimen& specimen = by_ratio[one.ratio][one.specimen];
    if (specimen.empty()) ++n_specimens;
    specimen.push_back({one.value, one.variance});
    mean += one.value / n;
  }
  for (const NestedRecord& one : records) {
    scale_ += (std::pow(one.value - mean, 2) + one.variance) / n;
  }
  scale_ = std::sqrt(scale_);
  design_.resize(static_cast<Eigen::Index>(by_ratio.size()), degree + 1);
  const ScaledVariable scaled = scale_of(law);
  Eigen::Index row = 0;
  for (const auto& [ratio, specimens] : by_ratio) {
    const double x = (variable_of(law.form.variable, ratio) - scaled.middle) / scaled.half;
    for (int power = 0; power <= degree; ++power) design_(row, power) = std::pow(x, power);
    ++row;
    ratios_.emplace_back();
    for (const auto& [number, touches] : specimens) ratios_.back().push_back(touches);
  }
  const int n_ratios = static_cast<int>(ratios_.size());
  degrees_ = {static_cast<int>(records.size()) - n_specimens, n_specimens - n_ratios,
              n_ratios - (degree + 1)};
}

double NestedLikelihood::minus_twice(const Deviations& deviations) const {
  const double touch = deviations[0] * deviations[0], specimen = deviations[1] * deviations[1],
               ratio = deviations[2] * deviations[2];
  double twice = 0.0;
  const Eigen::Index n = design_.rows();
  Eigen::VectorXd means(n), weights(n);
  std::vector<Member> specimens;
  for (Eigen::Index r = 0; r < n; ++r) {
    specimens.clear();
    for (const Specimen& touches : ratios_[static_cast<std::size_t>(r)]) {
      const Pooled one = pooled(touches, touch);
      twice += one.minus_twice;
      specimens.push_back({one.mean, one.variance});
    }
    const Pooled at = pooled(specimens, specimen);
    twice += at.minus_twice + std::log(at.variance + ratio);
    means[r] = at.mean;
    weights[r] = 1.0 / (at.variance + ratio);
  }
  const double origin = means[0];
  means.array() -= origin;  // a constant that the law's own constant absorbs
  const SymmetricFactor normal(design_.transpose() * weights.asDiagonal() * design_);
  const Eigen::VectorXd beta =
      normal.solve(Eigen::VectorXd(design_.transpose() * weights.cwiseProduct(means)));
  const Eigen::VectorXd rest = means - design_ * beta;
  return twice + normal.log_determinant() + rest.cwiseAbs2().dot(weights);
}

}  // namespace viscard
