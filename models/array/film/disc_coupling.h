#pragma once

#include "models/array/film/disc_charge.h"
#include "models/array/film/graf_table.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// How finely the charges that equal discs induce on each other are resolved (eq. S17, models/array/space).
struct CouplingAccuracy {
  int harmonics = 0;  // orders of the angle up to this one; 0: discs do not influence each other
  int modes = 2;      // of each order
  double largest_kt = 10.0;  // PotentialAccuracy
  int film_degree = 8;
  double beyond_nearest_m = 0.0;  // farther than the nearest discs, up to which discs couple
  double far_m = 0.0;     // up to here they feel the charge that a field induces on its own disc
  double settled = 1e-6;  // relative error of what the iterated charges add to a voltage
};

// Fields around an axis, as the potentials of a pillar under its loads: each is the sum of the functions that belong
// to its load.
struct AxialField {
  std::vector<double> k_1_m;
  RadialWaves waves;
  std::vector<AngularFunction> functions;
  std::vector<Eigen::Index> load;  // of each function
  Eigen::Index loads = 0;
  // More waves, of order 0 and of the first load, that only matter on the own axis.
  std::vector<double> own_k_1_m, own_amplitude;
};

// The smallest gap between two discs of this radius whose charges this resolves, so that changes between accuracies
// show the error; discs that touch are one conductor.
double least_gap_m(double film_thickness_m, double radius_m);

// Throws SceneMistake for a film that `what`, "a layer", is not read by.
void check_read_film(const Medium& film, double thickness_m, const std::string& what);
// Throws SceneMistake under the key where discs at this distance overlap, or have a gap smaller than the least one
// (0: of a face without metal, where discs may touch). The pair as it is called, "pillars 1 and 2".
void check_electrode_gap(const std::string& key, const std::string& pair, double distance_m,
                         double radius_m, double least_m);

// Potentials that charges of one disc and other fields leave on an equal disc (eq. S17). The charges of a disc are first
// the one at equal potential, in units of its sum, then modes without net charge: C, cos(m alpha) and
// sin(m alpha) times sqrt(2) for m > 0. The potentials are what these weigh, so that the influence is symmetric.
class DiscCoupling {
 public:
  // The nearest discs are `nearest_m` apart, between axes. The charge must outlive this.
  DiscCoupling(const LayeredFilm& film, const DiscCharge& charge, double nearest_m,
               const CouplingAccuracy& accuracy);

  Eigen::Index modes() const { return modes_; }  // without net charge
  double nearest_m() const { return nearest_m_; }
  double reach_m() const { return reach_m_; }  // of discs that couple

  // V on a disc at (x, y) from another one, by the charges of that one, V/C: 1 + modes() square. The
  // first entry is the coefficient of potential p12 of two discs alone.
  Eigen::MatrixXd between(double x_m, double y_m) const;
  // Modes that make a disc equipotential in a potential with these moments, C per V: modes() square.
  const Eigen::MatrixXd& induced() const { return induced_; }
  // Charges that the field induces on the disc around its own axis: modes() x loads.
  Eigen::MatrixXd own_charges(const AxialField& field) const;
  // Table for the moments of a field whose cause has this radius.
  GrafTable table_of(const AxialField& field, double cause_radius_m) const;
  // Moments of it on a disc at (x, y) from the field's axis, V per load: modes() x loads.
  Eigen::MatrixXd moments_at(const GrafTable& table, const AxialField& field, double x_m,
                             double y_m) const;

 private:
  RadialWaves transforms(const std::vector<double>& k_1_m) const;

  const DiscCharge* charge_;
  double nearest_m_, reach_m_, far_m_;
  int harmonics_, modes_each_;
  Eigen::Index modes_ = 0;
  std::vector<AngularFunction> functions_;  // the charge at equal potential, then the modes
  Eigen::VectorXd scale_;                   // 1, or sqrt(2) for m > 0
  Eigen::MatrixXd induced_;
  std::optional<GrafTable> table_;
};

}  // namespace viscard
