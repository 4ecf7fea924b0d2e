#include "models/material/series_directions.h"

#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

SeriesDirection no_direction(std::size_t n_terms) {
  return {0.0, std::vector<double>(n_terms, 0.0), std::vector<double>(n_terms, 0.0)};
}

// Adds `amount` to the parameter with that name. Names of other parameters are ignored.
void add_to(SeriesDirection& direction, const std::string& name, double amount) {
  if (name == "E_inf_Pa") direction.equilibrium_Pa += amount;
  for (std::size_t i = 0; i < direction.ln_tau.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    if (name == "E_" + number + "_Pa") direction.modulus_Pa[i] += amount;
    if (name == "ln_tau_" + number) direction.ln_tau[i] += amount;
  }
}

}  // namespace

std::vector<SeriesDirection> directions_of(const std::vector<std::string>& names,
                                           const Eigen::MatrixXd& covariance, std::size_t n_terms) {
  const Eigen::Index count = covariance.rows();
  const Eigen::VectorXd deviation = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const double scale = deviation[i] * deviation[j];
      if (i != j && scale > 0.0) correlation(i, j) = covariance(i, j) / scale;
    }
  }
  constexpr double kRounding = 1e-12;  // of a correlation; its eigenvalues add up to its size
  const EigenSystem found = symmetric_eigen(correlation);
  std::vector<SeriesDirection> directions;
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!(found.values[k] > kRounding)) continue;
    SeriesDirection direction = no_direction(n_terms);
    bool moves = false;
    for (Eigen::Index i = 0; i < count; ++i) {
      const double amount = std::sqrt(found.values[k]) * deviation[i] * found.vectors(i, k);
      moves = moves || amount != 0.0;
      add_to(direction, names[static_cast<std::size_t>(i)], amount);
    }
    if (moves) directions.push_back(std::move(direction));
  }
  return directions;
}

SeriesDirection common_scale(const PronySeries& series, double relative) {
  SeriesDirection direction = no_direction(series.terms.size());
  direction.equilibrium_Pa = relative * series.equilibrium_modulus_Pa;
  for (std::size_t i = 0; i < series.terms.size(); ++i) {
    direction.modulus_Pa[i] = relative * series.terms[i].modulus_Pa;
  }
  return direction;
}

PronySeries moved(const PronySeries& series, const SeriesDirection& direction, double step) {
  PronySeries out = series;
  out.equilibrium_modulus_Pa =
      std::max(0.0, series.equilibrium_modulus_Pa + step * direction.equilibrium_Pa);
  for (std::size_t i = 0; i < out.terms.size(); ++i) {
    MaxwellTerm& term = out.terms[i];
    term.modulus_Pa = std::max(0.0, term.modulus_Pa + step * direction.modulus_Pa[i]);
    term.relaxation_time_s *= std::exp(step * direction.ln_tau[i]);
  }
  return out;
}

}  // namespace viscard
