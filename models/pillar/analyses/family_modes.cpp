#include "models/pillar/analyses/family_modes.h"

#include "models/maths/failure_text.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/modal_mesh.h"
#include "models/pillar/analyses/pressed_modes.h"
#include "models/pillar/body/stress_energy.h"
#include "models/pillar/time/viscoelastic_pillar.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

const ModalDrive& drive_of_modes(const PillarScene& scene) {
  return std::get<ModalDrive>(scene.drive);
}

int modes_of_family(const PillarScene& scene, const PillarModel& model) {
  const int rigid = scene.fixed_bottom ? 0 : rigid_motion_count(model.options().motion);
  return std::min(drive_of_modes(scene).modes, model.system().size() - rigid);
}

// The body of modes with the moduli at their own complex frequencies (eq. 22b).
ViscoelasticSystem relaxing_body(const PillarScene& scene, const PillarModel& model,
                                 const PillarModel* axial) {
  ViscoelasticSystem body = viscoelastic_system(model, scene.pillar, /*with_mass=*/true);
  if (axial == nullptr) return body;
  const double pressure_Pa = drive_of_modes(scene).pressure_Pa;
  if (scene.nearby == nullptr) {
    body.elastic.coeffs() += stiffness_by_pressure(*axial, model, pressure_Pa).coeffs();
  } else {  // as stable as the nearby pillar
    body.elastic.coeffs() += pressure_Pa * stress_stiffness_per_Pa(*axial, model).coeffs();
  }
  return body;
}

// The modes of a body that relaxes. Their frequencies err as the square of their shapes, derivatives as
// the shapes themselves. Without shapes if that accuracy is out of reach.
std::vector<DampedShape> damped_shapes(const PillarScene& scene, const PillarModel& model,
                                       const PillarModel* axial) {
  constexpr double kSmall = 1e-13;  // of a frequency
  std::vector<DampedShape> shapes;
  try {
    for (const RelaxedMode& mode : relaxed_modes(model, relaxing_body(scene, model, axial),
                                                 modes_of_family(scene, model), kSmall)) {
      shapes.push_back({mode.s, mode.shape});
    }
  } catch (const std::runtime_error& error) {
    if (!is_refusal(error)) throw;
    return {};
  }
  return shapes;
}

// Adds the work of a stress to the squares of the frequencies; the shapes have unit mass norm.
void add_stress(const PillarModel& axial, const PillarModel& model, double pressure_Pa,
                std::vector<PillarMode>& modes) {
  const StressEnergy stress(axial);
  for (PillarMode& mode : modes) {
    const double omega_1_s = 2.0 * std::numbers::pi * mode.frequency_Hz;
    const double square_1_s2 =
        omega_1_s * omega_1_s + pressure_Pa * stress.per_Pa(model, mode.shape);
    mode.frequency_Hz = std::sqrt(std::max(square_1_s2, 0.0)) / (2.0 * std::numbers::pi);
  }
}

}  // namespace

std::vector<ModeFamily> mode_families(const PillarScene& scene) {
  if (scene.plane) {
    return {{"lateral", Motion::kPlaneAntisymmetric, 0},
            {"longitudinal", Motion::kPlaneSymmetric, 0}};
  }
  return {{"lateral", Motion::kLateral, 1},
          {"longitudinal", Motion::kLongitudinal, 0},
          {"torsion", Motion::kTorsion, 0},
          {"ovalling", Motion::kOvalling, 2}};
}

std::vector<PillarMode> family_modes(const PillarScene& scene, const PillarModel& model,
                                     const PillarModel* axial) {
  const int wanted = modes_of_family(scene, model);
  if (const NearbyPillar* nearby = nearby_of(scene, model.options().motion, false)) {
    std::vector<PillarMode> modes = modes_nearby(model, nearby->modes(), wanted);
    if (axial != nullptr) add_stress(*axial, model, drive_of_modes(scene).pressure_Pa, modes);
    return modes;
  }
  return axial != nullptr
             ? modes_under_pressure(*axial, model, drive_of_modes(scene).pressure_Pa, wanted)
             : lowest_modes(model, wanted);
}

std::vector<RelaxedMode> family_relaxed_modes(const PillarScene& scene, const PillarModel& model,
                                              const PillarModel* axial) {
  ViscoelasticSystem body = relaxing_body(scene, model, axial);
  const int wanted = modes_of_family(scene, model);
  if (const NearbyPillar* nearby = nearby_of(scene, model.options().motion, false)) {
    if (std::ssize(nearby->damped()) != wanted) throw NotNearby("there are other modes");
    std::vector<RelaxedMode> modes;
    for (const DampedShape& one : nearby->damped()) {
      modes.push_back(one.s == 0.0 ? RelaxedMode{} : relaxed_mode_nearby(body, one.s, one.shape));
    }
    return modes;
  }
  const double small = 0.03 * scene.tolerance;  // error from the modes that the basis leaves out
  return relaxed_modes(model, std::move(body), wanted, small);
}

NearbyPillars modal_nearby(const PillarScene& scene, const Discretisation& given) {
  NearbyPillars nearby;
  const Discretisation mesh = modal_mesh(scene, given).mesh;
  const PillarModel* axial = nullptr;
  if (is_pressed(scene)) {
    nearby.push_back(nearby_pressed_model(scene, mesh));
    axial = &nearby.back()->model();
  }
  for (const ModeFamily& family : mode_families(scene)) {
    nearby.push_back(nearby_model_of(scene, family.motion, mesh));
    NearbyPillar& one = *nearby.back();
    const int wanted = modes_of_family(scene, one.model());
    if (!scene.pillar.terms.empty()) {
      one.keep_damped(damped_shapes(scene, one.model(), axial));
      if (one.damped().empty()) return {};
    } else if (axial != nullptr) {
      one.find_modes(wanted,
                     stiffness_by_pressure(*axial, one.model(), drive_of_modes(scene).pressure_Pa));
    } else {
      one.find_modes(wanted);
    }
  }
  return nearby;
}

}  // namespace viscard
