#include "io/cost/cost_model.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Run = CostModel::Run;

// Assembly grows in proportion to the unknowns. Factors of a mesh in the plane take unknowns^1.5
// with the best order of elimination (George, SIAM J. Numer. Anal. 10 (1973) 345) and unknowns^2
// with a banded one, so no sensible power lies outside.
constexpr double kLeastExponent = 1.0;
constexpr double kUsualExponent = 1.5;
constexpr double kLargestExponent = 2.0;
// Smaller runs spend their time on set-up and would make the line too flat.
constexpr double kSmallest = 1.0 / 30.0;  // of the largest, in unknowns
// The most that a mesh takes, times unknowns^1.5; a single run that took more has a fixed part. The
// examples take 4e-8 (voltage of one pillar) to 1.2e-5 (a pulse in time) on a machine of 2026.
constexpr double kMostPerUnknown_s = 1e-4;

const Run& largest_of(const std::vector<Run>& runs) {
  return *std::max_element(runs.begin(), runs.end(),
                           [](const Run& a, const Run& b) { return a.unknowns < b.unknowns; });
}

// Of the least-squares line of log time over log unknowns; empty where the runs are too much alike.
std::optional<double> slope_of(const std::vector<Run>& runs) {
  const double least = kSmallest * largest_of(runs).unknowns;
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Run& run : runs) {
    if (run.unknowns < least || !(run.cpu_s > 0.0)) continue;
    const double log_n = std::log(run.unknowns);
    const double log_s = std::log(run.cpu_s);
    n += 1.0;
    x += log_n;
    y += log_s;
    xx += log_n * log_n;
    xy += log_n * log_s;
  }
  const double spread = xx - x * x / std::max(n, 1.0);
  if (n < 2.0 || spread < 1e-3) return std::nullopt;
  return (xy - x * y / n) / spread;
}

double usual_work(const Run& run) {
  return std::pow(run.unknowns, kUsualExponent);
}

double fixed_of_one(const Run& run) {
  return std::max(0.0, run.cpu_s - kMostPerUnknown_s * usual_work(run));
}

// Fixed part of runs whose time grows less than the unknowns: least squares of the relative errors of
// fixed + a unknowns^1.5 with neither part below zero.
double fixed_of(const std::vector<Run>& runs) {
  double uu = 0.0, uw = 0.0, ww = 0.0, u = 0.0, w = 0.0;
  for (const Run& run : runs) {
    if (!(run.cpu_s > 0.0)) continue;
    const double of_fixed = 1.0 / run.cpu_s;
    const double of_work = usual_work(run) / run.cpu_s;
    uu += of_fixed * of_fixed;
    uw += of_fixed * of_work;
    ww += of_work * of_work;
    u += of_fixed;
    w += of_work;
  }
  const double determinant = uu * ww - uw * uw;
  const double fixed = (u * ww - w * uw) / determinant;
  const double work = (w * uu - u * uw) / determinant;
  return work > 0.0 ? std::max(fixed, 0.0) : u / uu;
}

}  // namespace

double CostPower::seconds() const {
  return (cpu_s - fixed_s) / std::pow(unknowns, exponent);
}

double CostPower::cpu_s_of(double more_unknowns) const {
  return fixed_s + (cpu_s - fixed_s) * std::pow(more_unknowns / unknowns, exponent);
}

// Factors of a mesh in the plane have unknowns * log2(unknowns) entries (George 1973).
double CostPower::memory_B_of(double more_unknowns) const {
  const auto entries = [](double n) { return n * std::log2(std::max(n, 2.0)); };
  return memory_B * entries(more_unknowns) / entries(unknowns);
}

void CostModel::add(const std::string& kind, const Run& run) {
  runs_[kind].push_back(run);
}

const std::vector<Run>* CostModel::runs_like(const std::string& kind) const {
  const auto own = runs_.find(kind);
  if (own != runs_.end()) return &own->second;
  const std::vector<Run>* best = nullptr;
  for (const auto& [name, runs] : runs_) {
    if (best == nullptr || largest_of(runs).unknowns > largest_of(*best).unknowns) best = &runs;
  }
  return best;
}

std::optional<CostPower> CostModel::power(const std::string& kind) const {
  const std::vector<Run>* runs = runs_like(kind);
  if (runs == nullptr) return std::nullopt;
  const Run& largest = largest_of(*runs);
  CostPower power{.exponent = kUsualExponent,
                  .unknowns = largest.unknowns,
                  .cpu_s = largest.cpu_s,
                  .memory_B = largest.memory_B};
  const std::optional<double> slope = slope_of(*runs);
  if (!slope) {
    power.fixed_s = fixed_of_one(largest);
  } else if (*slope < kLeastExponent) {
    power.fixed_s = std::min(fixed_of(*runs), largest.cpu_s);
  } else if (runs_.count(kind) > 0) {
    power.exponent = std::min(*slope, kLargestExponent);
  }
  return power;
}

double CostModel::unknowns(const std::string& kind, double size) const {
  const std::vector<Run>* runs = runs_like(kind);
  if (runs == nullptr) return 0.0;
  const auto distance = [size](const Run& run) { return std::abs(std::log(run.size / size)); };
  const Run& nearest =
      *std::min_element(runs->begin(), runs->end(),
                        [&](const Run& a, const Run& b) { return distance(a) < distance(b); });
  return nearest.unknowns * size / nearest.size;
}

double CostModel::cpu_s(const std::string& kind, double size) const {
  const std::optional<CostPower> of = power(kind);
  return of ? of->cpu_s_of(unknowns(kind, size)) : 0.0;
}

}  // namespace viscard
