#pragma once

#include "models/array/plane/array_chain.h"

#include <memory>
#include <vector>

namespace viscard {

// One discretised array: pieces condensed once, joined to a chain. Does not move once made.
class ArrayModel {
 public:
  // Throws std::invalid_argument for a geometry or media that make no sense.
  ArrayModel(const ArrayGeometry& geometry, const ArrayElectrodes& electrodes,
             const ArrayMedia& media, const Discretisation& discretisation,
             const PillarInertia& inertia = {});
  ArrayModel(const ArrayModel&) = delete;
  ArrayModel& operator=(const ArrayModel&) = delete;

  const ArrayGeometry& geometry() const { return geometry_; }
  const CondensedPillar& pillar() const { return pillar_; }
  const ArrayChain& chain() const { return *chain_; }

  // Ports of pillar i (0-based) on the chain.
  int pillar_port(int pillar, int port) const;  // kPressurePort, kShearPort, kFirstModePort + k
  int centre_port(int pillar) const;            // potential of the read face under the centre
  int mean_port(int pillar) const;              // its mean over the electrode's width
  int electrode_port(int pillar) const;         // voltage of an equipotential electrode; -1: none
  // Potential of the read face midway between pillar i and its right neighbour (or, for the last
  // pillar before a mirror, at the mirror); -1 if there is none.
  int midway_port(int pillar) const;

  // Unknowns of all pieces before condensation, repeated pieces counted once, and of the joints.
  int unknowns() const { return unknowns_; }

 private:
  CondensedPiece piece(const ArrayMesh& mesh, const ArrayMedia& media, int degree,
                       const FilmPiece& film);

  ArrayGeometry geometry_;
  ArrayElectrodes electrodes_;
  bool has_potential_ = false;
  CondensedPillar pillar_;
  CondensedPiece cell_, gap_, edge_, left_edge_;
  std::vector<std::size_t> cell_place_, midway_place_;  // in the chain, by pillar
  std::unique_ptr<ArrayChain> chain_;
  int unknowns_ = 0;
};

// Responses to unit loads on single pillars: rows are pillars that are read, columns pillars that
// are loaded (0-based). Every static answer of the array is a sum of columns.
struct ArrayResponse {
  Eigen::MatrixXd centre_V;     // charge-free face: under the pillars' centres
  Eigen::MatrixXd mean_V;       // charge-free face: mean over the electrode's width
  Eigen::MatrixXd electrode_V;  // equipotential electrodes, all open; else empty
  Eigen::MatrixXd midway_V;     // midway between pillar i and i + 1; last row the mirror's, if any
  Eigen::MatrixXd top_m;        // mean displacement of the tops: along z under pressure, along x
                                // under shear
  Eigen::MatrixXd V_per_C;      // electrodes: inverse of the capacitance matrix, per metre
};
enum class ArrayLoad { kPressure, kShear };  // 1 Pa on the whole top
ArrayResponse array_response(const ArrayModel& model, ArrayLoad load);

int port_of(ArrayLoad load);  // of a pillar
// Mean displacement of a top over the reading of its load, which is the work of 1 Pa.
double metres_per_reading(ArrayLoad load, const ArrayGeometry& geometry);

}  // namespace viscard
