#include "models/array/inverse/choose_weight.h"

#include "models/array/inverse/stencil_sums.h"
#include "models/maths/golden_section.h"
#include "models/maths/require.h"
#include "models/maths/wide_loops.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kChoicePitches = 4.01;  // radius of the patches that the weight is chosen on
constexpr std::size_t kMostKinds = 24;   // of surroundings that take part
constexpr double kLeastWeight = 1e-14;
// Beyond these, single readings are below the noise: a load of nothing would have an interval of no width, and slopes
// smooth over farther than patches reach.
constexpr double kMostOfSize = 1.0, kMostOfSlope = 0.25;

// Sums over the readings of the chosen surroundings at a weight; r is what the estimate leaves of v.
struct Misfit {
  double v_r_V2 = 0.0, r_r_V2 = 0.0;
  double freedom = 0.0;   // trace of 1 - A
  double of_noise = 0.0;  // trace of (1 - A)^T (1 - A)
};

class WeightData {
 public:
  WeightData(OffsetKernels& kernels, Penalty penalty, const ExampleFrames& frames)
      : array_(&kernels.array()),
        patches_(kernels.array(), kernels.pitch_m(), kChoicePitches * kernels.pitch_m()),
        frames_(&frames) {
    for (const std::size_t kind : patches_.commonest()) {
      if (kinds_.size() == kMostKinds) break;
      kinds_.push_back(kind);
      equations_.emplace_back(kernels, patches_.around(patches_.example(kind)), penalty);
    }
    is_chosen_.assign(patches_.kinds(), false);
    for (const std::size_t kind : kinds_) is_chosen_[kind] = true;
    each_reading([&](double v_V, double) {
      v_v_V2_ += v_V * v_V;
      ++values_;
    });
    for (const std::uint32_t from : patches_.around(patches_.example(kinds_.front()))) {
      const Eigen::MatrixXd* kernel = kernels.between(from, patches_.example(kinds_.front()));
      if (kernel == nullptr) continue;
      disturbed_V2_Pa2_ += kernel->rightCols(kernel->cols() - array_->loads).squaredNorm() /
                           static_cast<double>(array_->readings);
    }
  }

  double values() const { return static_cast<double>(values_); }  // readings of all frames
  double mean_square_V2() const { return v_v_V2_ / std::max(values(), 1.0); }
  double disturbed_V2_Pa2() const { return disturbed_V2_Pa2_; }

  Misfit at(double weight) {
    std::vector<Eigen::MatrixXd> of_kind(patches_.kinds());
    Misfit misfit;
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      Eigen::MatrixXd& A = of_kind[kinds_[k]];
      A = equations_[k].explained(weight);
      const double pillars = static_cast<double>(patches_.count(kinds_[k]));
      for (Eigen::Index r = 0; r < array_->readings; ++r) {
        if (!array_->does_work(patches_.example(kinds_[k]), r)) continue;
        const double counts = pillars * static_cast<double>(frames_->count);
        misfit.freedom += counts * (1.0 - A(r, r));
        misfit.of_noise += counts * (1.0 - 2.0 * A(r, r) + A.row(r).squaredNorm());
      }
    }
    const StencilSums sums(patches_, array_->readings, array_->readings, of_kind, 1e-10);
    explained_ = &sums;
    each_reading([&](double v_V, double r_V) {
      misfit.v_r_V2 += v_V * r_V;
      misfit.r_r_V2 += r_V * r_V;
    });
    explained_ = nullptr;
    return misfit;
  }

 private:
  // visit(v, r) for the working readings of the chosen surroundings; r = v before any estimate.
  template <typename Visit>
  void each_reading(const Visit& visit) const {
    const auto readings = static_cast<std::size_t>(array_->readings);
    for (std::size_t block = 0; block < frames_->lanes.size(); ++block) {
      const std::vector<double>& v_V = frames_->lanes[block];
      std::vector<double> seen_V(v_V.size(), 0.0);
      if (explained_ != nullptr) explained_->apply(v_V.data(), seen_V.data());
      const std::size_t frames = std::min(kLanes, frames_->count - block * kLanes);
      for (std::size_t i = 0; i < patches_.pillars(); ++i) {
        if (!is_chosen_[patches_.kind_of(i)]) continue;
        for (std::size_t r = 0; r < readings; ++r) {
          if (!array_->does_work(i, static_cast<Eigen::Index>(r))) continue;
          const std::size_t at = (i * readings + r) * kLanes;
          for (std::size_t f = 0; f < frames; ++f) visit(v_V[at + f], v_V[at + f] - seen_V[at + f]);
        }
      }
    }
  }

  const ReadArray* array_;
  PillarPatches patches_;
  const ExampleFrames* frames_;
  std::vector<std::size_t> kinds_;
  std::vector<PatchEquations> equations_;
  std::vector<bool> is_chosen_;
  const StencilSums* explained_ = nullptr;
  std::size_t values_ = 0;
  double v_v_V2_ = 0.0, disturbed_V2_Pa2_ = 0.0;
};

// The weight at which v.r, the least of the whole functional, is what the noise leaves of it (eq. I4). It grows with
// the weight, about in proportion: false position for the logarithms, with Illinois' halving.
double weight_by_discrepancy(WeightData& data, double total_V2, double most, bool& is_at_limit) {
  constexpr double kEnough = 1e-3;
  constexpr int kMostSteps = 40;
  const auto excess = [&](double log_weight) {
    const double left_V2 = std::max(data.at(std::exp(log_weight)).v_r_V2, 1e-300);
    return std::log(left_V2 / (data.values() * total_V2));
  };
  double low = std::log(kLeastWeight), high = std::log(most);
  double at_low = excess(low), at_high = excess(high);
  is_at_limit = at_low >= 0.0 || at_high <= 0.0;
  if (at_high <= 0.0) return most;
  if (at_low >= 0.0) return kLeastWeight;
  int side = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    const double middle = low - at_low * (high - low) / (at_high - at_low);
    const double value = excess(middle);
    if (std::abs(value) < kEnough || high - low < kEnough) return std::exp(middle);
    if (value < 0.0) {
      low = middle;
      at_low = value;
      if (side == -1) at_high *= 0.5;
      side = -1;
    } else {
      high = middle;
      at_high = value;
      if (side == 1) at_low *= 0.5;
      side = 1;
    }
  }
  return std::exp(0.5 * (low + high));
}

// Golub, Heath & Wahba, Technometrics 21 (1979) 215 (eq. I5).
double weight_by_cross_validation(WeightData& data, double most, bool& is_at_limit) {
  constexpr double kLeast = 1e-8, kStep = 2.0;  // of logarithms
  const auto score = [&](double log_weight) {
    const Misfit misfit = data.at(std::exp(log_weight));
    return misfit.r_r_V2 * data.values() / (misfit.freedom * misfit.freedom);
  };
  const double first = std::log(kLeast), last = std::log(most);
  double best = last, least = score(last);
  for (double at = last - kStep; at > first; at -= kStep) {
    const double value = score(at);
    if (value < least) {
      least = value;
      best = at;
    }
  }
  is_at_limit = best == last || best - kStep <= first;
  return std::exp(
      golden_section(score, std::max(best - kStep, first), std::min(best + kStep, last), 0.1)
          .middle());
}

}  // namespace

Regularisation choose_weight(OffsetKernels& kernels, const ReadingErrors& errors,
                             const ReadingChoice& choice, const ExampleFrames& frames) {
  const ReadArray& array = kernels.array();
  require(!errors.noise_V || *errors.noise_V > 0.0, "the noise of a reading must be positive");
  Regularisation found;
  found.penalty = choice.penalty.value_or(errors.noise_V ? Penalty::kSize : Penalty::kSlope);
  const bool is_blind = found.penalty == Penalty::kSize && array.readings == array.loads;
  if (!errors.noise_V && is_blind) {
    throw std::runtime_error(
        "voltages alone do not tell noise from loads whose sizes are penalised; state the noise, "
        "or penalise slopes");
  }
  WeightData data(kernels, found.penalty, frames);
  if (!errors.noise_V && data.mean_square_V2() == 0.0) {
    throw std::runtime_error("the frames hold no voltage to find the noise from; state the noise");
  }
  const double more_V2 = errors.gain_spread * errors.gain_spread * data.mean_square_V2() +
                         errors.disturbing_Pa * errors.disturbing_Pa * data.disturbed_V2_Pa2();
  double total_V2 = errors.noise_V ? *errors.noise_V * *errors.noise_V + more_V2 : 0.0;
  const double most = found.penalty == Penalty::kSize ? kMostOfSize : kMostOfSlope;
  if (choice.weight) {
    found.rule = WeightRule::kStated;
    found.weight = *choice.weight;
  } else if (errors.noise_V) {
    found.rule = WeightRule::kDiscrepancy;
    found.weight = total_V2 > 0.0 && data.mean_square_V2() > 0.0
                       ? weight_by_discrepancy(data, total_V2, most, found.is_at_limit)
                       : (total_V2 > 0.0 ? most : kLeastWeight);
  } else {
    found.rule = WeightRule::kCrossValidation;
    found.weight = weight_by_cross_validation(data, most, found.is_at_limit);
  }
  if (!errors.noise_V) {
    const Misfit misfit = data.at(found.weight);
    // At the limit loads are smoother than the penalty says: what it takes away is noise alone.
    total_V2 = misfit.r_r_V2 / (found.is_at_limit ? misfit.of_noise : misfit.freedom);
  }
  found.noise_V = errors.noise_V ? *errors.noise_V : std::sqrt(std::max(0.0, total_V2 - more_V2));
  found.total_V = std::sqrt(total_V2);
  found.prior_Pa = std::sqrt(total_V2 / (found.weight * kernels.scale_V2_Pa2()));
  return found;
}

}  // namespace viscard
