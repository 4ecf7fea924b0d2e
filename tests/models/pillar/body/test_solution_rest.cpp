// What the highest polynomials of a solution say of its error, beside the true error.
#include "models/answer/error_control.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/solution_rest.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>
#include <vector>

using namespace viscard;

namespace {

struct Deflection {
  double per_Pa_m = 0.0;
  double missing = 0.0;  // relative
};

Deflection deflection(double nu, const Discretisation& mesh) {
  const PillarModel model(PillarGeometry{}, mesh, {isotropic_medium(1.8e6, nu, 965.0), {}}, {});
  const Eigen::VectorXd traction = model.top_traction();
  const Eigen::VectorXd u = model.solve(traction).unknowns;
  const SolutionRest rest(model, u);
  const double work = traction.dot(u);
  return {work / traction.sum(), missing_share(rest, rest, work)};
}

}  // namespace

TEST_CASE("the rest of a solution is its true error, with layers at the rim and without",
          "[pillar][convergence]") {
  const double nu = GENERATE(0.33, 0.49);
  const Discretisation mesh =
      GENERATE(Discretisation{.degree = 6, .layers = 1}, Discretisation{.degree = 8, .layers = 1},
               Discretisation{.degree = 6, .layers = 3}, Discretisation{.degree = 8, .layers = 4});
  CAPTURE(nu, mesh.degree, mesh.layers);
  const double fine_m = deflection(nu, {.degree = 12, .layers = 7}).per_Pa_m;
  const Deflection coarse = deflection(nu, mesh);
  const double truth = std::abs(coarse.per_Pa_m / fine_m - 1.0);
  CAPTURE(truth, coarse.missing);
  CHECK(coarse.missing > 0.6 * truth);
  // With condensed pressures the errors of displacement and pressure cancel in the deflection.
  if (nu < kNearlyIncompressible) CHECK(coarse.missing < 4.0 * truth);
}

TEST_CASE("a smooth solution has no rest", "[pillar]") {
  CHECK(deflection(0.0, {.degree = 6, .layers = 1}).missing < 1e-12);
}

TEST_CASE("an estimate contains what the solution lacks, although two meshes agree",
          "[pillar][error]") {
  ErrorControl control{2e-2, std::vector<Discretisation>(4), {}};
  const MeshAnswer same = [](const Discretisation& mesh) {
    SceneAnswer answer;
    answer.discretisation = mesh;
    answer.results = {{"voltage", 3.0, "V"}};
    answer.results.front().unresolved = 1e-2;
    return answer;
  };
  CHECK(answer_within(control, same).results.front().error_estimate == Approx(3e-2));
  control.tolerance = 5e-3;
  CHECK_THROWS_AS(answer_within(control, same), std::runtime_error);
}
