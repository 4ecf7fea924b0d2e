#include "fit/intervals/slow_noise.h"

#include "models/maths/distributions.h"
#include "models/maths/interval.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Variance factor of the means of `length` or more consecutive samples; rows are never divided.
struct BatchMeans {
  double inflation = 1.0;
  double freedom = 0.0;
};

BatchMeans batch_means(const Eigen::VectorXd& residual, const std::vector<std::size_t>& begins,
                       double length, double n_parameters, double variance) {
  double square = 0.0, n_batches = 0.0, sum = 0.0, count = 0.0;
  for (Index row = 0; row < residual.size(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    const auto n = static_cast<double>(begins[at + 1] - begins[at]);
    sum += std::sqrt(n) * residual[row];
    count += n;
    if (count < length) continue;
    square += sum * sum / count;
    n_batches += 1.0;
    sum = count = 0.0;
  }
  BatchMeans means;
  // The fit has removed part of such slow noise from its residual.
  means.freedom = n_batches - std::min(n_parameters, 0.5 * n_batches);
  if (means.freedom >= 2.0 && variance > 0.0) {
    means.inflation = square / (means.freedom * variance);
  }
  return means;
}

// Upper limit of chi-square over its degrees of freedom at 3.5 standard deviations (Wilson & Hilferty,
// Proc. Natl. Acad. Sci. 17 (1931) 684).
double largest_by_chance(double freedom) {
  constexpr double kDeviations = 3.5;
  const double share = 2.0 / (9.0 * freedom);
  return std::pow(1.0 - share + kDeviations * std::sqrt(share), 3);
}

}  // namespace

std::string memory_text(double memory, double independent) {
  const std::string of_noise = "the noise of the record has a memory ";
  if (memory > 1.0 || independent < 1.0) {
    return of_noise + "longer than the record, so that not even one value is independent";
  }
  return of_noise + "of " + text_of(100.0 * memory, 2) + " % of it, or " + text_of(independent, 2) +
         " independent values";
}

SlowNoise slow_noise(const SpectralModel& model, const SpectralState& state, double variance,
                     const Autoregression& noise) {
  // A fit removes part of slow noise, so that the memory of the residual is shorter than that of the
  // noise: 8 % for a tenth.
  constexpr double kLongMemory = 0.08, kFewIndependent = 50.0, kLeastFreedom = 4.0;
  const Eigen::VectorXd residual = model.data() - model.fitted(state);
  const std::vector<std::size_t> begins = model.row_begins();
  const double n_samples = model.n_samples();
  const auto n_parameters =
      static_cast<double>(model.n_common() + 2 * state.n_terms() + model.n_nuisances());
  const double inflation = noise.inflation();
  SlowNoise slow;
  const double independent = n_samples / inflation;
  const double freedom = std::max(kLeastFreedom, independent - n_parameters);
  // The variance counts one sample for each parameter already.
  const double counted = std::max(1.0, n_samples - n_parameters) / n_samples;
  slow.widening = std::max(1.0, counted * independent / freedom) *
                  std::pow(student_t_975(freedom) / kNormal95, 2);
  const double memory = noise.memory() / n_samples;
  constexpr double kSlow = 5.0;  // less is not slow, and few values may be independent
  if (inflation > kSlow && (memory >= kLongMemory || independent < kFewIndependent)) {
    slow.doubt = memory_text(memory, independent);
  }
  double most = 1.0;
  for (const double parts : {40.0, 20.0, 10.0}) {
    const BatchMeans means =
        batch_means(residual, begins, n_samples / parts, n_parameters, variance);
    if (means.freedom < 2.0) continue;
    most = std::max(most, means.inflation);
    const bool is_more = means.inflation > inflation * largest_by_chance(means.freedom);
    if (is_more && slow.doubt.empty()) {
      slow.doubt = "means over a " +
                   std::string(parts == 40.0   ? "fortieth"
                               : parts == 20.0 ? "twentieth"
                                               : "tenth") +
                   " of the record scatter " + text_of(means.inflation / inflation, 2) +
                   " times as much (variance) as the autocorrelation of the residual implies";
    }
  }
  if (slow.doubt.empty()) return slow;
  slow.batch_inflation = most;
  slow.doubt +=
      ": the record is short for such noise. Intervals are widened to what means of a fortieth to "
      "a tenth of it imply, and are rough";
  return slow;
}

Eigen::MatrixXd widened(const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& white,
                        const SlowNoise& slow) {
  Eigen::MatrixXd wide = slow.widening * covariance;
  if (slow.doubt.empty()) return wide;
  for (Index j = 0; j < wide.rows(); ++j) {  // correlations stay
    const double least = slow.batch_inflation * white(j, j);
    if (!std::isfinite(least) || !(wide(j, j) > 0.0) || wide(j, j) >= least) continue;
    const double factor = std::sqrt(least / wide(j, j));
    wide.row(j) *= factor;
    wide.col(j) *= factor;
  }
  return wide;
}

}  // namespace viscard
