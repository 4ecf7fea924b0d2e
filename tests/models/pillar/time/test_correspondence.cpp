// The elastic-viscoelastic correspondence on bodies with closed-form moduli.
#include "models/material/material.h"
#include "models/pillar/time/viscoelastic_exact.h"
#include "models/pillar/time/viscoelastic_pillar.h"
#include "tests/models/pillar/system/small_body.h"
#include "tests/support/printed_digits.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kShare = 0.022066;  // g of the one term
constexpr double kTime_s = 2.0;

// One relaxing shear term at constant bulk modulus, E 1.8 MPa, nu 0.33.
Material one_term() {
  Material material;
  material.E0_Pa = 1.8e6;
  material.nu = 0.33;
  material.terms = {{kShare, 0.0, kTime_s}};
  return material;
}

// A bar of radius 1 and length 3 pressed on its top, free or confined sideways; force over area and
// strain is its modulus.
struct Bar {
  explicit Bar(bool is_confined)
      : body(kinematics_of(Motion::kLongitudinal), {0, 0.5, 1}, {0, 1, 3}, 3) {
    if (is_confined) body.hold(0, everywhere());
    if (!is_confined) body.hold(0, x_is(0.0));
    body.hold(1, z_is(0.0));
    const int plate = body.tie(1, z_is(3.0));
    body.done();
    const Medium medium = isotropic_medium(1.8e6, 0.33, 965.0);
    system.shear = body.stiffness(medium.shear_Pa * deviatoric_form());
    system.bulk = body.stiffness(medium.bulk_Pa * volumetric_form());
    system.elastic = body.system().zero();
    system.terms = one_term().terms;
    system.load = Eigen::VectorXd::Zero(body.system().size());
    system.load[body.tied_dof(plate)] = 1.0;
  }
  double modulus_Pa(double force_N) const { return force_N * 3.0 / std::numbers::pi; }
  SmallBody body;
  ViscoelasticSystem system;
};

}  // namespace

TEST_CASE("a confined bar relaxes from M_0 to M_inf at constant bulk modulus", "[pillar]") {
  // M = K + 4 G/3: only its shear part relaxes.
  const Bar bar(true);
  ViscoelasticStepper stepper(bar.system);
  stepper.advance(0.0, Control::kDisplacement, 1.0);
  CHECK(bar.modulus_Pa(stepper.force()) == printed("2.6669615e6"));
  for (int i = 0; i < 5; ++i) stepper.advance(10.0 * kTime_s, Control::kDisplacement, 1.0);
  CHECK(bar.modulus_Pa(stepper.force()) == printed("2.6470524e6", 1.0, 0.52));
}

TEST_CASE("a free bar of one shear term relaxes with its time stretched", "[pillar]") {
  // E = 9 K G/(3 K + G) is again one term: tau_E/tau = (3K + G_0)/(3K + G_inf) = 1.00250708,
  // E_inf/E_0 = 0.98038576. Tschoegl (1989), ch. 3, by partial fractions.
  const Bar bar(false);
  const ExactViscoelasticBody exact(bar.system);
  const double tau_s = 1.00250708 * kTime_s;
  const double time_s = GENERATE(0.1, 1.0, 5.0, 40.0);
  const double share = 1.0 - (1.0 - .98038576) * -std::expm1(-time_s / tau_s);
  CHECK(bar.modulus_Pa(exact.relaxation_force(time_s)) ==
        Approx(1.8e6 * share).epsilon(2e-8));  // printed digits
  // The time steps agree within their order.
  ViscoelasticStepper stepper(bar.system, 3);
  stepper.advance(0.0, Control::kDisplacement, 1.0);
  for (int i = 0; i < 50; ++i) stepper.advance(time_s / 50, Control::kDisplacement, 1.0);
  CHECK(bar.modulus_Pa(stepper.force()) == Approx(1.8e6 * share).epsilon(1e-6));
}
