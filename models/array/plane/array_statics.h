#pragma once

#include "models/array/plane/array_chain.h"

#include <memory>
#include <vector>

namespace viscard {

// The film under each pillar, with the pillar on it. The outer ones are used if `ends_differ`.
struct CondensedCells {
  CondensedPiece inner, first, last;
  bool ends_differ = false;
};

// One discretised array: pieces condensed once, joined to a chain. Does not move once made.
class ArrayModel {
 public:
  // Throws std::invalid_argument for a geometry or media that make no sense.
  ArrayModel(const ArrayGeometry& geometry, const ArrayElectrodes& electrodes,
             const ArrayMedia& media, const Discretisation& discretisation,
             const PillarPorts& extra = {});
  ArrayModel(const ArrayModel&) = delete;
  ArrayModel& operator=(const ArrayModel&) = delete;

  const ArrayGeometry& geometry() const { return geometry_; }
  const CondensedPillar& pillar() const { return pillar_; }
  const ArrayChain& chain() const { return *chain_; }
  // Readings of all ports under loads on them, with every electrode at 0 V. The port of an
  // electrode then reads its load, which is minus its charge.
  Eigen::VectorXd readings_at_0_V(const Eigen::VectorXd& loads) const;

  // Ports of pillar i (0-based) on the chain.
  int pillar_port(int pillar, int port) const;  // kPressurePort, kShearPort, kFirstModePort + k
  int centre_port(int pillar) const;            // potential of the read face under the centre
  int mean_port(int pillar) const;              // its mean over the electrode's width
  int electrode_port(int pillar) const;         // voltage of an equipotential electrode; -1: none
  // Potential of the read face midway between pillar i and its right neighbour (or, for the last
  // pillar before a mirror, at the mirror); -1 if there is none.
  int midway_port(int pillar) const;

  std::size_t cell_place(int pillar) const {  // in the chain
    return cell_place_[static_cast<std::size_t>(pillar)];
  }

  // Unknowns of all pieces before condensation, repeated pieces counted once, and of the joints.
  int unknowns() const { return unknowns_; }

 private:
  CondensedPiece piece(const ArrayMesh& mesh, const ArrayMedia& media, int degree,
                       const FilmPiece& film);

  ArrayGeometry geometry_;
  ArrayElectrodes electrodes_;
  bool has_potential_ = false;
  CondensedPillar pillar_;
  CondensedCells condensed_cells(const ArrayMesh& mesh, const ArrayMedia& media, int degree);
  std::unique_ptr<ArrayChain> chain_of(const CondensedCells& cells) const;

  CondensedCells cells_;
  CondensedPiece gap_, edge_, left_edge_;               // without unknowns: there is none
  std::vector<std::size_t> cell_place_, midway_place_;  // in the chain, by pillar
  std::unique_ptr<ArrayChain> chain_;
  int unknowns_ = 0;
};

// Direction of the traction on the tops.
enum class ArrayLoad { kPressure, kShear };  // on the whole top

// All values of a row under loads on its pillars in Pa, by pillar. Time and memory grow with the number of
// pillars, not with its square.
struct ArrayAnswer {
  Eigen::VectorXd centre_V,
      mean_V;                   // charge-free face: under the centre; over the electrode's width
  Eigen::VectorXd electrode_V;  // equipotential electrodes, all open; else empty
  Eigen::VectorXd midway_V;     // between pillar i and i + 1; the last the mirror's, if any
  Eigen::VectorXd top_m;        // mean displacement: along z under pressure, along x under shear
  Eigen::VectorXd electrode_C;  // all electrodes at 0 V, per metre
  Eigen::VectorXd pushed_m2, sheared_m2;  // readings of the tops' pressure and shear ports
};
ArrayAnswer array_answer(const ArrayModel& model, ArrayLoad load, const Eigen::VectorXd& load_Pa);
// Under loads on any ports of the chain; without top_m.
ArrayAnswer array_answer(const ArrayModel& model, const Eigen::VectorXd& loads);
// Centre (electrode) voltage of a pillar for 1 Pa on itself alone, beside its neighbours.
double own_V_per_Pa(const ArrayModel& model, ArrayLoad load, int pillar);
// Voltage of an equipotential electrode for 1 C on itself alone, all open, per metre.
double own_V_per_C(const ArrayModel& model, int pillar);

int port_of(ArrayLoad load);  // of a pillar
// Mean displacement of a top over the reading of its load, which is the work of 1 Pa.
double metres_per_reading(ArrayLoad load, const ArrayGeometry& geometry);

}  // namespace viscard
