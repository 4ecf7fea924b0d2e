#include "models/array/film/coupled_discs.h"

#include "models/maths/neighbours.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr int kMostOrders = 60;
constexpr double kNeighbours = 4.0;  // nearest discs of a disc in a square lattice

double largest(const Eigen::MatrixXd& of) {
  return of.size() > 0 ? of.cwiseAbs().maxCoeff() : 0.0;
}

}  // namespace

CoupledDiscs::CoupledDiscs(const LayeredFilm& film, const DiscCharge& charge,
                           const std::vector<SourcePoint>& points, const CouplingAccuracy& accuracy)
    : coupling_(film, charge, nearest_distance_m(points, 2.0 * charge.radius_m()), accuracy),
      points_(points),
      accuracy_(accuracy) {
  const double nearest_m = coupling_.nearest_m();
  const Eigen::Index modes = coupling_.modes();
  const Eigen::MatrixXd nearest = coupling_.between(nearest_m, 0.0);
  ratio_ = kNeighbours * (coupling_.induced() * nearest.bottomRightCorner(modes, modes)).norm();
  // Charges of higher order need the moments that charges leave on each other, not only the voltages.
  const Eigen::Index rows = ratio_ > accuracy.settled ? 1 + modes : 1;
  const std::vector<bool> all(points.size(), true);
  std::vector<SourcePoint> discs = points;
  for (SourcePoint& one : discs) one.kind = 0;
  others_.emplace(discs, all, coupling_.reach_m(), [&](int, double x_m, double y_m) {
    if (is_own(x_m, y_m)) return Eigen::MatrixXd::Zero(rows, modes).eval();
    return coupling_.between(x_m, y_m).topRightCorner(rows, modes).eval();
  });
}

void CoupledDiscs::add_kind(AxialField field, double radius_m) {
  fields_.push_back(std::move(field));
  tables_.push_back(coupling_.table_of(fields_.back(), radius_m));
  own_.push_back(coupling_.own_charges(fields_.back()));
}

bool CoupledDiscs::is_own(double x_m, double y_m) const {
  return std::hypot(x_m, y_m) < 0.5 * coupling_.nearest_m();
}

// A charge without net charge does not change the voltage of its own disc.
Eigen::RowVectorXd CoupledDiscs::by_own_charge(int kind, double x_m, double y_m) const {
  const Eigen::MatrixXd& own = own_[static_cast<std::size_t>(kind)];
  if (is_own(x_m, y_m)) return Eigen::RowVectorXd::Zero(own.cols());
  return coupling_.between(x_m, y_m).row(0).tail(own.rows()) * own;
}

OffsetSums::Kernel CoupledDiscs::kernel_of(const std::vector<Eigen::Index>& columns) const {
  return [this, columns](int kind, double x_m, double y_m) -> Eigen::MatrixXd {
    const Eigen::Index modes = coupling_.modes();
    if (is_own(x_m, y_m)) return Eigen::MatrixXd::Zero(modes, std::ssize(columns));
    const auto of = static_cast<std::size_t>(kind);
    const Eigen::MatrixXd all =
        coupling_.moments_at(tables_[of], fields_[of], x_m, y_m) +
        coupling_.between(x_m, y_m).bottomRightCorner(modes, modes) * own_[of];
    return all(Eigen::all, columns);
  };
}

// A Neumann series: each order is what the charges of the one before induce.
CoupledDiscs::Settled CoupledDiscs::settled(const Eigen::MatrixXd& moments) const {
  const Eigen::Index modes = coupling_.modes();
  const Eigen::MatrixXd to_charges = coupling_.induced().transpose();
  Eigen::MatrixXd charges = moments * to_charges;
  Settled sum{charges, Eigen::VectorXd::Zero(moments.rows())};
  double ratio = ratio_;
  for (int order = 0; order < kMostOrders; ++order) {
    const Eigen::MatrixXd seen = others_->apply(charges);
    sum.voltage_V += seen.col(0);
    const double last = largest(charges);
    if (ratio * last <= accuracy_.settled * largest(sum.charges)) return sum;
    charges = seen.rightCols(modes) * to_charges;
    sum.charges += charges;
    ratio = largest(charges) / last;
  }
  throw std::runtime_error(
      "the electrodes lie so close that the charges that they induce on each other do not settle "
      "in " +
      std::to_string(kMostOrders) + " steps; ask for a smaller geometry.electrode.radius");
}

CoupledDiscs::Sums CoupledDiscs::sums_of(const std::vector<Eigen::Index>& columns,
                                         const std::vector<bool>& acts) const {
  return [this, moments = NearSums(points_, acts, coupling_.reach_m(), kernel_of(columns))](
             const Eigen::MatrixXd& loads) -> Eigen::MatrixXd {
    return settled(moments.apply(loads)).voltage_V;
  };
}

Eigen::MatrixXd CoupledDiscs::moments_of_charge(std::size_t disc) const {
  std::vector<bool> acts(points_.size(), false);
  acts[disc] = true;
  std::vector<SourcePoint> discs = points_;
  for (SourcePoint& one : discs) one.kind = 0;
  const NearSums sums(discs, acts, coupling_.reach_m(), [&](int, double x_m, double y_m) {
    if (is_own(x_m, y_m)) {
      return Eigen::MatrixXd::Zero(1 + coupling_.modes(), 1).eval();
    }
    return Eigen::MatrixXd(coupling_.between(x_m, y_m).leftCols(1));
  });
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(points_.size()), 1);
  unit(static_cast<Eigen::Index>(disc), 0) = 1.0;
  return sums.apply(unit);
}

// By reciprocity, the charges that a unit charge on the disc induces on the others weigh the potential there.
Eigen::MatrixXd CoupledDiscs::added_row(std::size_t disc) const {
  const Eigen::Index modes = coupling_.modes();
  const Eigen::MatrixXd charges = settled(moments_of_charge(disc).rightCols(modes)).charges;
  std::vector<bool> acts;
  for (Eigen::Index i = 0; i < charges.rows(); ++i) acts.push_back(!charges.row(i).isZero(0.0));
  std::vector<Eigen::Index> columns(static_cast<std::size_t>(fields_.front().loads));
  for (std::size_t c = 0; c < columns.size(); ++c) columns[c] = static_cast<Eigen::Index>(c);
  Eigen::MatrixXd row =
      Eigen::MatrixXd::Zero(charges.rows(), static_cast<Eigen::Index>(columns.size()));
  const OffsetSums::Kernel kernel = kernel_of(columns);
  for (std::size_t kind = 0; kind < fields_.size(); ++kind) {
    const NearSums sums(points_, acts, coupling_.reach_m(), [&](int, double x_m, double y_m) {
      return kernel(static_cast<int>(kind), -x_m, -y_m).transpose().eval();
    });
    const Eigen::MatrixXd of_kind = sums.apply(charges);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i].kind != static_cast<int>(kind)) continue;
      row.row(static_cast<Eigen::Index>(i)) = of_kind.row(static_cast<Eigen::Index>(i));
    }
  }
  return row;
}

Eigen::VectorXd CoupledDiscs::voltages_V_C(std::size_t charged) const {
  const Eigen::MatrixXd alone = moments_of_charge(charged);
  return alone.col(0) + settled(alone.rightCols(coupling_.modes())).voltage_V;
}

}  // namespace viscard
