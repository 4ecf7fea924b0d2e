#include "fit/laws/law_fit.h"

#include "fit/intervals/uncertainty.h"
#include "fit/laws/law_search.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Index = Eigen::Index;

// The columns at the fitted nuisances, and a little to both sides of each nuisance.
struct NearbyColumns {
  LawColumns here;
  struct Sides {
    LawColumns up, down;
    double width = 0.0;
  };
  std::vector<Sides> sides;
};

NearbyColumns nearby_columns(const SpectralModel& model, const Eigen::VectorXd& nuisance) {
  constexpr double kShare = 1e-3;
  NearbyColumns out{columns_on_grid(model, nuisance), {}};
  for (Index k = 0; k < model.n_nuisances(); ++k) {
    const double step = kShare * model.of_nuisances(&Nuisance::scale)[k];
    Eigen::VectorXd up = nuisance, down = nuisance;
    up[k] += step;
    down[k] -= step;
    out.sides.push_back({columns_on_grid(model, up), columns_on_grid(model, down), 2.0 * step});
  }
  return out;
}

// The rows of a law.
Eigen::VectorXd rows_of(const LawColumns& columns, const LawSearch& search, const LawPoint& point) {
  Eigen::VectorXd rows = point.amplitude() * (columns.terms * point.weights);
  for (std::size_t j = 0; j < search.used().size(); ++j) {
    rows += point.linear[static_cast<Index>(j)] * columns.common.col(search.used()[j]);
  }
  return rows;
}

// Derivatives of the rows by common columns in use, amplitude, shapes and nuisances.
Eigen::MatrixXd law_jacobian(const NearbyColumns& columns, const LawSearch& search,
                             const LawPoint& point) {
  const auto n_used = static_cast<Index>(search.used().size());
  const auto n_nuisances = static_cast<Index>(columns.sides.size());
  const Index n_linear = n_used + 1, n_shapes = search.n_shapes();
  Eigen::MatrixXd jacobian(columns.here.terms.rows(), n_linear + n_shapes + n_nuisances);
  for (Index j = 0; j < n_used; ++j) {
    jacobian.col(j) = columns.here.common.col(search.used()[static_cast<std::size_t>(j)]);
  }
  jacobian.col(n_used) = search.kernel(point);
  constexpr double kStep = 1e-4;
  for (Index k = 0; k < n_shapes; ++k) {
    const LawPoint up = search.moved(point, k, kStep), down = search.moved(point, k, -kStep);
    const double width = std::abs(up.ln_tau - down.ln_tau) + std::abs(up.exponent - down.exponent);
    jacobian.col(n_linear + k) =
        point.amplitude() * (search.kernel(up) - search.kernel(down)) / width;
  }
  for (Index k = 0; k < n_nuisances; ++k) {
    const auto& sides = columns.sides[static_cast<std::size_t>(k)];
    jacobian.col(n_linear + n_shapes + k) =
        (rows_of(sides.up, search, point) - rows_of(sides.down, search, point)) / sides.width;
  }
  return jacobian;
}

LawNumbers numbers_of(LawKind kind, bool is_creep, const LawSearch& search, const LawPoint& point) {
  LawNumbers law{kind, is_creep, 0.0, point.amplitude(), point.ln_tau, point.exponent};
  if (search.constant()) law.constant = point.linear[static_cast<Index>(*search.constant())];
  return law;
}

// A law with its free numbers (constant, amplitude, ln tau, exponent) and their covariance.
struct UncertainLaw {
  LawNumbers law;
  std::vector<double LawNumbers::*> members;
  Eigen::MatrixXd covariance;
};

// Central differences of a vector by the free numbers; kept within the bounds of the exponent.
template <typename Function>
Eigen::MatrixXd slopes_of(const UncertainLaw& known, const Function& function) {
  Eigen::MatrixXd slopes(function(known.law).size(), static_cast<Index>(known.members.size()));
  for (std::size_t k = 0; k < known.members.size(); ++k) {
    const auto member = known.members[k];
    const double value = known.law.*member;
    const bool is_shape = member == &LawNumbers::ln_tau || member == &LawNumbers::exponent;
    const double size = is_shape || value == 0.0 ? 1.0 : std::abs(value);
    LawNumbers up = known.law, down = known.law;
    up.*member += 1e-5 * size;
    down.*member -= value == 0.0 && !is_shape ? 0.0 : 1e-5 * size;
    if (!is_shape && value == 0.0) up.*member = 1e-8 * known.law.amplitude;  // on its bound
    up.exponent = std::min(up.exponent, kMostExponent);
    down.exponent = std::max(down.exponent, kLeastExponent);
    slopes.col(static_cast<Index>(k)) =
        (function(up) - function(down)) / (up.*member - down.*member);
  }
  return slopes;
}

void fill_named(const UncertainLaw& known, bool is_stiffness, FittedLaw& out) {
  const NamedLawValues named = named_values(known.law, is_stiffness);
  const Eigen::MatrixXd slopes = slopes_of(known, [&](const LawNumbers& law) {
    const std::vector<double> values = named_values(law, is_stiffness).values;
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size())));
  });
  const Eigen::MatrixXd covariance = slopes * known.covariance * slopes.transpose();
  for (std::size_t i = 0; i < named.values.size(); ++i) {
    const auto row = static_cast<Index>(i);
    LawParameter one{named.names[i], named.values[i], std::sqrt(covariance(row, row)), {}};
    const double half = kNormal95 * one.se;
    one.interval_95 = {std::max(0.0, one.value - half), one.value + half};
    if (named.is_logarithmic[i]) {
      const double factor = std::exp(half / one.value);
      one.interval_95 = {one.value / factor, one.value * factor};
    }
    out.parameters.push_back(one);
  }
}

void fill_series(const UncertainLaw& known, double t_min_s, double t_max_s, FittedLaw& out) {
  const LawSeriesStep step = series_step(known.law, t_min_s, t_max_s);
  out.series = law_series(known.law, t_min_s, t_max_s, step.step);
  out.series_error = step.error;
  out.t_min_s = t_min_s;
  out.t_max_s = t_max_s;
  const auto n_terms = static_cast<Index>(out.series.terms.size());
  const Eigen::MatrixXd slopes = slopes_of(known, [&](const LawNumbers& law) {
    const PronySeries series = law_series(law, t_min_s, t_max_s, step.step);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(1 + 2 * n_terms);
    values[0] = series.equilibrium_modulus_Pa;
    for (Index i = 0; i < std::min(n_terms, static_cast<Index>(series.terms.size())); ++i) {
      values[1 + i] = series.terms[static_cast<std::size_t>(i)].modulus_Pa;
      values[1 + n_terms + i] =
          std::log(series.terms[static_cast<std::size_t>(i)].relaxation_time_s);
    }
    return values;
  });
  out.series_covariance = slopes * known.covariance * slopes.transpose();
}

// The law's free numbers in the order of law_jacobian(), without offset, drift and nuisances.
UncertainLaw uncertain_law(const LawNumbers& law, const LawSearch& search,
                           const Eigen::MatrixXd& covariance) {
  UncertainLaw known{law, {}, {}};
  std::vector<Index> rows;
  const auto add = [&](double LawNumbers::*member, Index row) {
    known.members.push_back(member);
    rows.push_back(row);
  };
  const auto n_used = static_cast<Index>(search.used().size());
  if (search.constant()) add(&LawNumbers::constant, static_cast<Index>(*search.constant()));
  add(&LawNumbers::amplitude, n_used);
  if (search.form().has_time) add(&LawNumbers::ln_tau, n_used + 1);
  add(&LawNumbers::exponent, n_used + search.n_shapes());
  known.covariance = covariance(rows, rows);
  for (Index i = 0; i < known.covariance.rows(); ++i) {
    if (std::isfinite(known.covariance(i, i))) continue;
    known.covariance.row(i).setZero();
    known.covariance.col(i).setZero();
  }
  return known;
}

FittedLaw fitted_law(const SpectralModel& model, const SpectralFit& fit,
                     const NearbyColumns& columns, LawKind kind, bool is_creep,
                     const FitResult& result) {
  const LawSearch search(model, columns.here, kind, is_creep);
  const LawPoint point = search.best();
  FittedLaw out;
  out.name = law_names()[static_cast<std::size_t>(kind)];
  out.is_at_bound = search.is_at_bound(point);
  const Index n_parameters =
      static_cast<Index>(search.used().size()) + 1 + search.n_shapes() + model.n_nuisances();
  out.n_parameters = static_cast<int>(n_parameters);
  const double p = static_cast<double>(n_parameters), n = model.n_samples();
  const double rss = point.rss + std::max(0.0, model.hidden_rss(fit.state));
  const double n_effective = fit.scores.n_effective;
  out.bic =
      n_effective * std::log(std::max(rss, fit.scores.least_rss) / n) + p * std::log(n_effective);
  out.bic_difference = out.bic - fit.scores.rows[fit.scores.chosen].bic;
  out.rss = rss;
  if (model.row_sigma().size() > 0) {
    out.rss = point.residual.cwiseProduct(model.row_sigma()).squaredNorm();
  }
  // The residual of a law that does not describe the record is larger than the noise. Its errors
  // use the larger of two variances: that of the samples and that of the rows.
  const double rows = static_cast<double>(model.n_rows());
  const double variance = std::max(rss / std::max(1.0, n - p), point.rss / std::max(1.0, rows - p));
  const Eigen::MatrixXd covariance = covariance_from_jacobian(
      model, law_jacobian(columns, search, point), variance, fit.noise, fit.row_scale);
  const UncertainLaw known =
      uncertain_law(numbers_of(kind, is_creep, search, point), search, covariance);
  if (!(point.amplitude() > 0.0)) return out;  // the data contain nothing of this law
  fill_named(known, result.is_stiffness, out);
  // ln_tau_min() and ln_tau_max() lie outside the times of the record by a factor of three.
  fill_series(known, 3.0 * std::exp(model.ln_tau_min()), std::exp(model.ln_tau_max()) / 3.0, out);
  return out;
}

}  // namespace

void fit_laws(const SpectralModel& model, const SpectralFit& fit, FitResult& result) {
  if (!fit.options.with_laws) return;
  const auto& common = model.common();
  const bool is_creep = !common.empty() && common.front().name == "J_g";
  const NearbyColumns columns = nearby_columns(model, fit.state.nuisance);
  for (std::size_t i = 0; i < law_names().size(); ++i) {
    result.laws.push_back(
        fitted_law(model, fit, columns, static_cast<LawKind>(i), is_creep, result));
  }
}

}  // namespace viscard
