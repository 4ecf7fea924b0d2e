#pragma once

#include "models/array/film/disc_coupling.h"
#include "models/maths/near_sums.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace viscard {

// Open electrodes, equal discs anywhere in the plane, in the fields around the same points (loaded pillars). Each disc gains
// charge without a net charge, whose potential the other discs stand in too (multiple scattering, eq. S17).
class CoupledDiscs {
 public:
  // At least two points, whose kinds select their fields. The charge must outlive this.
  CoupledDiscs(const LayeredFilm& film, const DiscCharge& charge,
               const std::vector<SourcePoint>& points, const CouplingAccuracy& accuracy);

  // The field around the points of the next kind under unit loads, without charges, and the radius of what causes it.
  void add_kind(AxialField field, double radius_m);

  // Voltage of a disc at (x, y) from a point of the kind, by the charge that the field of that point induces on
  // its own disc alone, V per load.
  Eigen::RowVectorXd by_own_charge(int kind, double x_m, double y_m) const;

  // Sums over the points of loads: points x columns of the fields to points x 1, V.
  using Sums = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& loads)>;
  // What all other charges on the discs add to the voltage of each disc, by loads on the points that act. This must
  // outlive the sums. Throws std::runtime_error if the charges do not settle.
  Sums sums_of(const std::vector<Eigen::Index>& columns, const std::vector<bool>& acts) const;
  // The same for one disc, as its voltage per load on each point: points x columns of the fields.
  Eigen::MatrixXd added_row(std::size_t disc) const;
  // Voltage of each disc per charge on one of them, V/C, whose own voltage is left out.
  Eigen::VectorXd voltages_V_C(std::size_t charged) const;

 private:
  struct Settled {
    Eigen::MatrixXd charges;    // discs x modes
    Eigen::VectorXd voltage_V;  // of each disc, by these charges
  };
  // From the moments of the potential of everything else: discs x modes.
  Settled settled(const Eigen::MatrixXd& moments) const;
  Eigen::MatrixXd moments_of_charge(std::size_t disc) const;
  // Moments of a point's field and of the charge on its own disc, on other discs.
  OffsetSums::Kernel kernel_of(const std::vector<Eigen::Index>& columns) const;
  bool is_own(double x_m, double y_m) const;

  DiscCoupling coupling_;
  std::vector<SourcePoint> points_;
  CouplingAccuracy accuracy_;
  std::vector<AxialField> fields_;
  std::vector<GrafTable> tables_;
  std::vector<Eigen::MatrixXd> own_;  // by kind: charges on the own disc, modes x loads
  double ratio_ = 0.0;                // about the ratio of the charges from one order to the next
  std::optional<NearSums> others_;    // charges of discs to voltage and moments of others
};

}  // namespace viscard
