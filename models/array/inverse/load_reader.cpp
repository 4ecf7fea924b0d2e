#include "models/array/inverse/load_reader.h"

#include "models/array/inverse/patch_estimate.h"
#include "models/array/inverse/stencil_sums.h"
#include "models/maths/require.h"
#include "models/maths/wide_loops.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace viscard {
namespace {

constexpr double kIn95 = 1.959963984540054;  // standard deviations
constexpr int kLeastPitches = 2, kMostPitches = 8;
constexpr double kOverPitch = 0.01;     // a patch ends between two rings of a lattice
constexpr double kSameEstimate = 3e-7;  // relative change of gains with the patch
constexpr double kLeftOut = 1e-7, kLeftOutOfSquares = 1e-3;
constexpr std::size_t kMostExamples = 8;  // frames

// Frames from `first` on as StencilSums takes them.
void gather(const ReadArray& array, const std::vector<std::size_t>& place_of, std::size_t places,
            const double* const* frame, std::size_t frames, std::vector<double>& lanes) {
  const auto readings = static_cast<std::size_t>(array.readings);
  lanes.assign(array.pillars.size() * readings * kLanes, 0.0);
  for (std::size_t i = 0; i < array.pillars.size(); ++i) {
    for (std::size_t r = 0; r < readings; ++r) {
      if (!array.does_work(i, static_cast<Eigen::Index>(r))) continue;
      for (std::size_t f = 0; f < frames; ++f) {
        lanes[(i * readings + r) * kLanes + f] = frame[f][place_of[i] * readings + r];
      }
    }
  }
  require(places > 0, "a frame has places");
}

// How far away a load counts half as much as the own one in an estimate (eq. I6).
double half_width_m(const Eigen::MatrixXd& share, Eigen::Index load,
                    const std::vector<double>& away_m) {
  const double own = std::abs(share(load, 0));
  double before = own, before_m = 0.0;
  for (std::size_t p = 1; p < away_m.size();) {
    double ring = 0.0;
    const double ring_m = away_m[p];
    for (; p < away_m.size() && away_m[p] < ring_m * (1.0 + 1e-6); ++p) {
      ring = std::max(ring, std::abs(share(load, static_cast<Eigen::Index>(p))));
    }
    if (!(ring < own)) return std::numeric_limits<double>::infinity();
    if (ring < 0.5 * own) {
      return before_m + (ring_m - before_m) * (before - 0.5 * own) / (before - ring);
    }
    before = ring;
    before_m = ring_m;
  }
  return away_m.size() > 1 ? std::numeric_limits<double>::infinity() : 0.0;
}

}  // namespace

struct LoadReader::Parts {
  ReadArray array;
  std::vector<std::size_t> place_of;
  std::size_t places = 0;
  ReadingErrors errors;
  Regularisation regularisation;
  double pitch_m = 0.0, condition = 1.0;
  std::unique_ptr<const PillarPatches> patches;
  std::optional<StencilSums> estimate, spread;  // of voltages, and of their squares
  std::vector<double>
      fixed_Pa2;  // by pillar, then load: the part of a variance that no frame changes
  std::vector<double> own_share, resolution_m;

  void prepare(OffsetKernels& kernels);
  void settle_patches(OffsetKernels& kernels);
};

// Widens the patches until the estimates change no more; what is left counts as an error of the kernel.
void LoadReader::Parts::settle_patches(OffsetKernels& kernels) {
  constexpr std::size_t kMostTried = 4;
  const auto patches_of = [&](int pitches) {
    return std::make_unique<const PillarPatches>(array, pitch_m, (pitches + kOverPitch) * pitch_m);
  };
  patches = patches_of(kLeastPitches);
  std::vector<std::size_t>
      tried;  // commonest surroundings, and pillars without a reading of their own
  for (const std::size_t kind : patches->commonest()) {
    const std::size_t pillar = patches->example(kind);
    bool is_read = false;
    for (Eigen::Index r = 0; r < array.readings; ++r) is_read |= array.does_work(pillar, r);
    const bool is_common = tried.size() < kMostTried / 2;
    if (is_common || !is_read) tried.push_back(pillar);
    if (tried.size() == kMostTried) break;
  }
  double change = 0.0;
  for (int pitches = kLeastPitches; pitches < kMostPitches; ++pitches) {
    auto wider = patches_of(pitches + 1);
    change = 0.0;
    for (const std::size_t pillar : tried) {
      const auto estimate_on = [&](const PillarPatches& on) {
        return PatchEquations(kernels, on.around(pillar), regularisation.penalty)
            .estimate(regularisation.weight)
            .gain_Pa_V;
      };
      const Eigen::MatrixXd narrow = estimate_on(*patches);
      Eigen::MatrixXd wide = estimate_on(*wider);
      const double size = std::max(wide.cwiseAbs().sum(), std::numeric_limits<double>::min());
      wide.leftCols(narrow.cols()) -= narrow;
      change = std::max(change, wide.cwiseAbs().sum() / size);
    }
    if (change <= kSameEstimate) return;
    patches = std::move(wider);
  }
  errors.other_model += change;
}

void LoadReader::Parts::prepare(OffsetKernels& kernels) {
  settle_patches(kernels);
  const auto loads = static_cast<std::size_t>(array.loads);
  std::vector<Eigen::MatrixXd> gains, squares;
  std::vector<double> fixed, share, resolution;  // by kind, then load
  const double noise_V2 = regularisation.noise_V * regularisation.noise_V;
  const double total_V2 = regularisation.total_V * regularisation.total_V;
  const double disturbing_Pa2 = errors.disturbing_Pa * errors.disturbing_Pa;
  for (std::size_t kind = 0; kind < patches->kinds(); ++kind) {
    const auto around = patches->around(patches->example(kind));
    const PatchEquations equations(kernels, around, regularisation.penalty);
    const PillarEstimate one = equations.estimate(regularisation.weight);
    if (kind == patches->commonest().front()) condition = equations.condition();
    const SourcePoint& own = array.pillars[around[0]];
    std::vector<double> away_m;
    for (const std::uint32_t other : around) {
      away_m.push_back(
          std::hypot(array.pillars[other].x_m - own.x_m, array.pillars[other].y_m - own.y_m));
    }
    for (Eigen::Index l = 0; l < array.loads; ++l) {
      fixed.push_back(noise_V2 * one.noise_Pa2_V2[l] + total_V2 * one.bias_Pa2_V2[l] +
                      disturbing_Pa2 * one.disturbed_Pa2_Pa2[l]);
      share.push_back(one.share(l, 0));
      resolution.push_back(half_width_m(one.share, l, away_m));
    }
    squares.push_back(one.gain_Pa_V.cwiseAbs2());
    gains.push_back(one.gain_Pa_V);
  }
  estimate.emplace(*patches, array.readings, array.loads, gains, kLeftOut);
  if (errors.gain_spread > 0.0) {
    spread.emplace(*patches, array.readings, array.loads, squares, kLeftOutOfSquares);
  }
  for (std::size_t i = 0; i < array.pillars.size(); ++i) {
    for (std::size_t l = 0; l < loads; ++l) {
      const std::size_t at = patches->kind_of(i) * loads + l;
      fixed_Pa2.push_back(fixed[at]);
      own_share.push_back(share[at]);
      resolution_m.push_back(resolution[at]);
    }
  }
}

LoadReader::LoadReader(ReadArray array, std::vector<std::size_t> place_of, std::size_t places,
                       const ReadingErrors& errors, const ReadingChoice& choice,
                       const VoltageFrames& examples)
    : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  parts.array = std::move(array);
  parts.place_of = std::move(place_of);
  parts.places = places;
  parts.errors = errors;
  require(parts.place_of.size() == parts.array.pillars.size(), "each pillar has a place");
  require(examples.count > 0, "at least one frame of voltages is needed");
  OffsetKernels kernels(parts.array);
  parts.pitch_m = kernels.pitch_m();
  ExampleFrames frames;
  frames.count = std::min(examples.count, kMostExamples);
  const std::size_t length = places * static_cast<std::size_t>(parts.array.readings);
  for (std::size_t first = 0; first < frames.count; first += kLanes) {
    const double* frame[kLanes] = {};
    const std::size_t lanes = std::min(kLanes, frames.count - first);
    for (std::size_t f = 0; f < lanes; ++f) {  // evenly over all
      frame[f] = examples.voltages_V + (first + f) * examples.count / frames.count * length;
    }
    gather(parts.array, parts.place_of, places, frame, lanes, frames.lanes.emplace_back());
  }
  parts.regularisation = choose_weight(kernels, errors, choice, frames);
  parts.prepare(kernels);
}

LoadReader::LoadReader(LoadReader&&) noexcept = default;
LoadReader& LoadReader::operator=(LoadReader&&) noexcept = default;
LoadReader::~LoadReader() = default;

void LoadReader::read(const VoltageFrames& frames, double* loads_Pa, double* half_widths_Pa) const {
  const Parts& parts = *parts_;
  const auto readings = static_cast<std::size_t>(parts.array.readings);
  const auto loads = static_cast<std::size_t>(parts.array.loads);
  const std::size_t values = parts.array.pillars.size() * loads;
  const std::size_t in_frame = parts.places * readings, out_frame = parts.places * loads;
  std::fill(loads_Pa, loads_Pa + frames.count * out_frame,
            std::numeric_limits<double>::quiet_NaN());
  std::fill(half_widths_Pa, half_widths_Pa + frames.count * out_frame,
            std::numeric_limits<double>::quiet_NaN());
  std::vector<double> voltages_V, load_Pa(values * kLanes), spread_Pa2(values * kLanes, 0.0);
  const double spread2 = parts.errors.gain_spread * parts.errors.gain_spread;
  for (std::size_t first = 0; first < frames.count; first += kLanes) {
    const std::size_t lanes = std::min(kLanes, frames.count - first);
    const double* frame[kLanes] = {};
    for (std::size_t f = 0; f < lanes; ++f) frame[f] = frames.voltages_V + (first + f) * in_frame;
    gather(parts.array, parts.place_of, parts.places, frame, lanes, voltages_V);
    parts.estimate->apply(voltages_V.data(), load_Pa.data());
    if (parts.spread) {
      for (double& one_V : voltages_V) one_V *= one_V;
      parts.spread->apply(voltages_V.data(), spread_Pa2.data());
    }
    double largest_Pa[kLanes] = {};
    for (std::size_t at = 0; at < values; ++at) {
      for (std::size_t f = 0; f < kLanes; ++f) {
        largest_Pa[f] = std::max(largest_Pa[f], std::abs(load_Pa[at * kLanes + f]));
      }
    }
    for (std::size_t i = 0; i < parts.array.pillars.size(); ++i) {
      const double of_largest =
          parts.errors.other_model +
          (parts.errors.pillar_model.empty() ? 0.0 : parts.errors.pillar_model[i]);
      for (std::size_t l = 0; l < loads; ++l) {
        const std::size_t at = i * loads + l, out = parts.place_of[i] * loads + l;
        for (std::size_t f = 0; f < lanes; ++f) {
          const double found_Pa = load_Pa[at * kLanes + f];
          const double variance_Pa2 = parts.fixed_Pa2[at] + spread2 * spread_Pa2[at * kLanes + f];
          loads_Pa[(first + f) * out_frame + out] = found_Pa;
          half_widths_Pa[(first + f) * out_frame + out] =
              kIn95 * std::sqrt(variance_Pa2) + parts.errors.own_model * std::abs(found_Pa) +
              of_largest * largest_Pa[f];
        }
      }
    }
  }
}

const ReadArray& LoadReader::array() const {
  return parts_->array;
}
const std::vector<std::size_t>& LoadReader::place_of() const {
  return parts_->place_of;
}
std::size_t LoadReader::places() const {
  return parts_->places;
}
const Regularisation& LoadReader::regularisation() const {
  return parts_->regularisation;
}
double LoadReader::pitch_m() const {
  return parts_->pitch_m;
}
double LoadReader::condition() const {
  return parts_->condition;
}
const std::vector<double>& LoadReader::own_share() const {
  return parts_->own_share;
}
const std::vector<double>& LoadReader::resolution_m() const {
  return parts_->resolution_m;
}

bool LoadReader::is_resolved(std::size_t pillar, Eigen::Index load) const {
  const std::size_t at =
      pillar * static_cast<std::size_t>(parts_->array.loads) + static_cast<std::size_t>(load);
  return parts_->own_share[at] >= 0.5 && parts_->resolution_m[at] <= parts_->pitch_m;
}

}  // namespace viscard
