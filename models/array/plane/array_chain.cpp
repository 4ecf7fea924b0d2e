#include "models/array/plane/array_chain.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace viscard {

namespace {

// A pivot that differs from that of one period before by less than this is taken as equal: the
// difference, of the order of rounding, decreases further from period to period.
constexpr double kSamePivot = 1e-14;

// Movements smaller than this, relative to the largest one so far, no longer matter to any reading.
constexpr double kArrivesNoMore = 1e-18;

}  // namespace

ArrayChain::ArrayChain(std::vector<const CondensedPiece*> pieces, FilmEnds ends)
    : pieces_(std::move(pieces)) {
  if (pieces_.empty()) throw std::invalid_argument("a chain needs a piece");
  first_port_ = {0};
  for (const CondensedPiece* piece : pieces_) {
    if (piece->end_size != pieces_[0]->end_size) {
      throw std::invalid_argument("the ends of the pieces do not fit together");
    }
    first_port_.push_back(first_port_.back() + piece->port_count());
  }
  number_joints(ends);
  eliminate();
}

void ArrayChain::number_joints(FilmEnds ends) {
  first_row_ = {0};
  const auto n = static_cast<std::size_t>(pieces_[0]->end_size);
  for (std::size_t joint = 0; joint <= pieces_.size(); ++joint) {
    const bool is_outer = joint == 0 || joint == pieces_.size();
    std::vector<int> kept;
    for (std::size_t i = 0; i < n; ++i) {
      const bool is_bare = (joint > 0 && pieces_[joint - 1]->end_is_bare[n + i]) ||
                           (joint < pieces_.size() && pieces_[joint]->end_is_bare[i]);
      if (is_bare && !is_outer) throw std::invalid_argument("an electrode ends between two pieces");
      const bool is_held = is_outer && ends == FilmEnds::kMirror && pieces_[0]->end_is_across[i];
      if (!is_bare && !is_held) kept.push_back(static_cast<int>(i));
    }
    first_row_.push_back(first_row_.back() + static_cast<Eigen::Index>(kept.size()));
    kept_.push_back(std::move(kept));
  }
}

// True if the pieces on both sides of an inner joint are the same as those of the joint before the
// last one.
bool ArrayChain::repeats(std::size_t joint) const {
  return joint >= 3 && joint < pieces_.size() && pieces_[joint - 1] == pieces_[joint - 3] &&
         pieces_[joint] == pieces_[joint - 2];
}

// Block elimination from left to right (Golub & Van Loan, Matrix Computations (2013), 4.5.1).
void ArrayChain::eliminate() {
  std::vector<Eigen::MatrixXd> pivots;   // of each factor
  std::vector<Eigen::MatrixXd> carried;  // update of the next pivot by each factor
  for (std::size_t joint = 0; joint <= pieces_.size(); ++joint) {
    const bool may_share = repeats(joint);
    const int before = joint < 2 ? -1 : factor_of_[joint - 2];
    if (may_share && joint >= 3 && factor_of_[joint - 1] == factor_of_[joint - 3]) {
      factor_of_.push_back(before);  // as all that came since, so is this joint
      continue;
    }
    const auto rows = first_row_[joint + 1] - first_row_[joint];
    Eigen::MatrixXd pivot = Eigen::MatrixXd::Zero(rows, rows);
    if (joint > 0) {
      pivot += block(joint - 1, true, true) - carried[static_cast<std::size_t>(factor_of_.back())];
    }
    if (joint < pieces_.size()) pivot += block(joint, false, false);
    if (may_share) {
      const Eigen::MatrixXd& last = pivots[static_cast<std::size_t>(before)];
      if ((pivot - last).norm() <= kSamePivot * last.norm()) {
        factor_of_.push_back(before);
        continue;
      }
    }
    Factor made{LuFactor(pivot), {}, {}};
    Eigen::MatrixXd carry;
    if (joint < pieces_.size()) {
      const Eigen::MatrixXd next = block(joint, false, true);
      made.upper = made.pivot.solve(next);
      made.lower = next.transpose();
      carry = made.lower * made.upper;
      if (!carry.allFinite()) {
        throw std::runtime_error(
            "the equations of the row's film are singular in double precision; check its moduli "
            "and permittivity, and lengths that differ by many powers of ten");
      }
    }
    factor_of_.push_back(static_cast<int>(factors_.size()));
    factors_.push_back(std::move(made));
    pivots.push_back(std::move(pivot));
    carried.push_back(std::move(carry));
  }
}

int ArrayChain::unknowns() const {
  return static_cast<int>(first_row_.back());
}

Eigen::MatrixXd ArrayChain::block(std::size_t piece, bool row_right, bool column_right) const {
  const CondensedPiece& p = *pieces_[piece];
  const std::vector<int>& rows = kept_[piece + (row_right ? 1 : 0)];
  const std::vector<int>& columns = kept_[piece + (column_right ? 1 : 0)];
  return p.matrix.block(row_right ? p.end_size : 0, column_right ? p.end_size : 0, p.end_size,
                        p.end_size)(rows, columns);
}

Eigen::MatrixXd ArrayChain::port_block(std::size_t piece, bool right) const {
  const CondensedPiece& p = *pieces_[piece];
  return p.matrix.block(right ? p.end_size : 0, 2 * p.end_size, p.end_size, p.port_count())(
      kept_[piece + (right ? 1 : 0)], Eigen::all);
}

Eigen::MatrixXd ArrayChain::pivot_solve(std::size_t joint, const Eigen::MatrixXd& right) const {
  solved_joints_ += right.cols();
  return factor(joint).pivot.solve(right);
}

// Loads on all joints become their displacements and potentials.
void ArrayChain::solve_joints(Eigen::MatrixXd& u) const {
  const auto rows_of = [&](std::size_t joint) { return rows(u, joint); };
  for (std::size_t joint = 0; joint <= pieces_.size(); ++joint) {
    if (joint > 0) rows_of(joint).noalias() -= factor(joint - 1).lower * rows_of(joint - 1);
    rows_of(joint) = pivot_solve(joint, rows_of(joint));
  }
  for (std::size_t joint = pieces_.size(); joint-- > 0;) {
    rows_of(joint).noalias() -= factor(joint).upper * rows_of(joint + 1);
  }
}

Eigen::MatrixXd ArrayChain::compliance(const std::vector<int>& loaded_ports) const {
  const auto loads = static_cast<Eigen::Index>(loaded_ports.size());
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(first_row_.back(), loads);
  const auto rows_of = [&](std::size_t joint) { return rows(u, joint); };
  Eigen::MatrixXd readings = Eigen::MatrixXd::Zero(port_count(), loads);
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    const CondensedPiece& p = *pieces_[piece];
    const Eigen::MatrixXd left = port_block(piece, false);
    const Eigen::MatrixXd right = port_block(piece, true);
    for (Eigen::Index load = 0; load < loads; ++load) {
      const int port = loaded_ports[static_cast<std::size_t>(load)] - first_port_[piece];
      if (port < 0 || port >= p.port_count()) continue;
      rows_of(piece).col(load) += left.col(port);
      rows_of(piece + 1).col(load) += right.col(port);
      readings.col(load).segment(first_port_[piece], p.port_count()) -=
          p.matrix.col(2 * p.end_size + port).tail(p.port_count());
    }
  }
  solve_joints(u);
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    readings.middleRows(first_port_[piece], pieces_[piece]->port_count()) +=
        port_block(piece, false).transpose() * rows_of(piece) +
        port_block(piece, true).transpose() * rows_of(piece + 1);
  }
  return readings;
}

Eigen::VectorXd ArrayChain::readings(const Eigen::VectorXd& loads) const {
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(first_row_.back(), 1);
  const auto rows_of = [&](std::size_t joint) { return rows(u, joint); };
  const auto loads_of = [&](std::size_t piece) {
    return loads.segment(first_port_[piece], pieces_[piece]->port_count());
  };
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    if (!loads_of(piece).any()) continue;
    rows_of(piece) += port_block(piece, false) * loads_of(piece);
    rows_of(piece + 1) += port_block(piece, true) * loads_of(piece);
  }
  solve_joints(u);
  Eigen::VectorXd readings(port_count());
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    const int ports = pieces_[piece]->port_count();
    readings.segment(first_port_[piece], ports) =
        port_block(piece, false).transpose() * rows_of(piece) +
        port_block(piece, true).transpose() * rows_of(piece + 1) -
        pieces_[piece]->matrix.bottomRightCorner(ports, ports) * loads_of(piece);
  }
  return readings;
}

double ArrayChain::reading_within(std::size_t piece, int read_port, int loaded_port) const {
  const Eigen::MatrixXd left = port_block(piece, false);
  const Eigen::MatrixXd right = port_block(piece, true);
  std::vector<Eigen::MatrixXd> u;  // of the joints from the piece's left end on
  double largest = 0.0;
  for (std::size_t joint = piece; joint <= pieces_.size(); ++joint) {
    Eigen::MatrixXd here = Eigen::MatrixXd::Zero(first_row_[joint + 1] - first_row_[joint], 1);
    if (joint == piece) here = left.col(loaded_port);
    if (joint == piece + 1) here = right.col(loaded_port);
    if (joint > piece) here -= factor(joint - 1).lower * u.back();
    u.push_back(pivot_solve(joint, here));
    const double size = u.back().norm();
    largest = std::max(largest, size);
    if (joint > piece && size <= kArrivesNoMore * largest) break;
  }
  for (std::size_t k = u.size() - 1; k-- > 0;) u[k] -= factor(piece + k).upper * u[k + 1];
  const CondensedPiece& p = *pieces_[piece];
  return left.col(read_port).dot(u[0].col(0)) + right.col(read_port).dot(u[1].col(0)) -
         p.matrix(2 * p.end_size + read_port, 2 * p.end_size + loaded_port);
}

}  // namespace viscard
