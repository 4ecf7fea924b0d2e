#include "models/pillar/system/supernodal_factor.h"

#include "models/maths/may_stop.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace viscard {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// L D L^T of the leading `count` columns of a front in place, without pivoting; the other columns
// become the update (Schur complement). Returns false if a pivot is zero or not finite.
template <typename Scalar>
bool eliminate(Eigen::Ref<typename BlockFactor<Scalar>::Matrix> front, Eigen::Index count,
               Eigen::Ref<typename BlockFactor<Scalar>::Vector> d) {
  constexpr Eigen::Index kPanel = 16;
  const Eigen::Index n = front.rows();
  typename BlockFactor<Scalar>::Matrix scaled;
  for (Eigen::Index start = 0; start < count; start += kPanel) {
    const Eigen::Index width = std::min(kPanel, count - start);
    for (Eigen::Index j = start; j < start + width; ++j) {
      const Scalar pivot = front(j, j);
      if (pivot == 0.0 || !std::isfinite(std::abs(pivot))) return false;
      d[j] = pivot;
      const Eigen::Index below = n - j - 1;
      front.col(j).tail(below) /= pivot;
      for (Eigen::Index k = j + 1; k < start + width; ++k) {
        front.col(k).tail(n - k) -= (front(k, j) * pivot) * front.col(j).tail(n - k);
      }
    }
    const Eigen::Index rest = n - start - width;
    if (rest == 0) continue;
    const auto panel = front.block(start + width, start, rest, width);
    scaled.noalias() = panel * d.segment(start, width).asDiagonal();
    front.bottomRightCorner(rest, rest).template triangularView<Eigen::Lower>() -=
        scaled * panel.transpose();
  }
  return true;
}

// Adds the lower triangle of a child's update to the front of its parent.
template <typename Matrix>
void add_update(const Matrix& update, const std::vector<int>& to, Eigen::Map<Matrix>& front) {
  const auto n = static_cast<Eigen::Index>(to.size());
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto* from = update.data() + j * n;
    auto* column = front.data() + to[static_cast<std::size_t>(j)] * front.rows();
    for (Eigen::Index i = j; i < n; ++i) column[to[static_cast<std::size_t>(i)]] += from[i];
  }
}

}  // namespace

template <typename Scalar>
void BlockFactor<Scalar>::analyse(const Sparse& lower) {
  BlockOrder order = block_order(lower);
  position_ = std::move(order.position);
  blocks_.clear();
  largest_front_ = 0;
  for (ColumnBlock& columns : order.blocks) {
    blocks_.push_back({std::move(columns), -1, {}, {}});
    largest_front_ = std::max<Eigen::Index>(largest_front_, blocks_.back().height());
  }
  find_parents();
  place_entries(lower);
}

template <typename Scalar>
void BlockFactor<Scalar>::find_parents() {
  for (Block& block : blocks_) {
    if (block.rows.empty()) continue;
    // Blocks are sorted by column: the parent is the block that holds the first row.
    const auto after =
        std::upper_bound(blocks_.begin(), blocks_.end(), block.rows.front(),
                         [](int row, const Block& other) { return row < other.first; });
    const Block& up = *(after - 1);
    block.parent = static_cast<int>(&up - blocks_.data());
    auto next = up.rows.begin();  // both ascend
    for (const int row : block.rows) {
      if (row < up.first + up.count) {
        block.to_parent.push_back(row - up.first);
        continue;
      }
      while (*next < row) ++next;
      block.to_parent.push_back(up.count + static_cast<int>(next - up.rows.begin()));
    }
  }
}

template <typename Scalar>
void BlockFactor<Scalar>::place_entries(const Sparse& lower) {
  const int n = static_cast<int>(lower.outerSize());
  const int* starts = lower.outerIndexPtr();
  const int* rows = lower.innerIndexPtr();
  const auto position = [&](int unknown) { return position_[static_cast<std::size_t>(unknown)]; };
  // The first of a pair in elimination order has its column. The pairs of one column of `lower` are counted, and
  // placed, in a local variable where they keep it.
  first_entry_.assign(position_.size() + 1, 0);
  for (int column = 0; column < n; ++column) {
    const int a = position(column);
    std::size_t kept = 0;
    for (int i = starts[column]; i < starts[column + 1]; ++i) {
      const int b = position(rows[i]);
      kept += b >= a ? 1 : 0;
      first_entry_[static_cast<std::size_t>(b) + 1] += b >= a ? 0 : 1;
    }
    first_entry_[static_cast<std::size_t>(a) + 1] += kept;
  }
  std::partial_sum(first_entry_.begin(), first_entry_.end(), first_entry_.begin());
  std::vector<std::size_t> next(first_entry_.begin(), first_entry_.end() - 1);
  entries_.resize(static_cast<std::size_t>(lower.nonZeros()));
  for (int column = 0; column < n; ++column) {
    const int a = position(column);
    std::size_t own = next[static_cast<std::size_t>(a)];
    for (int i = starts[column]; i < starts[column + 1]; ++i) {
      const int b = position(rows[i]);
      if (b >= a)
        entries_[own++] = {i, b};
      else
        entries_[next[static_cast<std::size_t>(b)]++] = {i, a};
    }
    next[static_cast<std::size_t>(a)] = own;
  }
  std::vector<int> in_front(position_.size());  // index of each row in the current block's front
  for (const Block& block : blocks_) {
    const auto first = static_cast<std::size_t>(block.first);
    std::iota(in_front.begin() + block.first, in_front.begin() + block.first + block.count, 0);
    int last = block.count;
    for (const int row : block.rows) in_front[static_cast<std::size_t>(row)] = last++;
    for (int column = 0; column < block.count; ++column) {
      const auto at = first + static_cast<std::size_t>(column);
      for (std::size_t i = first_entry_[at]; i < first_entry_[at + 1]; ++i) {
        const int row = in_front[static_cast<std::size_t>(entries_[i].place)];
        entries_[i].place = column * block.height() + row;
      }
    }
  }
}

template <typename Scalar>
bool BlockFactor<Scalar>::factor(const Eigen::SparseMatrix<Scalar>& lower) {
  pivots_.resize(lower.rows());
  std::vector<Matrix> updates(blocks_.size());  // of each block, for its parent
  std::vector<std::vector<std::size_t>> children(blocks_.size());
  std::vector<Scalar> memory(static_cast<std::size_t>(largest_front_ * largest_front_));
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    may_stop();
    Block& block = blocks_[b];
    const Eigen::Index below = block.height() - block.count;
    Eigen::Map<Matrix> front(memory.data(), block.height(), block.height());
    front.setZero();
    const auto first = first_entry_.begin() + block.first;
    for (std::size_t i = *first; i < *(first + block.count); ++i) {
      memory[static_cast<std::size_t>(entries_[i].place)] = lower.valuePtr()[entries_[i].value];
    }
    for (const std::size_t child : children[b]) {
      add_update(updates[child], blocks_[child].to_parent, front);
      updates[child].resize(0, 0);
    }
    if (!eliminate<Scalar>(front, block.count, pivots_.segment(block.first, block.count)))
      return false;
    block.L = front.leftCols(block.count);
    if (block.parent >= 0) {
      updates[b] = front.bottomRightCorner(below, below);
      children[static_cast<std::size_t>(block.parent)].push_back(b);
    }
  }
  return true;
}

template <typename Scalar>
auto BlockFactor<Scalar>::solve(const Vector& right_side) const -> Vector {
  may_stop();
  Vector x(right_side.size());
  x(position_) = right_side;
  Vector outside;
  for (const Block& block : blocks_) {
    auto own = x.segment(block.first, block.count);
    block.L.topRows(block.count).template triangularView<Eigen::UnitLower>().solveInPlace(own);
    outside.noalias() = block.L.bottomRows(block.L.rows() - block.count) * own;
    x(block.rows) -= outside;
  }
  x.array() /= pivots_.array();
  for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block) {
    auto own = x.segment(block->first, block->count);
    outside = x(block->rows);
    own.noalias() -= block->L.bottomRows(outside.size()).transpose() * outside;
    block->L.topRows(block->count)
        .transpose()
        .template triangularView<Eigen::UnitUpper>()
        .solveInPlace(own);
  }
  return x(position_);
}

template <typename Scalar>
auto BlockFactor<Scalar>::forward(const Matrix& right_sides) const -> Matrix {
  Matrix x(right_sides.rows(), right_sides.cols());
  x(position_, Eigen::all) = right_sides;
  Matrix outside;
  for (const Block& block : blocks_) {
    may_stop();
    auto own = x.middleRows(block.first, block.count);
    block.L.topRows(block.count).template triangularView<Eigen::UnitLower>().solveInPlace(own);
    outside.noalias() = block.L.bottomRows(block.L.rows() - block.count) * own;
    x(block.rows, Eigen::all) -= outside;
  }
  return x;
}

template <typename Scalar>
Eigen::Index BlockFactor<Scalar>::entries() const {
  Eigen::Index count = 0;
  for (const Block& block : blocks_) count += block.L.size();
  return count;
}

template class BlockFactor<double>;
template class BlockFactor<std::complex<double>>;

}  // namespace viscard
