#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace viscard {

// The loads that the four quarters of one electrode can distinguish, in this order: pressure, shear
// along x and along y, Pa.
constexpr int kSensedLoads = 3;

// Voltages of the quarters 1 (+,+), 2 (-,+), 3 (-,-) and 4 (+,-) of a pillar per load on it, V/Pa: quarters x loads.
using QuadrantResponse = Eigen::Matrix<double, 4, kSensedLoads>;
// Loads per voltage of each quarter, Pa/V: loads x quarters.
using QuadrantGains = Eigen::Matrix<double, kSensedLoads, 4>;

// The loads that fit four voltages best, (B^T B)^-1 B^T (eq. Q1). Throws std::invalid_argument if
// the quarters cannot distinguish the loads.
QuadrantGains quadrant_gains(const QuadrantResponse& response);

// Standard deviation of each load, Pa, where the four voltages have independent noise of this rms (eq. Q4).
Eigen::Matrix<double, kSensedLoads, 1> sensed_noise_Pa(const QuadrantGains& gains, double noise_V);

// Means over the nodes of a mesh of the electrode instead of over its area, as in the thesis' appendix A.1: a node in
// the centre and circles of nodes, of which one lies on the axis +x. Nodes on an axis are counted to the side >= 0.
struct NodeMeans {
  int circles = 8;     // evenly spaced, the last on the rim
  int on_circle = 29;  // nodes of each
};

// A node of the mesh as a part of the mean of its quarter.
struct QuadrantNode {
  double x_m = 0.0, y_m = 0.0;
  int quarter = 0;      // 0 to 3
  double weight = 0.0;  // 1 over the nodes of its quarter
};
// Throws std::invalid_argument for a mesh that leaves a quarter without nodes.
std::vector<QuadrantNode> nodes_of(const NodeMeans& means, double radius_m);

// How the forces of the pillars are found from the voltages of the quarters of an array.
struct QuadrantSensing {
  bool by_neighbours = true;       // false: each pillar from its own four voltages (eq. Q1 alone)
  std::optional<NodeMeans> nodes;  // voltages are means over nodes, gains those of means over areas
  double noise_V = 0.0;            // rms of each quarter's open voltage; 0: not stated
  Eigen::MatrixXd measured_V;      // pillars x 4; empty: the voltages of the scene's own loads
};

}  // namespace viscard
