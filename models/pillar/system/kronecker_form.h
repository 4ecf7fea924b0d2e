#pragma once

#include "models/pillar/mesh/section.h"
#include "models/pillar/system/kinematics.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace viscard {

// int x^(x_power - k) d^di d^dj on every element of a line: [element][k][di][dj].
class LineIntegrals {
 public:
  LineIntegrals(const LineMesh& line, int x_power, int inverse_powers);
  const Eigen::MatrixXd& operator()(int element, int k, int di, int dj) const {
    return values_[static_cast<std::size_t>(element)][index(k, di, dj)];
  }

 private:
  static std::size_t index(int k, int di, int dj) {
    return static_cast<std::size_t>(4 * k + 2 * di + dj);
  }
  std::vector<std::array<Eigen::MatrixXd, 12>> values_;
};

// A quadratic form on the rectangles of a section as sums of Kronecker products (eq. 13).
class KroneckerForm {
 public:
  // One matrix D per region; an empty one skips the region. The section must outlive the form.
  KroneckerForm(const Section& section, const Kinematics& kinematics,
                const std::vector<OperatorRow>& rows,
                const std::vector<Eigen::MatrixXd>& per_region);

  // True if the form skips the region.
  bool is_empty(int region) const { return pairs_.at(static_cast<std::size_t>(region)).empty(); }

  // Calls add(f, g, z, x) for every product z (x) x, x fastest, of the block of an element between the
  // fields f >= g: the lower triangle.
  template <typename Add>
  void each(const SectionElement& element, const Add& add) const {
    const std::vector<FieldPair>& of_region = pairs_[static_cast<std::size_t>(element.region)];
    Eigen::MatrixXd x(n1_, n1_);
    for (int f = 0; f < fields_; ++f) {
      for (int g = 0; g <= f; ++g) {
        const FieldPair& pair = of_region[static_cast<std::size_t>(f * fields_ + g)];
        for (int dz = 0; dz < 4; ++dz) {
          const auto& terms = pair.by_dz[static_cast<std::size_t>(dz)];
          if (terms.empty()) continue;
          x.setZero();
          for (const XTerm& t : terms) {
            x += t.factor * in_x_(element.column, t.inverse_x, t.dx_i, t.dx_j);
          }
          add(f, g, in_z_(element.row, 0, dz / 2, dz % 2), x);
        }
      }
    }
  }

 private:
  // Coefficients of one pair of fields: [dz_i][dz_j] -> list of (inverse power, dx_i, dx_j, factor).
  struct XTerm {
    int inverse_x, dx_i, dx_j;
    double factor;
  };
  struct FieldPair {
    std::array<std::vector<XTerm>, 4> by_dz;
  };
  static std::vector<FieldPair> field_pairs(const std::vector<OperatorRow>& rows,
                                            const Eigen::MatrixXd& D, int field_count);

  int fields_;
  Eigen::Index n1_;
  LineIntegrals in_x_, in_z_;
  std::vector<std::vector<FieldPair>> pairs_;  // of each region
};

}  // namespace viscard
