#include "fit/isotherm_checks.h"

#include "fit/assembly/kramers_kronig.h"
#include "fit/curves/dma_model.h"
#include "fit/intervals/lack_of_fit.h"
#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Of rows relative to their values: sums of squares, and the numbers of values behind them.
struct Scatter {
  double square = 0.0, freedom = 0.0;
  double neighbours = 0.0, n_neighbours = 0.0;

  void add(const Scatter& other) {
    square += other.square;
    freedom += other.freedom;
    neighbours += other.neighbours;
    n_neighbours += other.n_neighbours;
  }
  double variance() const { return square / std::max(1.0, freedom); }
  double noise_variance() const { return neighbours / std::max(1.0, n_neighbours); }
};

// step: rows from one value to the next of the same modulus.
Scatter scatter_of(const Eigen::VectorXd& residual, const Eigen::MatrixXd& own, Index step) {
  const Eigen::MatrixXd basis = PivotedQr(own).basis();
  const Eigen::VectorXd rest = residual - basis * (basis.transpose() * residual);
  const Index n = rest.size();
  Scatter scatter;
  scatter.square = rest.squaredNorm();
  scatter.freedom = static_cast<double>(n - basis.cols());
  if (n <= step) return scatter;
  scatter.neighbours = 0.5 * (rest.tail(n - step) - rest.head(n - step)).squaredNorm();
  scatter.n_neighbours = static_cast<double>(n - step);
  return scatter;
}

void check_fit(const std::vector<MasterSegment>& segments, const ShiftFits& shifts,
               FitResult& result) {
  constexpr double kFewest = 24.0;  // values of all isotherms
  const SpectralState& state = shifts.fit.state;
  const MasterModel& model = *shifts.model;
  const ModelColumns columns = model.columns(state.ln_tau, state.nuisance, /*with_slopes=*/true);
  const Eigen::VectorXd fitted = columns.values * state.coefficients;
  const Eigen::VectorXd by_shift = columns.term_slopes * state.coefficients.tail(state.n_terms());
  const Eigen::VectorXd residual = model.data() - fitted;
  Scatter all;
  double most = 0.0;
  std::size_t worst = 0;
  Index begin = 0;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Index step = segments[k].loss.empty() ? 1 : 2;
    const Index size = step * static_cast<Index>(segments[k].value.size());
    Eigen::MatrixXd own(size, 2);
    own << fitted.segment(begin, size), by_shift.segment(begin, size);
    const Scatter one = scatter_of(residual.segment(begin, size), own, step);
    begin += size;
    all.add(one);
    if (one.variance() <= most) continue;
    most = one.variance();
    worst = k;
  }
  if (all.freedom < kFewest) return;
  constexpr double kTimesNoise = 2.0, kSmallStructure = 5e-3, kRounding = 1e-6;
  LackOfFit lack;
  const double unit = shifts.noise;  // rows are divided by it
  lack.noise = unit * std::sqrt(all.noise_variance());
  lack.structure = unit * std::sqrt(std::max(0.0, all.variance() - all.noise_variance()));
  lack.relative = lack.structure;
  lack.is_significant = lack.structure > lack.noise && lack.structure > kRounding;
  lack.is_far_above_noise =
      lack.structure > kTimesNoise * lack.noise && lack.structure > kSmallStructure;
  result.lack_of_fit = lack;
  flag_lack_of_fit({.unit = "%",
                    .scale = 100.0,
                    .advice = "most is left over at " + celsius(segments[worst].temperature_C) +
                              "; a wrong column, a loss of the instrument, too few terms, or a "
                              "material whose spectrum changes with the temperature"},
                   result);
}

void check_moduli(const std::vector<MasterSegment>& segments, const Eigen::VectorXd& ln_tau,
                  const std::vector<ShiftFactor>& factors, const FitOptions& options,
                  FitResult& result) {
  std::optional<KramersKronigBreak> worst;
  double at_C = 0.0;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const MasterSegment& one = segments[k];
    if (one.loss.empty()) continue;
    std::vector<std::size_t> order(one.argument.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return one.argument[a] < one.argument[b]; });
    std::vector<double> frequency_Hz, storage_Pa, loss_Pa;
    for (const std::size_t i : order) {
      frequency_Hz.push_back(one.argument[i]);
      storage_Pa.push_back(one.value[i]);
      loss_Pa.push_back(one.loss[i]);
    }
    const DmaModel model(frequency_Hz, storage_Pa, loss_Pa, options);
    const auto found = kramers_kronig_break(model, ln_tau.array() + factors[k].ln_a);
    if (!found || (worst && std::abs(found->excess) <= std::abs(worst->excess))) continue;
    worst = found;
    at_C = one.temperature_C;
  }
  if (worst) add_contradiction(*worst, " at " + celsius(at_C), result);
}

}  // namespace

void check_isotherms(const std::vector<MasterSegment>& segments, const ShiftFits& shifts,
                     const std::vector<ShiftFactor>& factors, const FitOptions& options,
                     FitResult& result) {
  check_fit(segments, shifts, result);
  check_moduli(segments, shifts.fit.state.ln_tau, factors, options, result);
}

}  // namespace viscard
