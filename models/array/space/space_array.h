#pragma once

#include "models/array/film/coupled_discs.h"
#include "models/array/film/metal_quarters.h"
#include "models/array/space/wide_table.h"
#include "models/maths/offset_sums.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What is read under each pillar, on the face of the film that carries no charge.
enum class SpaceElectrode {
  kSampled,  // the potential under the axis, and its mean over the electrode's disc
  // Additionally its means over the quarters of the disc: 1 (+,+), 2 (-,+), 3 (-,-), 4 (+,-).
  kQuadrants,
  kEquipotential,  // the voltage of an open electrode on the disc
  // The voltages of its quarters as four open electrodes with gaps between them (eq. S19), and their mean, which is that of
  // the four joined.
  kMetalQuadrants,
};
// True if the quarters of an electrode are read.
inline bool has_quarters(SpaceElectrode electrode) {
  return electrode == SpaceElectrode::kQuadrants || electrode == SpaceElectrode::kMetalQuadrants;
}
// True if what is read is the voltage of a conductor.
inline bool is_metal(SpaceElectrode electrode) {
  return electrode == SpaceElectrode::kEquipotential ||
         electrode == SpaceElectrode::kMetalQuadrants;
}
// Index of the voltage of a whole electrode among its readings.
inline Eigen::Index whole_reading(SpaceElectrode electrode) {
  return is_metal(electrode) ? 0 : 1;
}
// Index of that of its first quarter.
inline Eigen::Index first_quarter(SpaceElectrode electrode) {
  return whole_reading(electrode) + 1;
}

// Pillars of one shape and material.
struct PillarClass {
  PillarGeometry geometry;  // without a film
  Medium medium;
};

// Where a pillar stands, and of which class it is.
struct PlacedPillar {
  double x_m = 0.0;
  double y_m = 0.0;
  int of_class = 0;
};

// Pillars on one film, anywhere in its plane. Axis 1 of the film is x.
struct SpaceArray {
  std::vector<PillarClass> classes;
  std::vector<PlacedPillar> pillars;
  LayeredFilm film;
  SpaceElectrode electrode = SpaceElectrode::kSampled;
  double electrode_radius_m = 0.0;
  double electrode_gap_m = 0.0;  // between quarters of metal
};

// Where the pillars stand, for sums over their distances.
std::vector<SourcePoint> sources_of(const SpaceArray& array);
// Largest distance of two pillars, at most: the diagonal of the rectangle around their axes.
double array_diagonal_m(const SpaceArray& array);

// Throws SceneMistake naming what is wrong: no pillars, tops or feet that overlap or nearly touch
// (gaps below a tenth of the diameter change the traction under a foot), electrodes that overlap.
void validate(const SpaceArray& array);

// Columns: values of TopLoad, Pa. Rows: pillars.
using TopLoads = Eigen::Matrix<double, Eigen::Dynamic, kTopLoads>;

// Names of the readings of an electrode: centre, mean or electrode, then quadrant_1, ...
std::vector<std::string> reading_names(SpaceElectrode electrode);
// Of results: "centre_voltage", "quadrant_1_voltage".
std::vector<std::string> voltage_names(SpaceElectrode electrode);

// How finely an array is answered: foot_forces.h and potential_table.h.
struct SpaceAccuracy {
  Discretisation foot;
  PotentialAccuracy potential;
  CouplingAccuracy coupling;  // of open electrodes
  MetalQuartersAccuracy quarters;
};
// Accuracies of rising cost, in the order of the foot's degree (3 to 9). If the loaded face is also
// the one that is read, much shorter waves are needed than for the face below.
std::vector<SpaceAccuracy> space_accuracies(const SpaceArray& array);
// The same for kernels and for small changes: without the charges that electrodes induce on each other.
SpaceAccuracy without_coupling(SpaceAccuracy accuracy);

// Readings of each pillar per load on a pillar at each offset: the answer of one array to any loads. The
// film is linear, and all pillars of a class are alike, so that one table per class answers all.
class SpaceResponse {
 public:
  // The array must outlive the response.
  SpaceResponse(const SpaceArray& array, const SpaceAccuracy& accuracy);

  // V; pillars x readings.
  Eigen::MatrixXd voltages_V(const TopLoads& loads_Pa) const;
  // Sums over the array of many sets of loads: pillars x loads, Pa, to pillars x readings, V.
  using Sums = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& loads_Pa)>;
  // The sums for loads of these kinds, in this order, of the pillars that act. The response must outlive them.
  Sums sums_of(const std::vector<TopLoad>& loads, const std::vector<bool>& acts) const;
  // Readings of a pillar at the offset (x, y) from a loaded one of the class, V/Pa: readings x loads. Charges
  // that are induced on open electrodes of other pillars are left out.
  Eigen::Matrix<double, Eigen::Dynamic, kTopLoads> kernel(int of_class, double x_m,
                                                          double y_m) const;
  // What these charges add to the readings of one pillar per load on each, V/Pa: pillars x loads. Empty if they are
  // left out of all answers.
  Eigen::MatrixXd added_by_electrodes(std::size_t pillar) const;
  // The potential itself at the offset (x, y), V/Pa.
  PotentialByLoad potential(int of_class, double x_m, double y_m) const;

  // Estimate of the largest contribution of pillars beyond the reach of the accuracy to each
  // reading: the largest reading at that distance, since it decays within a pitch. 0 if no two
  // pillars are so far apart.
  Eigen::VectorXd beyond_reach_V(const TopLoads& loads_Pa) const;

  // What a point of the film far from all pillars reads, V; without an electrode.
  double voltage_at_V(double x_m, double y_m, const TopLoads& loads_Pa) const;

  // Forces at the feet of the pillars of a class.
  const FootForces& foot(int of_class) const { return feet_[static_cast<std::size_t>(of_class)]; }
  double capacitance_F() const { return capacitance_F_; }  // of one electrode; 0 if sampled
  const MetalQuarters* quarters() const { return quarters_.get(); }  // null without them
  double reach_m() const { return reach_m_; }  // between axes, beyond which nothing is felt
  int unknowns() const { return unknowns_; }

 private:
  void add_class(const PillarClass& one, const SpaceAccuracy& accuracy, const FilmTable* film,
                 const std::vector<AxialReading>& readings);
  Eigen::Matrix<double, 4, kTopLoads> quarters_at(int of_class, double x_m, double y_m) const;
  // Without the charges that electrodes induce on each other.
  Sums sums_alone(const std::vector<TopLoad>& loads, const std::vector<bool>& acts,
                  const OffsetSums::Kernel& of_loads) const;

  const SpaceArray* array_;
  std::unique_ptr<DiscCharge> charge_;    // of open electrodes
  std::optional<CoupledDiscs> coupling_;  // of several of them
  std::unique_ptr<MetalQuarters> quarters_;
  QuarterRule near_rule_, far_rule_;                      // of quarters of either kind
  std::vector<Eigen::Matrix<double, 4, kTopLoads>> own_;  // by class: of quarters of metal
  double capacitance_F_ = 0.0;
  double reach_m_ = 0.0;  // between axes
  bool is_wide_ = false;  // a backing carries readings beyond the reach
  std::vector<FootForces> feet_;
  std::vector<WideTable> tables_;
  int unknowns_ = 0;
};

}  // namespace viscard
