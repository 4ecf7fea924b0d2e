#include "models/array/plane/strip_top.h"

#include "models/array/plane/plane_system.h"
#include "models/pillar/mesh/line_mesh.h"
#include "models/pillar/system/supernodal_factor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

constexpr int kCornerLayers = 3;
constexpr double kCornerRatio = 0.2;

// Equal elements, the outer ones cut into layers toward the corners.
std::vector<double> top_breaks(double width_m, int elements) {
  const double half_m = 0.5 * width_m, size_m = width_m / elements;
  std::vector<double> breaks =
      graded_breaks(-half_m, -half_m + size_m, kCornerLayers, kCornerRatio, false);
  append_breaks(breaks, graded_breaks(-half_m + size_m, half_m - size_m, elements - 2, 1.0, true));
  append_breaks(breaks, graded_breaks(half_m - size_m, half_m, kCornerLayers, kCornerRatio, true));
  return breaks;
}

// From one end to the middle: layers, then elements that grow.
std::vector<double> heights_from_end(double width_m, double half_length_m, int elements) {
  constexpr double kGrowth = 1.6, kTallest = 0.5;  // of the width
  double size_m = std::min(width_m / elements, half_length_m);
  std::vector<double> heights = graded_breaks(0.0, size_m, kCornerLayers, kCornerRatio, false);
  while (heights.back() + 1.5 * size_m < half_length_m) {
    heights.push_back(heights.back() + size_m);
    size_m = std::min(kGrowth * size_m, kTallest * width_m);
  }
  if (heights.back() < half_length_m * (1.0 - 1e-9)) heights.push_back(half_length_m);
  return heights;
}

std::vector<double> strip_heights(const ArrayGeometry& g, int elements) {
  std::vector<double> breaks = heights_from_end(g.diameter_m, 0.5 * g.length_m, elements);
  for (std::size_t i = breaks.size() - 1; i-- > 0;) breaks.push_back(g.length_m - breaks[i]);
  return breaks;
}

}  // namespace

StripCompliance strip_compliance(const ArrayGeometry& geometry, const ArrayMedia& media,
                                 int elements) {
  const PlaneForm form = plane_form(media.pillar, media.plane, false);
  const int degree = form.condensed_bulk_Pa > 0.0 ? 3 : 2;
  const Section section(LineMesh(top_breaks(geometry.diameter_m, elements), degree),
                        LineMesh(strip_heights(geometry, elements), degree),
                        [](double, double) { return 0; });
  const DiscreteSystem system(section, whole_plane(), plane_dofs(section, true));
  const SymmetricSparse stiffness = stiffness_of(system, form);
  SupernodalFactor factor;
  factor.analyse(stiffness);
  if (!factor.factor(stiffness)) {
    throw std::runtime_error("the stiffness of a strip is singular; check the materials");
  }
  const int n = section.x().node_count(), top = section.z().node_count() - 1;
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(system.size(), 2 * n);
  StripCompliance strip;
  strip.length_m = Eigen::VectorXd::Zero(n);
  const Eigen::VectorXd lengths =
      system.line_load(kUp, section.z().element_count(), 0, section.x().element_count());
  for (int i = 0; i < n; ++i) {
    const int node = section.node(i, top);
    forces(system.dofs().dof(kAcross, node), i) = 1.0;
    forces(system.dofs().dof(kUp, node), n + i) = -1.0;  // down
    strip.length_m[i] = lengths[system.dofs().dof(kUp, node)];
  }
  const Eigen::MatrixXd half = factor.forward(forces);
  strip.motion_m2_N = half.transpose() * factor.pivots().cwiseInverse().asDiagonal() * half;
  const std::vector<double>& nodes = section.x().nodes();
  strip.x_m = Eigen::Map<const Eigen::VectorXd>(nodes.data(), n);
  return strip;
}

Eigen::MatrixXd traction_amplitudes(const StripCompliance& strip, int top_degree) {
  const Eigen::Index n = strip.nodes();
  const double width_m = strip.length_m.sum();
  std::vector<double> at;
  for (const double x_m : strip.x_m) at.push_back(0.5 + x_m / width_m);
  const Eigen::MatrixXd legendre = legendre_values(top_degree, at);
  Eigen::MatrixXd amplitudes =
      Eigen::MatrixXd::Zero(kFirstModePort + 2 * static_cast<Eigen::Index>(top_degree), 2 * n);
  for (int degree = 0; degree <= top_degree; ++degree) {
    const Eigen::RowVectorXd of_forces =
        (2.0 * degree + 1.0) / width_m * legendre.col(degree).transpose();
    amplitudes.row(traction_port(kShearPort, degree, top_degree)).head(n) = of_forces;
    amplitudes.row(traction_port(kPressurePort, degree, top_degree)).tail(n) = of_forces;
  }
  return amplitudes;
}

}  // namespace viscard
