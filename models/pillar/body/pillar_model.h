#pragma once

#include "models/pillar/mesh/pillar_mesh.h"
#include "models/pillar/system/discrete_system.h"
#include "models/pillar/system/medium.h"
#include "models/pillar/system/stiffness_factor.h"

#include <memory>
#include <optional>
#include <vector>

namespace viscard {

// Penalty of the augmented Lagrangian at nu = 0.5, over the shear modulus. It determines the number
// of iterations, not the solution. Larger values would add the rounding errors of nearly rigid
// motions to the solution.
constexpr double kPenaltyOverShear = 10.0;

enum class PlaneState { kStrain, kStress };  // of the plane motions

// Faces of the film: z = -thickness (bottom) and z = 0 (top).
enum class FilmFace { kBottom, kTop };

// The film's potential: one whole face is grounded. The other face has a disc (half-width in the
// plane) as an electrode, or no electrode; then the potential is read at the points of interest.
struct ElectrodeOptions {
  FilmFace grounded = FilmFace::kTop;
  double electrode_radius_m = 0.0;  // 0: charge-free face
  bool quadrants = false;           // cut along x and y: detects sideways loads (piezo_quadrants.h)
};

struct ModelOptions {
  Motion motion = Motion::kLongitudinal;
  PlaneState plane = PlaneState::kStrain;
  bool fixed_bottom = true;
  // A free bottom in statics, under loads that balance themselves. Motion is relative to the middle
  // of the bottom and, sideways, also to its rim, which stays level; see rigid_motion.h.
  bool pin_bottom = false;
  // A rigid plate without friction on the top. It ties the axial displacement; under sideways
  // motion the plate keeps the top upright and lets it slide.
  bool rigid_top = false;
  std::optional<ElectrodeOptions> electrodes;  // present: the film's potential is unknown too
  double condense_pressures_from = kNearlyIncompressible;  // Poisson ratio; always at 0.5
};

struct PillarMedia {
  Medium pillar;
  std::optional<Medium> film;  // present exactly when the geometry has a film
};

// Unknowns of a static solution. Below nu = 0.5 the displacement itself determines the pressure.
struct PillarState {
  Eigen::VectorXd unknowns;
  Eigen::VectorXd pressure_source;  // its projected divergence gives the pressure, StiffnessFactor
};

// Mesh, unknowns and matrices of one pillar in one family of motion. Cannot be moved or copied.
class PillarModel {
 public:
  // Throws std::invalid_argument for a bad geometry, a film without a medium or a medium without a
  // film, or a rigid top or electrodes in a family that does not support them (torsion, ovalling).
  PillarModel(const PillarGeometry& geometry, const Discretisation& discretisation,
              const PillarMedia& media, const ModelOptions& options);
  PillarModel(const PillarModel&) = delete;
  PillarModel& operator=(const PillarModel&) = delete;

  const PillarMesh& mesh() const { return mesh_; }
  const DiscreteSystem& system() const { return *system_; }
  const Medium& medium(int region) const { return media_[static_cast<std::size_t>(region)]; }
  const ModelOptions& options() const { return options_; }
  double radius_m() const { return 0.5 * geometry_.diameter_m; }
  const PillarGeometry& geometry() const { return geometry_; }

  // Stiffness. The pressures of media with nu >= 0.45 are condensed. At nu = 0.5 the bulk part is a
  // penalty; the iteration that factor() sets up removes its error.
  SymmetricSparse stiffness() const;
  SymmetricSparse mass() const;
  // Factors a matrix of this model (its stiffness plus terms that the caller added).
  void factor(const SymmetricSparse& matrix, StiffnessFactor& factor) const;

  // Force per unit pressure pulling along +z on the top; axial families only. N per Pa.
  Eigen::VectorXd top_traction() const;
  int electrode_dof() const;  // -1: none
  double potential_scale_V() const { return potential_scale_V_; }

  // Solution under the given forces, including the source of the pressures.
  PillarState solve(const Eigen::VectorXd& forces) const;

  // Stress (Voigt, Pa) at a point of an element, from condensed pressures if they are condensed.
  Eigen::VectorXd stress_at(const PillarState& state, const SectionElement& element, double x,
                            double z) const;
  // Mean of one stress component over the disc x <= radius at height z, evaluated in `region`.
  double mean_stress(const PillarState& state, int component, double z, int region,
                     double radius_m) const;
  const SectionElement& element_at(double x, double z, int region) const;

 private:
  DofMap make_dofs(const Kinematics& kinematics);
  bool condenses_pressure(const Medium& medium) const;
  Eigen::MatrixXd elastic_form(const Medium& medium) const;

  PillarGeometry geometry_;
  ModelOptions options_;
  PillarMesh mesh_;
  std::vector<Medium> media_;
  double potential_scale_V_ = 1.0;
  int electrode_handle_ = -1;
  std::unique_ptr<DiscreteSystem> system_;
};

}  // namespace viscard
