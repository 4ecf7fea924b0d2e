#pragma once

#include "models/pillar/mesh/pillar_mesh.h"
#include "models/pillar/system/discrete_system.h"
#include "models/pillar/system/medium.h"
#include "models/pillar/system/stiffness_factor.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

namespace viscard {

// Penalty of the augmented Lagrangian at nu = 0.5, over the shear modulus. It sets the number of
// iterations, not the solution. Larger values would add rounding errors of nearly rigid motions.
constexpr double kPenaltyOverShear = 10.0;

// Strain or stress that is zero across a strip.
enum class PlaneState { kStrain, kStress };  // of the plane motions

// Faces of the film: z = -thickness (bottom) and z = 0 (top).
enum class FilmFace { kBottom, kTop };

// The film's potential: one whole face is grounded. The other face has a disc (half-width in the
// plane) as an electrode, or carries no charge and its potential is read.
struct ElectrodeOptions {
  FilmFace grounded = FilmFace::kTop;
  double electrode_radius_m = 0.0;  // 0: charge-free face
  bool quadrants = false;           // cut along x and y: detects sideways loads (piezo_static.h)
};

// The film's mesh with the edge of its electrode, if there is one.
PillarGeometry with_electrode_edge(PillarGeometry geometry,
                                   const std::optional<ElectrodeOptions>& electrodes);

// Which motion of the pillar is computed, and how it is held.
struct ModelOptions {
  Motion motion = Motion::kLongitudinal;
  PlaneState plane = PlaneState::kStrain;
  bool fixed_bottom = true;
  // A free bottom in statics, under loads that balance themselves. Motion is relative to the middle
  // of the bottom and, sideways, also to its rim, which stays level; see rigid_pins().
  bool pin_bottom = false;
  // A fixed bottom without friction: held along the axis, free to slide. Axial families only.
  bool bottom_slides = false;
  // A rigid plate without friction on the top. It ties the axial displacement; under sideways
  // motion the plate keeps the top upright and lets it slide.
  bool rigid_top = false;
  std::optional<ElectrodeOptions> electrodes;  // present: the film's potential is unknown too
  double condense_pressures_from = kNearlyIncompressible;  // Poisson ratio; always at 0.5
};

// The media of a pillar and its film.
struct PillarMedia {
  Medium pillar;
  std::optional<Medium> film;  // present exactly when the geometry has a film
};

// Unknowns of a static solution. Below nu = 0.5 the displacement itself determines the pressure.
struct PillarState {
  Eigen::VectorXd unknowns;
  Eigen::VectorXd pressure_source;  // its projected divergence gives the pressure, StiffnessFactor
  double heat = 0.0;  // share of the free strains of the media that the state contains
};

// The state times a pure number, the factor.
PillarState operator*(double factor, PillarState state);
PillarState operator+(PillarState one, const PillarState& other);

// Thrown for a pillar that cannot be answered to first order from a nearby one.
class NotNearby : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Mesh, unknowns and matrices of one pillar in one family of motion. Cannot be moved or copied.
class PillarModel {
 public:
  // Throws std::invalid_argument for a bad geometry, a film without a medium or a medium without a
  // film, or a rigid top or electrodes in a family that does not support them (torsion, ovalling).
  PillarModel(const PillarGeometry& geometry, const Discretisation& discretisation,
              const PillarMedia& media, const ModelOptions& options);
  // The same with solutions to first order from the given ones of `nearby`, unless it is null. Both must
  // outlive the model. Throws NotNearby if the mesh does not have the same elements, if a
  // pressure is condensed in only one of them, and at nu = 0.5 for other lengths.
  PillarModel(const PillarGeometry& geometry, const Discretisation& discretisation,
              const PillarMedia& media, const ModelOptions& options, const PillarModel* nearby,
              const NearbySolutions* solutions);
  PillarModel(const PillarModel&) = delete;
  PillarModel& operator=(const PillarModel&) = delete;

  const PillarMesh& mesh() const { return mesh_; }
  const DiscreteSystem& system() const { return *system_; }
  // Medium of a region of the section.
  const Medium& medium(int region) const { return media_[static_cast<std::size_t>(region)]; }
  const ModelOptions& options() const { return options_; }
  double radius_m() const { return 0.5 * geometry_.diameter_m; }
  const PillarGeometry& geometry() const { return geometry_; }

  // Stiffness. The pressures of media with nu >= 0.45 are condensed. At nu = 0.5 the bulk part is a
  // penalty; the iteration that factor() sets up removes its error.
  SymmetricSparse stiffness() const;
  SymmetricSparse stiffness_of(int region) const;  // the part of one region
  SymmetricSparse mass() const;
  // Factors a matrix of this model (its stiffness plus terms that the caller added). At nu = 0.5
  // `stiffening` multiplies the penalty; the solutions stay the same, up to rounding.
  void factor(const SymmetricSparse& matrix, StiffnessFactor& factor,
              double stiffening = 1.0) const;
  // The factored stiffness, or what stands for it close to a nearby pillar.
  StiffnessFactor factored() const;
  const PillarModel* nearby() const { return nearby_; }
  // Whether rounding of the matrix's entries counts beside the energy of bending, which falls as the square
  // of the slenderness, or beside that of the shear of a nearly incompressible body.
  bool loses_digits() const;
  // Stiffness times u without the matrix; at nu = 0.5 the pressures are those of the source.
  Eigen::VectorXd stiffness_times(const Eigen::VectorXd& u, const Eigen::VectorXd& source) const;
  // Mass times u without the matrix, kg times the unit of u.
  Eigen::VectorXd mass_times(const Eigen::VectorXd& u) const;

  // Force per unit pressure pulling along +z on the top; axial families only. N per Pa.
  Eigen::VectorXd top_traction() const;
  double mean_top_displacement_m(const PillarState& state) const;  // axial families only
  int electrode_dof() const;                                       // -1: none
  double potential_scale_V() const { return potential_scale_V_; }
  bool is_plane_stress() const;

  // Solution under the given forces, including the source of the pressures.
  PillarState solve(const Eigen::VectorXd& forces) const;

  // Stress (Voigt, Pa) at a point of an element, from condensed pressures if they are condensed.
  Eigen::VectorXd stress_at(const PillarState& state, const SectionElement& element, double x,
                            double z) const;
  // Mean of one stress component over the disc x <= radius at height z, evaluated in `region`.
  double mean_stress(const PillarState& state, int component, double z, int region,
                     double radius_m) const;
  // The element of a region that contains the point.
  const SectionElement& element_at(double x, double z, int region) const;
  // Mean of the moduli of the six strains as they enter the stiffness, without condensed pressures.
  double mean_modulus_Pa(int region) const;

 private:
  DofMap make_dofs(const Kinematics& kinematics);
  void require_nearby(const DofMap& dofs) const;
  bool condenses_pressure(const Medium& medium) const;
  double condensed_bulk_Pa(const Medium& medium) const;  // or its penalty; 0: not condensed
  SymmetricSparse stiffness_of(const std::vector<int>& regions) const;
  // Forms and condensed bulk moduli of regions, which make the stiffness.
  struct StiffnessParts {
    std::vector<Eigen::MatrixXd> forms;
    std::vector<double> bulk_Pa;
    bool condenses() const;
  };
  std::vector<Eigen::MatrixXd> mass_forms() const;
  StiffnessParts stiffness_parts(const std::vector<int>& regions) const;
  std::vector<int> all_regions() const;
  Eigen::MatrixXd elastic_form(const Medium& medium) const;

  PillarGeometry geometry_;
  ModelOptions options_;
  PillarMesh mesh_;
  std::vector<Medium> media_;
  double potential_scale_V_ = 1.0;
  int electrode_handle_ = -1;
  const PillarModel* nearby_ = nullptr;
  const NearbySolutions* nearby_solutions_ = nullptr;
  std::unique_ptr<DiscreteSystem> system_;
};

// Loads along the direction in which a family of motion moves the whole pillar: along its axis for
// axial families, sideways (x) for lateral ones. For a strip, forces are per metre of thickness.

// Area of the top, m^2; of a strip per metre, m.
double top_area_m2(const PillarModel& model);

// A pull of 1 N evenly over the top, so that load.u is the top's mean displacement, m. Throws
// std::invalid_argument for torsion and harmonics above 1, which do not move the whole pillar.
Eigen::VectorXd unit_top_force(const PillarModel& model);

// Inertial force of an acceleration of 1 m/s^2 of the whole body, in N. If the bottom is shaken,
// the motion relative to it is that of a body under minus this force times the acceleration. It
// also gives the participating mass: for a rigid motion of 1 m, load.u is the mass in kg.
Eigen::VectorXd unit_acceleration_force(const PillarModel& model);

// Number of rigid motions of an unsupported body within one family of motion: along its axis
// (longitudinal), about it (torsion), sideways and rocking (lateral), none (ovalling).
int rigid_motion_count(Motion motion);

// Forces by which the free strains and polarisations of the media (medium.h) move the body,
//   int S(v)^t c free_strain - E(v)^t (e free_strain - free_polarisation).
// Axial families only. The solution is a state with heat = 1. Throws std::invalid_argument for an incompressible
// medium with a free strain: its stress is not bounded. Source: Nye, Physical Properties of Crystals (1957), 10.
Eigen::VectorXd heat_force(const PillarModel& model);

// The rigid motions of a model whose bottom is free, as columns of its unknowns: 1 m along z or x,
// and 1 rad about the middle of the bottom. Meshes of degree 2 and more contain them exactly.
Eigen::MatrixXd rigid_motions(const PillarModel& model);

// One held unknown per rigid motion (a field at the middle or at the rim of the bottom), so that
// the statics of a free body under loads that balance themselves have a unique solution.
struct RigidPin {
  int field = 0;
  bool at_rim = false;
};
std::vector<RigidPin> rigid_pins(Motion motion);

}  // namespace viscard
