#pragma once

#include "models/answer/scene_common.h"
#include "models/hyperelastic/hyperelastic_law.h"
#include "models/pillar/body/nearby_pillar.h"
#include "models/pillar/body/piezo_static.h"
#include "models/pillar/scene/pillar_drives.h"
#include "models/pillar/time/readout.h"

#include <memory>
#include <optional>
#include <vector>

namespace viscard {

// One pillar, its drive, and the accuracy of the answer.
struct PillarScene : SceneCommon {
  PillarGeometry geometry;
  std::optional<Medium> film;
  // The film with its directions, if it has any and they count; film is then its mean over them.
  std::optional<Medium> directional_film;
  std::optional<ElectrodeOptions> electrodes;
  PiezoMatrix film_charge_C_N = PiezoMatrix::Zero();
  std::optional<PlaneState> plane;  // a strip 1 m thick instead of a cylinder
  // The bottom of the film, or of the pillar without a film. A free body reports its elastic modes,
  // no rigid motions, and how a voltage moves the top relative to the middle of the bottom.
  bool fixed_bottom = true;
  std::optional<Readout> readout;  // the circuit on the electrode; none: open

  // The pillar's law at large strain; none: linear. Its modulus at rest is that of the material.
  std::optional<HyperelasticLaw> rubber;

  PillarDrive drive;
  std::optional<Discretisation> discretisation;  // finest mesh; none: the tolerance decides

  // Set by the plan (models/scene/plan.h) for effects that are left out or forced on:
  double condense_pressures_from = kNearlyIncompressible;  // Poisson ratio
  bool small_strain = false;       // a pillar of rubber is answered as a linear one
  bool one_way_potential = false;  // the film's potential follows its strain and does not act back

  // Set for answers to first order (first_order_answers() of analyses/simulate_pillar.h).
  std::shared_ptr<const NearbyPillars> nearby;

  static constexpr const char* kKind = "pillar";  // geometry.kind in a scene file
  static constexpr ToleranceRange kTolerances{1e-9, "1e-9 and 1"};
};

// Parts of the drive; zero, empty or the default if the drive has no such part.
LoadPlace load_place(const PillarScene& scene);
bool is_lateral(const PillarScene& scene);
double pressure_Pa(const PillarScene& scene);  // at rest or amplitude; lateral: shear
std::optional<double> displacement_m(const PillarScene& scene);
bool moves_top(const PillarScene& scene);        // by a given displacement
bool reads_quadrants(const PillarScene& scene);  // sideways, with an electrode in quadrants
double base_acceleration_m_s2(const PillarScene& scene);
double drive_V(const PillarScene& scene);
bool plate_on_top(const PillarScene& scene);
bool has_history(const PillarScene& scene);
const Course& history(const PillarScene& scene);

// The slowest that the load changes: its lowest frequency, or once over its duration; 0: it is at rest.
double slowest_rad_s(const PillarScene& scene);

// Height of the film's face that is not grounded; only with electrodes.
double free_face_m(const PillarScene& scene);

}  // namespace viscard
