#include "fit/master_shifts.h"

#include "fit/assembly/assemble_result.h"
#include "fit/intervals/uncertainty.h"
#include "fit/master_forms.h"
#include "fit/samples/noise_model.h"
#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

// The scaled second differences of the law that is nearest to the start set the size of the prior.
double typical_curvature(const std::vector<MasterSegment>& segments, const MasterStart& start) {
  std::vector<double> temperature_C;
  for (const MasterSegment& segment : segments) temperature_C.push_back(segment.temperature_C);
  const Eigen::VectorXd ln_a =
      Eigen::Map<const Eigen::VectorXd>(start.ln_a.data(), static_cast<Index>(start.ln_a.size()));
  const ShiftForm wlf(ShiftFormKind::kWlf, temperature_C, start.reference);
  const ShiftForm smooth(ShiftFormKind::kSmooth, temperature_C, start.reference);
  const Eigen::VectorXd p = smooth.nearest(wlf.ln_a(wlf.nearest(ln_a)));
  const auto n = static_cast<double>(std::max<Index>(1, p.size() - 1));
  constexpr double kLeast = 0.05;  // of the whole shift
  return std::max(p.tail(p.size() - 1).norm() / std::sqrt(n), kLeast * std::abs(p[0]) + 1e-3);
}

// True if the shift of an isotherm deviates from the parabola over 1/T through its two neighbours
// on either side by more than a tenth of a decade and a tenth of the step between its neighbours. A
// smooth curve that the data bend so much is in effect a free one.
bool is_erratic(const MasterModel& model, const SpectralState& state,
                const std::vector<MasterSegment>& segments) {
  constexpr double kVisible = 0.23, kShare = 0.1;
  const Eigen::VectorXd ln_a = model.ln_a(state.nuisance);
  for (Index k = 1; k + 1 < ln_a.size(); ++k) {
    const Index first = std::max<Index>(0, k - 2), last = std::min(k + 2, ln_a.size() - 1);
    const Index n = last - first;
    if (n < 3) continue;
    Eigen::MatrixXd columns(n, 3);
    Eigen::VectorXd values(n);
    Index row = 0;
    const double own_K = segments[static_cast<std::size_t>(k)].temperature_C - kAbsoluteZero_C;
    for (Index i = first; i <= last; ++i) {
      if (i == k) continue;
      const double T_K = segments[static_cast<std::size_t>(i)].temperature_C - kAbsoluteZero_C;
      const double x = own_K / T_K - 1.0;
      columns.row(row) << 1.0, x, x * x;
      values[row++] = ln_a[i];
    }
    const double off = std::abs(ln_a[k] - PivotedQr(columns).solve(values)[0]);
    if (off > std::max(kVisible, kShare * std::abs(ln_a[k + 1] - ln_a[k - 1]))) return true;
  }
  return false;
}

// The laws by generalised least squares from the free factors; the constants of a law that was
// fitted to the rows themselves replace those, with the same widths of the intervals.
ShiftLaws laws_of(const std::vector<ShiftFactor>& all, const Eigen::MatrixXd& covariance,
                  std::size_t reference, const FormFit& wlf, const FormFit& arrhenius) {
  std::vector<ShiftFactor> others = all;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(reference));
  ShiftLaws laws = fit_shift_laws(others, covariance, all[reference].temperature_C);
  const auto move = [](double& value, Interval& interval, double to) {
    interval = {interval.low + to - value, interval.high + to - value};
    value = to;
  };
  if (laws.wlf && wlf.model && wlf.state.nuisance[1] > 0.0) {
    const double slope = wlf.state.nuisance[0], inverse = wlf.state.nuisance[1];
    move(laws.wlf->C1, laws.wlf->C1_95, slope / (inverse * std::log(10.0)));
    move(laws.wlf->C2_K, laws.wlf->C2_K_95, 1.0 / inverse);
  }
  if (laws.arrhenius && arrhenius.model) {
    move(laws.arrhenius->activation_J_mol, laws.arrhenius->activation_J_mol_95,
         1000.0 * kGasConstant_J_mol_K * arrhenius.state.nuisance[0]);
  }
  return laws;
}

// What all forms start from: the number of terms and the noise at the first shifts, and the
// decision about vertical shifts.
struct RoughFit {
  MasterShape shape;
  Eigen::VectorXd ln_tau;
};

RoughFit rough_fit(const Forms& forms, const std::vector<MasterSegment>& segments,
                   const MasterStart& start, const Eigen::VectorXd& ln_a,
                   const FitOptions& options) {
  const auto noise_of = [](const SpectralFit& fit) {
    constexpr double kLeastNoise = 1e-6;
    return std::max(std::sqrt(fit.variance), kLeastNoise);
  };
  RoughFit rough;
  MasterShape& shape = rough.shape;
  shape.form = segments.size() > 2 ? ShiftFormKind::kSmooth : ShiftFormKind::kFree;
  shape.curvature_sd = typical_curvature(segments, start);
  if (options.vertical_shift != VerticalShift::kOff) {
    const SpectralFit fixed = forms.at_fixed(ln_a, start.ln_b);
    shape.noise = noise_of(fixed);
    rough.ln_tau = fixed.state.ln_tau;
    MasterShape with = shape;
    with.has_vertical = true;
    shape.has_vertical = options.vertical_shift == VerticalShift::kOn ||
                         forms.prefers_vertical(forms.fit(shape, rough.ln_tau, ln_a),
                                                forms.fit(with, rough.ln_tau, ln_a));
    if (shape.has_vertical) return rough;
  }
  const SpectralFit fixed = forms.at_fixed(ln_a, {});
  shape.noise = noise_of(fixed);
  rough.ln_tau = fixed.state.ln_tau;
  return rough;
}

// All forms with one number of terms. A form starts from the smooth curve and from the first shifts,
// because a law may be far from the curve where the data determine little.
struct AllForms {
  FormFit smooth, free, wlf, arrhenius;  // wlf: empty for fewer than four segments
  Yardstick yard;
};

AllForms all_forms(const Forms& forms, const RoughFit& rough, const Eigen::VectorXd& start_ln_a,
                   const FitOptions& options) {
  AllForms all;
  all.smooth = forms.smooth(forms.fit(rough.shape, rough.ln_tau, start_ln_a));
  const Eigen::VectorXd ln_a = all.smooth.model->ln_a(all.smooth.state.nuisance);
  const auto of_form = [&](ShiftFormKind form) {
    MasterShape shape = all.smooth.shape;
    shape.form = form;
    FormFit one = forms.fit(shape, all.smooth.state.ln_tau, ln_a);
    FormFit two = forms.fit(shape, rough.ln_tau, start_ln_a);
    return one.rss < two.rss ? one : two;
  };
  all.free = of_form(ShiftFormKind::kFree);
  all.yard = yardstick_of(all.free, all.smooth, options);
  if (start_ln_a.size() > 3) all.wlf = of_form(ShiftFormKind::kWlf);
  all.arrhenius = of_form(ShiftFormKind::kArrhenius);
  return all;
}

const FormFit& taken_of(const AllForms& all, const std::vector<MasterSegment>& segments) {
  const Yardstick& yard = all.yard;
  const bool has_wlf = all.wlf.model && !yard.is_worse(all.wlf);
  const bool has_arrhenius = !yard.is_worse(all.arrhenius);
  if (has_wlf && (!has_arrhenius || yard.bic(all.wlf) < yard.bic(all.arrhenius))) return all.wlf;
  if (has_arrhenius) return all.arrhenius;
  const bool is_smooth =
      !yard.is_worse(all.smooth) && !is_erratic(*all.smooth.model, all.smooth.state, segments);
  return is_smooth ? all.smooth : all.free;
}

}  // namespace

std::vector<ShiftFactor> shift_factors(const MasterModel& model,
                                       const std::vector<MasterSegment>& segments,
                                       const SpectralState& state,
                                       const Eigen::MatrixXd& covariance) {
  const Index first = model.n_common() + 2 * state.n_terms();
  const Index n_shifts = model.form().n_parameters(), all = model.n_nuisances();
  const Eigen::MatrixXd of_shifts = covariance.block(first, first, n_shifts, n_shifts);
  const Eigen::VectorXd ln_a = model.ln_a(state.nuisance), ln_b = model.ln_b(state.nuisance);
  const Eigen::MatrixXd slopes = model.form().slopes(state.nuisance.head(n_shifts));
  std::vector<ShiftFactor> factors;
  Index vertical = first + n_shifts;
  for (Index k = 0; k < ln_a.size(); ++k) {
    const double variance = slopes.row(k).cwiseAbs().maxCoeff() > 0.0
                                ? slopes.row(k).dot(of_shifts * slopes.row(k).transpose())
                                : 0.0;
    ShiftFactor factor{segments[static_cast<std::size_t>(k)].temperature_C, ln_a[k],
                       std::sqrt(std::max(0.0, variance)), ln_b[k], 0.0};
    const bool is_reference = slopes.row(k).cwiseAbs().maxCoeff() == 0.0;
    if (all > n_shifts && !is_reference) {
      factor.ln_b_se = std::sqrt(std::max(0.0, covariance(vertical, vertical)));
      ++vertical;
    }
    factors.push_back(factor);
  }
  return factors;
}

ShiftFits fit_shifts(const std::vector<MasterSegment>& segments, const MasterStart& start,
                     const std::vector<int>& blocks, const FitOptions& options) {
  const Forms forms(segments, start, blocks, options);
  const Eigen::VectorXd ln_a =
      Eigen::Map<const Eigen::VectorXd>(start.ln_a.data(), static_cast<Index>(start.ln_a.size()));
  const RoughFit rough = rough_fit(forms, segments, start, ln_a, options);
  const AllForms all = all_forms(forms, rough, ln_a, options);
  const FormFit& taken = taken_of(all, segments);
  const FormFit& free = all.free;

  ShiftFits out;
  MasterShape shape = taken.shape;
  const bool has_priors = shape.has_vertical || shape.form == ShiftFormKind::kSmooth;
  if (!has_priors) shape.noise = 1.0;
  out.model = forms.model(shape, taken.model->ln_a(taken.state.nuisance));
  out.fit = fit_spectrum(*out.model, blocks, options);
  out.noise = shape.noise;
  out.form = shape.form;
  out.has_vertical = shape.has_vertical;
  const auto rms = [&](const FormFit& fit) { return std::sqrt(fit.rss / all.yard.rows); };
  out.taken_rms = rms(taken);
  out.free_rms = rms(free);
  out.smooth_rms = rms(all.smooth);
  const Autoregression noise = options.white_noise
                                   ? Autoregression{}
                                   : autoregression(free.model->residual_series(free.state));
  const Eigen::MatrixXd covariance = parameter_covariance(
      *free.model, free.state, all.yard.variance / (free.shape.noise * free.shape.noise), noise);
  out.free_factors = shift_factors(*free.model, segments, free.state, covariance);
  const Index first = free.model->n_common() + 2 * free.state.n_terms();
  const Index n = free.model->form().n_parameters();
  out.laws = laws_of(out.free_factors, covariance.block(first, first, n, n), start.reference,
                     all.wlf, all.arrhenius);
  return out;
}

}  // namespace viscard
