#include "models/pillar/analyses/slender_rounding.h"

#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/body/pillar_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

constexpr double kUnitRoundoff = 0.5 * std::numeric_limits<double>::epsilon();

double slenderness_of(const PillarScene& scene) {
  return scene.geometry.length_m / scene.geometry.diameter_m;
}

// A pillar bent to the deflection z^2 above its foot, its sections plane and at right angles to it.
// The fields are those of the rigid motions (rigid_motion.cpp).
Eigen::VectorXd bent_shape(const PillarModel& model) {
  const DiscreteSystem& system = model.system();
  const Section& section = system.section();
  const bool is_strip = model.options().motion == Motion::kPlaneAntisymmetric;
  const int sideways = is_strip ? 0 : 1;
  Eigen::VectorXd shape = Eigen::VectorXd::Zero(system.size());
  for (int node = 0; node < section.node_count(); ++node) {
    const double z_m = std::max(section.node_z(node), 0.0);
    const int across = system.dofs().dof(sideways, node);
    const int along = system.dofs().dof(sideways + 1, node);
    if (across >= 0) shape[across] = (is_strip ? 1.0 : 2.0) * z_m * z_m;
    if (along >= 0) shape[along] = -2.0 * z_m * section.node_x(node);
  }
  return shape;
}

// Energy of that bending, E I int (w'')^2 dz; of a strip per metre.
double bending_energy(const PillarScene& scene) {
  const double R_m = 0.5 * scene.geometry.diameter_m;
  const double moment_m4 =
      scene.plane ? 2.0 * std::pow(R_m, 3) / 3.0 : 0.25 * std::numbers::pi * std::pow(R_m, 4);
  return scene.pillar.E0_Pa * moment_m4 * 4.0 * scene.geometry.length_m;
}

// Root of the sum of squares of what the entries contribute to shape' K shape.
double root_of_squares(const SymmetricSparse& K, const Eigen::VectorXd& shape) {
  double sum = 0.0;
  for (int column = 0; column < K.outerSize(); ++column) {
    for (SymmetricSparse::InnerIterator entry(K, column); entry; ++entry) {
      const double times = entry.row() == entry.col() ? 1.0 : 2.0;
      const double part = times * entry.value() * shape[entry.row()] * shape[entry.col()];
      sum += part * part;
    }
  }
  return std::sqrt(sum);
}

}  // namespace

double rim_share(const PillarScene& scene, const Discretisation& mesh, int layers) {
  constexpr double kCorner = 2.0 * 0.6;
  constexpr double kFront = 0.08;
  return kFront * 0.5 / slenderness_of(scene) * std::pow(mesh.ratio, kCorner * layers);
}

double bending_rounding(const PillarScene& scene, const Discretisation& mesh) {
  // A bound of the formula below over meshes of degree up to 10, far above it for most.
  constexpr double kLargestFactor = 1e5;
  const double bound = kLargestFactor * kUnitRoundoff * std::pow(slenderness_of(scene), 3) /
                       std::pow(mesh.ratio, mesh.layers);
  if (mesh.uniform_m > 0.0 || bound < 0.01 * scene.tolerance) return 0.0;
  constexpr double kDeviations = 8.0;
  const PillarModel model = model_of(scene, lateral_motion(scene), mesh);
  // Of a frequency half as much as of the energy.
  return 0.5 * kDeviations * kUnitRoundoff * root_of_squares(model.stiffness(), bent_shape(model)) /
         bending_energy(scene);
}

double avoid_rounding(const PillarScene& scene, Discretisation& mesh) {
  double rounding = bending_rounding(scene, mesh);
  if (rounding == 0.0) return 0.0;
  // Solutions are corrected by strains, and frequencies taken from them, as long as the corrections end.
  const bool is_corrected = model_of(scene, lateral_motion(scene), mesh).loses_digits() &&
                            !(scene.plane && !scene.pillar.terms.empty());
  constexpr double kCorrected = 0.003;
  while (!scene.discretisation && mesh.layers > 1 &&
         rounding > (is_corrected ? kCorrected : 0.1 * scene.tolerance)) {
    const bool is_for_the_better = rim_share(scene, mesh, mesh.layers - 1) < rounding;
    if (!is_for_the_better && rounding < 0.5 * scene.tolerance) break;
    --mesh.layers;
    rounding = bending_rounding(scene, mesh);
  }
  if (is_corrected && rounding <= kCorrected) return 0.0;
  if (rounding > scene.tolerance) {
    Discretisation enough = mesh;  // changes from mesh to mesh contain the rounding of both
    enough.degree = std::max(mesh.degree, 7);
    const double allowed = 10.0 * bending_rounding(scene, enough);
    throw std::runtime_error(
        "rounding in a pillar " + text_of(slenderness_of(scene), 4) +
        " diameters long leaves a relative error of about " + text_of(rounding, 2) +
        " in bending; " +
        (allowed < 1.0 ? "ask for a tolerance of " + text_of(allowed, 2) + " or larger, or " : "") +
        "take the frequency or the load of a beam (Euler)");
  }
  return rounding;
}

void add_missing_layers(double rim, SceneAnswer& answer) {
  std::map<std::string, int> number;
  for (SceneMode& mode : answer.modes) {
    if (mode.family != "lateral" && mode.family != "longitudinal") continue;
    mode.unresolved = std::max(mode.unresolved, rim * (2 * ++number[mode.family] - 1));
  }
}

void add_rounding(const PillarScene& scene, double rounding, SceneAnswer& answer) {
  if (rounding == 0.0) return;
  // The first frequency of a cantilever (Euler-Bernoulli), without the pressure that may lower it.
  const double gyration_m = scene.geometry.diameter_m / (scene.plane ? std::sqrt(12.0) : 4.0);
  const double first_Hz = 3.516 / (2.0 * std::numbers::pi) * gyration_m *
                          std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3) /
                          std::pow(scene.geometry.length_m, 2);
  for (SceneMode& mode : answer.modes) {
    if (mode.family != "lateral") continue;
    const double of_mode = rounding * std::pow(first_Hz / mode.frequency_Hz, 2);
    mode.unresolved = std::max(mode.unresolved, of_mode);
  }
}

}  // namespace viscard
