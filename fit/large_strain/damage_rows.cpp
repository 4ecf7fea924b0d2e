#include "fit/large_strain/damage_rows.h"

#include "models/hyperelastic/law_energy.h"

#include <cmath>
#include <numbers>

namespace viscard {

using Eigen::Index;

struct DamageRows::Energies {
  EnergyHistory history;
  Eigen::MatrixXd slopes;      // of the energy of each reading by moduli and shapes
  std::vector<Index> largest;  // reading that has the largest energy so far; -1: rest
};

DamageRows::DamageRows(const LargeStrainRows& rows, const std::vector<LargeStrainTest>& tests)
    : rows_(rows), first_{0} {
  for (const LargeStrainTest& test : tests) {
    for (const double s : test.stretch) {
      log_strain_.push_back(std::log(s) * strain_direction(test.deformation));
    }
    first_.push_back(static_cast<Index>(log_strain_.size()));
  }
}

DamageRows::Energies DamageRows::energies(HyperelasticForm form,
                                          const HyperelasticPoint& point) const {
  const auto n_readings = static_cast<Index>(log_strain_.size());
  const Index n = point.moduli.size();
  Energies out{{Eigen::VectorXd(n_readings), Eigen::VectorXd(n_readings)},
               Eigen::MatrixXd(n_readings, n + point.shapes.size()),
               std::vector<Index>(log_strain_.size(), -1)};
  for (Index i = 0; i < n_readings; ++i) {
    const EnergyColumns unit =
        energy_columns(form, point.shapes, log_strain_[static_cast<std::size_t>(i)]);
    out.slopes.row(i) << unit.values.transpose(),
        (unit.shape_slopes.transpose() * point.moduli).transpose();
    out.history.now[i] = unit.values.dot(point.moduli);
  }
  for (std::size_t t = 0; t + 1 < first_.size(); ++t) {
    double most = 0.0;
    Index at = -1;
    for (Index i = first_[t]; i < first_[t + 1]; ++i) {
      if (out.history.now[i] >= most) {
        most = out.history.now[i];
        at = i;
      }
      out.history.largest[i] = most;
      out.largest[static_cast<std::size_t>(i)] = at;
    }
  }
  return out;
}

EnergyHistory DamageRows::history(HyperelasticForm form, const HyperelasticPoint& point) const {
  return energies(form, point).history;
}

// With a = m + beta W_m and x = (W_m - W)/a, P = P_0 (1 - erf(x)/r): formula (3) of mullins_damage.h.
DamageRows::Model DamageRows::model(HyperelasticForm form, const HyperelasticPoint& point,
                                    bool with_slopes) const {
  const MullinsDamage& damage = point.damage->constants;
  const Index n = point.moduli.size(), n_law = n + point.shapes.size();
  const auto columns = rows_.columns(form, point.shapes, with_slopes);
  const Energies energy = energies(form, point);
  Model out{columns.values * point.moduli, {}};
  if (with_slopes) {
    out.slopes = Eigen::MatrixXd::Zero(out.values.size(), n_law + 3);
    out.slopes.leftCols(n) = columns.values;
    for (Index k = 0; k < point.shapes.size(); ++k) {
      out.slopes.col(n + k) = columns.slopes[static_cast<std::size_t>(k)] * point.moduli;
    }
  }
  for (Index i = 0; i < energy.history.now.size(); ++i) {
    if (!energy.history.is_damaged(i)) continue;
    const double largest = energy.history.largest[i];
    const double width = damage.m_Pa + damage.beta * largest;
    const double x = (largest - energy.history.now[i]) / width;
    const double undamaged = out.values[i], factor = 1.0 - std::erf(x) / damage.r;
    out.values[i] *= factor;
    if (!with_slopes) continue;
    const double by_x =
        -2.0 * std::numbers::inv_sqrtpi * std::exp(-x * x) / damage.r * undamaged / width;
    const Index at = energy.largest[static_cast<std::size_t>(i)];
    Eigen::RowVectorXd drop = -energy.slopes.row(i);
    if (at >= 0) drop += (1.0 - x * damage.beta) * energy.slopes.row(at);
    out.slopes.row(i).head(n_law) = factor * out.slopes.row(i).head(n_law) + by_x * drop;
    out.slopes(i, n_law) = undamaged * std::erf(x) / (damage.r * damage.r);
    out.slopes(i, n_law + 1) = -by_x * x;
    out.slopes(i, n_law + 2) = -by_x * x * largest;
  }
  return out;
}

}  // namespace viscard
