#include "fit/master_start.h"

#include "fit/spectrum_scatter.h"
#include "models/maths/text_of_number.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Difference of ln(argument) between `to` and `from` at equal values: the average over crossings,
// with more weight for steep ones. Weight 0: the values do not overlap.
struct Offset {
  double sum = 0.0, weight = 0.0;
};
void add_crossings(const MasterSegment& from, const MasterSegment& to, double sign,
                   Offset& offset) {
  for (std::size_t j = 0; j < to.value.size(); ++j) {
    for (std::size_t i = 1; i < from.value.size(); ++i) {
      const double before = from.value[i - 1] - to.value[j];
      const double after = from.value[i] - to.value[j];
      if (before * after > 0.0 || before == after) continue;
      // Noise around zero has no logarithm to compare.
      if (!(from.value[i - 1] > 0.0 && from.value[i] > 0.0)) continue;
      const double ln_before = std::log(from.argument[i - 1]);
      const double step = std::log(from.argument[i]) - ln_before;
      if (!(step > 0.0)) continue;
      const double at = ln_before + step * before / (before - after);
      const double steepness = std::log(from.value[i] / from.value[i - 1]) / step;
      offset.sum += sign * (std::log(to.argument[j]) - at) * steepness * steepness;
      offset.weight += steepness * steepness;
    }
  }
}

// The offset of the average over the crossings; none without one.
std::optional<double> offset_of_crossings(const MasterSegment& a, const MasterSegment& b) {
  Offset offset;
  add_crossings(a, b, 1.0, offset);
  add_crossings(b, a, -1.0, offset);
  if (!(offset.weight > 0.0)) return std::nullopt;
  return offset.sum / offset.weight;
}

// Sum of squared differences of ln(modulus) at the points of `to` within the range of `from`, with
// ln(argument) of `to` lowered by `offset`.
struct Overlap {
  double sum = 0.0;
  int count = 0;
};
void add_overlap(const MasterSegment& from, const MasterSegment& to, double offset,
                 Overlap& overlap) {
  std::size_t i = 1;
  for (std::size_t j = 0; j < to.argument.size(); ++j) {
    const double at = std::log(to.argument[j]) - offset;
    while (i + 1 < from.argument.size() && std::log(from.argument[i]) < at) ++i;
    const double left = std::log(from.argument[i - 1]), right = std::log(from.argument[i]);
    if (at < left || at > right || !(right > left)) continue;
    const double share = (at - left) / (right - left);
    const auto compare = [&](const std::vector<double>& of, const std::vector<double>& with) {
      if (!(of[i - 1] > 0.0 && of[i] > 0.0 && with[j] > 0.0)) return;
      const double expected = (1.0 - share) * std::log(of[i - 1]) + share * std::log(of[i]);
      overlap.sum += std::pow(std::log(with[j]) - expected, 2);
      ++overlap.count;
    };
    compare(from.value, to.value);
    if (!to.loss.empty()) compare(from.loss, to.loss);
  }
}

// The offset at which the overlapping parts of two curves differ least; none if they differ by more
// than a tenth. A long overlap is preferred: two more points of 2 % difference are counted.
std::optional<double> offset_of_overlay(const MasterSegment& a, const MasterSegment& b) {
  constexpr double kStep = 0.05, kOwn = 2.0, kTypical = 0.02, kTooFar = 0.1;
  constexpr int kFewest = 4;
  const double low = std::log(b.argument.front() / a.argument.back());
  const double high = std::log(b.argument.back() / a.argument.front());
  std::optional<double> best;
  double least = std::numeric_limits<double>::infinity();
  for (double offset = low; offset <= high; offset += kStep) {
    Overlap overlap;
    add_overlap(a, b, offset, overlap);
    add_overlap(b, a, -offset, overlap);
    if (overlap.count < kFewest) continue;
    const double score = (overlap.sum + kOwn * kTypical * kTypical) / overlap.count;
    if (!(score < least) || overlap.sum > kTooFar * kTooFar * overlap.count) continue;
    least = score;
    best = offset;
  }
  return best;
}

// Both offsets between a segment and the next one, in ln(argument) at equal modulus.
struct Step {
  std::optional<double> crossing, overlay;
  bool is_known() const { return crossing || overlay; }
};

std::vector<Step> steps_of(const std::vector<MasterSegment>& segments) {
  std::vector<Step> steps;
  for (std::size_t k = 1; k < segments.size(); ++k) {
    steps.push_back({offset_of_crossings(segments[k - 1], segments[k]),
                     offset_of_overlay(segments[k - 1], segments[k])});
  }
  return steps;
}

constexpr const char* kApart = "no modulus in common with the isotherms around the reference";

[[noreturn]] void refuse_apart(const std::vector<MasterSegment>& segments,
                               const std::vector<Step>& steps) {
  std::size_t gap = 0;
  while (steps[gap].is_known()) ++gap;
  throw std::runtime_error("the moduli at " + celsius(segments[gap].temperature_C) + " and " +
                           celsius(segments[gap + 1].temperature_C) +
                           " have no value in common, so they cannot be shifted onto each "
                           "other; measure a temperature in between, or longer records");
}

// Keeps the sequence of overlapping segments that contains the reference, or else the longest one.
void keep_connected(MasterSegments& all, std::vector<Step>& steps,
                    const std::optional<double>& T_ref_C) {
  const std::optional<std::size_t> wanted =
      T_ref_C ? std::optional(reference_of(all.segments, T_ref_C)) : std::nullopt;
  std::size_t first = 0, last = 0;  // the run to keep, without `last`
  for (std::size_t from = 0; from < all.segments.size();) {
    std::size_t to = from + 1;
    while (to < all.segments.size() && steps[to - 1].is_known()) ++to;
    const bool is_better = wanted ? *wanted >= from && *wanted < to : to - from > last - first;
    if (is_better) {
      first = from;
      last = to;
    }
    from = to;
  }
  if (last - first == all.segments.size()) return;
  if (last - first < 2) refuse_apart(all.segments, steps);
  leave_out(all, last, all.segments.size(), kApart);
  leave_out(all, 0, first, kApart);
  steps = {steps.begin() + static_cast<std::ptrdiff_t>(first),
           steps.begin() + static_cast<std::ptrdiff_t>(last) - 1};
}

// "40=1.2", as the option is written.
std::string text_of_shift(const StartShift& shift) {
  return text_of(shift.temperature_C) + "=" + text_of(shift.log10_a);
}

// ln a at the segments that have a given shift, and 0 at the reference.
std::vector<std::optional<double>> given_shifts(const std::vector<StartShift>& given,
                                                const std::vector<MasterSegment>& segments,
                                                std::size_t reference) {
  std::vector<std::optional<double>> ln_a(segments.size());
  for (const StartShift& one : given) {
    const std::string option = "--start-shift " + text_of_shift(one);
    const auto k = segment_at(segments, one.temperature_C);
    if (!k) {
      throw std::runtime_error(option + ": no isotherm was measured at " +
                               celsius(one.temperature_C) + "; there are " +
                               temperatures_of(segments));
    }
    const std::string name = celsius(segments[*k].temperature_C);
    if (*k == reference && one.log10_a != 0.0) {
      throw std::runtime_error(option + ": " + name +
                               " is the reference temperature, whose shift is 0; omit it, or "
                               "choose another one with --reference-temperature");
    }
    if (ln_a[*k]) {
      throw std::runtime_error(option + ": the isotherm at " + name +
                               " has a start value already, " +
                               text_of(*ln_a[*k] / std::numbers::ln10) + "; give one");
    }
    ln_a[*k] = one.log10_a * std::numbers::ln10;
  }
  ln_a[reference] = 0.0;
  return ln_a;
}

// Sign of a step in ln(argument) as a step of ln a from a segment to the next warmer one.
double sign_of(const std::vector<MasterSegment>& segments) {
  return segments.front().loss.empty() ? 1.0 : -1.0;
}

// Segments without a shift follow their neighbour, first the one on the side of the reference.
void follow_neighbours(const std::vector<Step>& steps, double sign, std::size_t reference,
                       std::vector<std::optional<double>>& ln_a) {
  const auto follow = [&](std::size_t from, std::size_t to) {
    const Step& step = steps[std::min(from, to)];
    if (ln_a[to] || !ln_a[from] || !step.is_known()) return;
    const double later = step.crossing ? *step.crossing : *step.overlay;
    ln_a[to] = *ln_a[from] + (to > from ? sign : -sign) * later;
  };
  const std::size_t last = ln_a.size() - 1;
  for (std::size_t k = reference; k < last; ++k) follow(k, k + 1);
  for (std::size_t k = reference; k > 0; --k) follow(k, k - 1);
  for (std::size_t k = last; k > reference; --k) follow(k, k - 1);
  for (std::size_t k = 0; k < reference; ++k) follow(k, k + 1);
}

// Keeps the segments that given shifts or their neighbours place, and returns ln a of these. Neighbours that have
// no modulus in common get the step between their given shifts.
Eigen::VectorXd keep_given(MasterSegments& all, std::vector<Step>& steps,
                           const std::vector<StartShift>& given, std::size_t reference,
                           MasterStart& start) {
  std::vector<std::optional<double>> ln_a = given_shifts(given, all.segments, reference);
  const double sign = sign_of(all.segments);
  follow_neighbours(steps, sign, reference, ln_a);
  if (std::count_if(ln_a.begin(), ln_a.end(), [](const auto& one) { return one.has_value(); }) <
      2) {
    refuse_apart(all.segments, steps);
  }
  for (std::size_t k = ln_a.size(); k-- > 0;) {
    if (!ln_a[k]) leave_out(all, k, k + 1, kApart);
  }
  std::erase_if(ln_a, [](const auto& one) { return !one.has_value(); });
  steps = steps_of(all.segments);
  Eigen::VectorXd kept(static_cast<Index>(ln_a.size()));
  for (std::size_t k = 0; k < ln_a.size(); ++k) {
    kept[static_cast<Index>(k)] = *ln_a[k];
    if (k == 0) continue;
    Step& step = steps[k - 1];
    if (step.is_known()) {
      ++start.n_overlaps;
      continue;
    }
    step.crossing = sign * (*ln_a[k] - *ln_a[k - 1]);
    start.apart.push_back(celsius(all.segments[k - 1].temperature_C) + " and " +
                          celsius(all.segments[k].temperature_C));
  }
  return kept;
}

Eigen::VectorXd chain_of(const std::vector<Step>& steps, bool is_dma, bool by_overlay,
                         std::size_t reference) {
  Eigen::VectorXd ln_a = Eigen::VectorXd::Zero(static_cast<Index>(steps.size()) + 1);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const Step& step = steps[k];
    const std::optional<double>& first = by_overlay ? step.overlay : step.crossing;
    const double later = first ? *first : by_overlay ? *step.crossing : *step.overlay;
    const auto at = static_cast<Index>(k);
    ln_a[at + 1] = ln_a[at] + (is_dma ? -later : later);
  }
  return ln_a.array() - ln_a[static_cast<Index>(reference)];
}

// The parameters of a law with the least scatter. From several starts, each parameter is changed by
// a factor that becomes finer when no change improves the scatter.
ShiftCandidate best_of_law(const ShiftForm& form, const std::vector<Eigen::VectorXd>& starts,
                           const SpectrumScatter& scatter) {
  ShiftCandidate best;
  Eigen::VectorXd p;
  const auto offer = [&](const Eigen::VectorXd& trial) {
    ShiftCandidate now = scatter.at(form.ln_a(trial));
    if (!(now.scatter < best.scatter)) return false;
    best = std::move(now);
    p = trial;
    return true;
  };
  for (const Eigen::VectorXd& start : starts) offer(start);
  const std::vector<Nuisance> limits = form.nuisances(best.ln_a);
  for (double step = 0.2; step > 0.01; step *= 0.5) {
    bool is_better = true;
    for (int round = 0; is_better && round < 6; ++round) {
      is_better = false;
      for (Index j = 0; j < p.size(); ++j) {
        for (const double factor : {1.0 + step, 1.0 / (1.0 + step)}) {
          Eigen::VectorXd trial = p;
          const Nuisance& limit = limits[static_cast<std::size_t>(j)];
          trial[j] = std::clamp(p[j] * factor, limit.low, limit.high);
          if (!offer(trial)) continue;
          is_better = true;
          break;
        }
      }
    }
  }
  return best;
}

// Parameters of a law through a chain of shifts. For WLF also candidates with its slope at the
// reference and several C2, because the far end of a chain may be wrong.
std::vector<Eigen::VectorXd> law_starts(const ShiftForm& form, const Eigen::VectorXd& ln_a,
                                        const std::vector<double>& temperature_C,
                                        std::size_t reference) {
  std::vector<Eigen::VectorXd> starts{form.nearest(ln_a)};
  if (form.n_parameters() < 2) return starts;
  const std::size_t first = reference > 0 ? reference - 1 : 0;
  const std::size_t last = std::min(reference + 1, temperature_C.size() - 1);
  const double slope = (ln_a[static_cast<Index>(first)] - ln_a[static_cast<Index>(last)]) /
                       (temperature_C[last] - temperature_C[first]);
  const double most = form.nuisances(ln_a)[1].high;
  for (const double share : {0.1, 0.25, 0.5, 0.75}) {
    starts.push_back(Eigen::Vector2d(std::max(slope, 1e-3), share * most));
  }
  return starts;
}

}  // namespace

MasterStart master_start(MasterSegments& all, const MasterData& data, const FitOptions& options) {
  const std::vector<StartShift>& given = data.start_shifts;
  std::optional<double> T_ref_C = data.T_ref_C;
  std::size_t reference = reference_of(all.segments, T_ref_C);  // refuses one that is not there
  std::vector<Step> steps = steps_of(all.segments);
  MasterStart start;
  Eigen::VectorXd of_given;
  if (given.empty()) {
    keep_connected(all, steps, T_ref_C);
  } else {
    T_ref_C = all.segments[reference].temperature_C;  // given shifts are relative to it
    of_given = keep_given(all, steps, given, reference, start);
  }
  reference = reference_of(all.segments, T_ref_C);
  start.reference = reference;
  const bool is_dma = !all.segments.front().loss.empty();
  std::vector<double> temperature_C;
  for (const MasterSegment& segment : all.segments) temperature_C.push_back(segment.temperature_C);
  const SpectrumScatter scatter(all.segments, reference, options);
  ShiftCandidate as_given, chain;
  if (!given.empty()) chain = as_given = scatter.at(of_given);
  for (const bool by_overlay : {false, true}) {
    const Eigen::VectorXd ln_a = chain_of(steps, is_dma, by_overlay, reference);
    const ShiftCandidate next = scatter.at(ln_a);
    if (next.scatter < chain.scatter) chain = next;
  }
  ShiftCandidate best = chain;
  constexpr double kPreferred = 1.1;  // a law is smooth where the chain follows the noise
  for (const ShiftFormKind law : {ShiftFormKind::kArrhenius, ShiftFormKind::kWlf}) {
    if (law == ShiftFormKind::kWlf && all.segments.size() < 4) continue;
    const ShiftForm form(law, temperature_C, reference);
    const ShiftCandidate of_law =
        best_of_law(form, law_starts(form, chain.ln_a, temperature_C, reference), scatter);
    if (of_law.scatter < (best.ln_a == chain.ln_a ? kPreferred : 1.0) * best.scatter) best = of_law;
  }
  // What a person gives counts as much as a law where the rows tell little.
  start.is_as_given = !given.empty() && as_given.scatter < kPreferred * best.scatter;
  if (start.is_as_given) best = as_given;
  start.ln_a = {best.ln_a.begin(), best.ln_a.end()};
  start.ln_b = {best.ln_b.begin(), best.ln_b.end()};
  start.noise = best.scatter;
  return start;
}

}  // namespace viscard
