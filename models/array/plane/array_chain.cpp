#include "models/array/plane/array_chain.h"

#include <stdexcept>
#include <utility>

namespace viscard {

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
  first_row_ = {0};
  for (std::size_t joint = 0; joint <= pieces_.size(); ++joint) {
    const bool is_outer = joint == 0 || joint == pieces_.size();
    std::vector<int> kept;
    for (int i = 0; i < pieces_[0]->end_size; ++i) {
      const bool across = pieces_[0]->end_is_across[static_cast<std::size_t>(i)];
      if (!(is_outer && ends == FilmEnds::kMirror && across)) kept.push_back(i);
    }
    first_row_.push_back(first_row_.back() + static_cast<Eigen::Index>(kept.size()));
    kept_.push_back(std::move(kept));
  }
  // Block elimination from left to right (Golub & Van Loan, Matrix Computations (2013), 4.5.1).
  Eigen::MatrixXd carried;
  for (std::size_t joint = 0; joint <= pieces_.size(); ++joint) {
    Eigen::MatrixXd pivot = Eigen::MatrixXd::Zero(first_row_[joint + 1] - first_row_[joint],
                                                  first_row_[joint + 1] - first_row_[joint]);
    if (joint > 0) pivot += block(joint - 1, true, true) - carried;
    if (joint < pieces_.size()) pivot += block(joint, false, false);
    pivot_.emplace_back(pivot);
    if (joint == pieces_.size()) break;
    const Eigen::MatrixXd next = block(joint, false, true);
    upper_.push_back(pivot_.back().solve(next));
    lower_.push_back(next.transpose());
    carried = lower_.back() * upper_.back();
    if (!carried.allFinite()) {
      throw std::runtime_error("the film of the array is singular; is it held at its bottom?");
    }
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

Eigen::MatrixXd ArrayChain::compliance(const std::vector<int>& loaded_ports) const {
  const auto loads = static_cast<Eigen::Index>(loaded_ports.size());
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(first_row_.back(), loads);
  const auto rows_of = [&](std::size_t joint) {
    return u.middleRows(first_row_[joint], first_row_[joint + 1] - first_row_[joint]);
  };
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
  for (std::size_t joint = 0; joint <= pieces_.size(); ++joint) {
    if (joint > 0) rows_of(joint).noalias() -= lower_[joint - 1] * rows_of(joint - 1);
    rows_of(joint) = pivot_[joint].solve(Eigen::MatrixXd(rows_of(joint)));
  }
  for (std::size_t joint = pieces_.size(); joint-- > 0;) {
    rows_of(joint).noalias() -= upper_[joint] * rows_of(joint + 1);
  }
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    readings.middleRows(first_port_[piece], pieces_[piece]->port_count()) +=
        port_block(piece, false).transpose() * rows_of(piece) +
        port_block(piece, true).transpose() * rows_of(piece + 1);
  }
  return readings;
}

}  // namespace viscard
