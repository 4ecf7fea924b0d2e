#pragma once

#include "models/pillar/mesh/line_mesh.h"

#include <functional>
#include <vector>

namespace viscard {

// A meridian (r, z) or plane (x, z) section: the cells of a rectilinear grid, each filled with one
// region or empty, with tensor-product elements of degree p. On rectangles every matrix is a sum of
// Kronecker products of one-dimensional matrices (models/pillar/README.md, eq. 13). Where a
// region's outline is not straight, its cells are stretched along x: x = scale(z) x_grid.
struct Stretch {
  double scale = 1.0;      // a pure number
  double slope_1_m = 0.0;  // d scale/dz
};

// A cell that is filled, with the numbers of its nodes.
struct SectionElement {
  int column = 0;
  int row = 0;
  int region = 0;
  std::vector<int> nodes;                                  // (p + 1)^2, x fastest
  bool operator==(const SectionElement&) const = default;  // the same cell with the same nodes
};

// The elements and nodes of a section.
class Section {
 public:
  static constexpr int kEmpty = -1;

  // region_at(x, z) returns the region number at the middle of a cell, or kEmpty.
  // Throws std::invalid_argument if every cell is empty.
  Section(LineMesh x, LineMesh z, const std::function<int(double, double)>& region_at);

  const LineMesh& x() const { return x_; }
  const LineMesh& z() const { return z_; }
  int degree() const { return x_.degree(); }
  int node_count() const { return static_cast<int>(node_x_.size()); }
  const std::vector<SectionElement>& elements() const { return elements_; }
  // Place of a node, m.
  double node_x(int node) const { return node_x_[static_cast<std::size_t>(node)]; }
  // Place of a node, m.
  double node_z(int node) const { return node_z_[static_cast<std::size_t>(node)]; }

  // Stretches one region by `of_height`, a function of z in m. Throws std::invalid_argument if the scale is not positive at a break or a
  // node, because elements there would be turned inside out.
  void stretch(int region, std::function<Stretch(double z)> of_height);
  // True for the region that stretch() was called for.
  bool is_stretched(int region) const { return region == stretched_region_; }
  // The stretch of a region at a height; none if it was not stretched.
  Stretch stretch_at(int region, double z) const {
    return is_stretched(region) ? stretch_(z) : Stretch{};
  }

  // Region of a cell, or kEmpty.
  int region(int column, int row) const;
  // Node at a grid position, or -1.
  int node(int ix, int iz) const;

 private:
  LineMesh x_;
  LineMesh z_;
  std::vector<int> region_;  // columns fastest
  std::vector<int> node_;    // x fastest; -1 where there is no element
  std::vector<double> node_x_;
  std::vector<double> node_z_;
  std::vector<SectionElement> elements_;
  int stretched_region_ = kEmpty;
  std::function<Stretch(double)> stretch_;
};

}  // namespace viscard
