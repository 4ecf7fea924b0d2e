#pragma once

#include "models/array/plane/array_pieces.h"
#include "models/maths/dense.h"

#include <vector>

namespace viscard {

// Pieces joined end to end: a block-tridiagonal system in the unknowns of the joints alone. Ports
// are numbered piece by piece.
class ArrayChain {
 public:
  // The pieces must outlive the chain; a piece may stand in it many times. With mirror ends the
  // displacement along x is held at both outer ends. Throws std::invalid_argument if no piece is
  // given or their ends differ in size, std::runtime_error if the chain is singular.
  ArrayChain(std::vector<const CondensedPiece*> pieces, FilmEnds ends);

  int port_count() const { return first_port_.back(); }
  int first_port(std::size_t piece) const { return first_port_[piece]; }
  // Readings of all ports (rows) under unit loads on the given ports (columns).
  Eigen::MatrixXd compliance(const std::vector<int>& loaded_ports) const;
  int unknowns() const;  // of the joints

 private:
  std::vector<const CondensedPiece*> pieces_;
  std::vector<int> first_port_;
  std::vector<Eigen::Index> first_row_;  // of each joint's unknowns
  std::vector<std::vector<int>> kept_;   // unknowns of an end in use at each joint
  std::vector<LuFactor> pivot_;
  std::vector<Eigen::MatrixXd> upper_;  // pivot^-1 times the block to the next joint
  std::vector<Eigen::MatrixXd> lower_;  // block from the next joint back

  Eigen::MatrixXd block(std::size_t piece, bool row_right, bool column_right) const;
  Eigen::MatrixXd port_block(std::size_t piece, bool right) const;  // end unknowns x ports
};

}  // namespace viscard
