#pragma once

#include "fit/large_strain/large_strain_rows.h"
#include "models/hyperelastic/mullins_damage.h"

#include <limits>
#include <optional>

namespace viscard {

// Damage beside a law, and which of its constants were fitted; the others are held.
struct FoundDamage {
  MullinsDamage constants;  // m in the unit of the rows' stress
  bool fits_m = true, fits_beta = true;
  bool has_one_maximum = false;  // so that beta is held at 0
};

// Parameters of a form in units of the rows' stress, with what the least squares left.
struct HyperelasticPoint {
  Eigen::VectorXd moduli, shapes;
  std::vector<RubberTerm> terms;  // of relaxation, by ascending time; empty: elastic
  std::optional<FoundDamage> damage = std::nullopt;
  double rss = std::numeric_limits<double>::infinity();  // weighted, with the row of the modulus
  bool is_converged = false;
};

// True if a modulus of this form must not be negative: Ogden's terms, and forms of one modulus.
// mooney-rivlin and yeoh often need a negative one; their stability is checked afterwards.
bool is_sign_free(HyperelasticForm form);

// Bounds of a shape (alpha, locking stretch, J_m) for these data.
struct ShapeBounds {
  double low = 0.0, high = 0.0;
};
ShapeBounds shape_bounds(HyperelasticForm form, const LargeStrainRows& rows);

// kOfForm: as is_sign_free() says; kAny: to see what that costs.
enum class ModulusSigns { kOfForm, kAny };

// Best moduli at given shapes, by least squares with signs.
HyperelasticPoint at_shapes(HyperelasticForm form, const LargeStrainRows& rows,
                            const Eigen::VectorXd& shapes,
                            ModulusSigns signs = ModulusSigns::kOfForm);

// The best least squares found: the moduli are solved on a grid of shapes, and the best few points
// are refined in all parameters within their bounds (trust region of Ceres).
HyperelasticPoint best_point(HyperelasticForm form, const LargeStrainRows& rows,
                             ModulusSigns signs = ModulusSigns::kOfForm);

// Derivative of the rows' model by moduli and shapes.
Eigen::MatrixXd jacobian(HyperelasticForm form, const LargeStrainRows& rows,
                         const HyperelasticPoint& point);

}  // namespace viscard
