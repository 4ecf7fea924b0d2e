#pragma once

#include "models/array/plane/array_pieces.h"
#include "models/maths/dense.h"

#include <vector>

namespace viscard {

// Pieces joined end to end: a block-tridiagonal system in the unknowns of the joints alone. Ports
// are numbered piece by piece. A disturbance at one end decays along the film, so the pivots of a
// long row of repeating pieces soon repeat too; such joints share one factor.
class ArrayChain {
 public:
  // The pieces must outlive the chain; a piece may stand in it many times. With mirror ends the
  // displacement along x is held at both outer ends. Throws std::invalid_argument if no piece is
  // given, their ends differ in size or a bare end would be joined, std::runtime_error if the chain
  // is singular.
  ArrayChain(std::vector<const CondensedPiece*> pieces, FilmEnds ends);

  int port_count() const { return first_port_.back(); }
  // Number of the first port of a piece; those of the others follow.
  int first_port(std::size_t piece) const { return first_port_[piece]; }
  // Readings of all ports (rows) under unit loads on the given ports (columns).
  Eigen::MatrixXd compliance(const std::vector<int>& loaded_ports) const;
  // Readings of all ports under loads on all of them.
  Eigen::VectorXd readings(const Eigen::VectorXd& loads) const;
  // Reading of a port under a unit load on another port of the same piece. Joints that are too far
  // away to have an effect are left out.
  double reading_within(std::size_t piece, int read_port, int loaded_port) const;

  int unknowns() const;                                              // of the joints
  int factors() const { return static_cast<int>(factors_.size()); }  // different ones
  long solved_joints() const { return solved_joints_; }  // so far, times the number of loads

 private:
  // Factors of a joint: its pivot, and the blocks that couple it to the next joint.
  struct Factor {
    LuFactor pivot;
    Eigen::MatrixXd upper;  // pivot^-1 times the block to the next joint
    Eigen::MatrixXd lower;  // block from the next joint back
  };
  std::vector<const CondensedPiece*> pieces_;
  std::vector<int> first_port_;
  std::vector<Eigen::Index> first_row_;  // of each joint's unknowns
  std::vector<std::vector<int>> kept_;   // unknowns of an end in use at each joint
  std::vector<Factor> factors_;
  std::vector<int> factor_of_;  // by joint
  mutable long solved_joints_ = 0;

  void number_joints(FilmEnds ends);
  bool repeats(std::size_t joint) const;
  void eliminate();
  const Factor& factor(std::size_t joint) const {
    return factors_[static_cast<std::size_t>(factor_of_[joint])];
  }
  Eigen::MatrixXd pivot_solve(std::size_t joint, const Eigen::MatrixXd& right) const;
  Eigen::MatrixXd block(std::size_t piece, bool row_right, bool column_right) const;
  Eigen::MatrixXd port_block(std::size_t piece, bool right) const;  // end unknowns x ports
  void solve_joints(Eigen::MatrixXd& u) const;
  auto rows(Eigen::MatrixXd& u, std::size_t joint) const {  // of a joint among those of all
    return u.middleRows(first_row_[joint], first_row_[joint + 1] - first_row_[joint]);
  }
};

}  // namespace viscard
