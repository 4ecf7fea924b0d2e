// Meshes that are taken until the estimate of an error is within the tolerance.
#include "models/answer/error_control.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

using namespace viscard;

namespace {

// An answer of one number whose value on the i-th mesh is the i-th of the list.
SceneAnswer answer_of(const std::vector<double>& values, const std::vector<int>& layers,
                      double tolerance, double share_left) {
  ErrorControl control{.tolerance = tolerance, .share_left = share_left};
  for (std::size_t i = 0; i < values.size(); ++i) {
    control.meshes.push_back({.degree = static_cast<int>(i), .layers = layers[i]});
  }
  return answer_within(control, [&](const Discretisation& mesh) {
    SceneAnswer answer;
    answer.discretisation = mesh;
    answer.results.push_back({"value", values[static_cast<std::size_t>(mesh.degree)], "1"});
    return answer;
  });
}

}  // namespace

TEST_CASE("a coarse first mesh does not stay in the estimate when every mesh gains a layer",
          "[pillar][plan]") {
  // The first lateral mode at 84 % of a buckling load. Each layer leaves a ninth of the error, and the
  // first mesh is wrong by 3 %: a share of 0.3 of 0.3 of ... of its change took one more mesh.
  const std::vector<double> values = {7656.730, 7469.628, 7448.589, 7446.335,
                                      7446.073, 7446.043, 7446.040};
  const SceneAnswer answer = answer_of(values, {1, 2, 3, 4, 5, 6, 7}, 1.91e-4, 0.3);
  CHECK(answer.discretisation.degree == 5);
  const SceneResult& result = answer.results.front();
  CHECK(std::abs(result.value - values.back()) < 0.1 * result.error_estimate);
}

TEST_CASE("two meshes that chance to agree do not hide a change before", "[pillar][plan]") {
  // A pillar of 1.5 diameters whose own buckling mixes with modes at the rim.
  const std::vector<double> values = {321767.7, 319212.0, 318974.3, 319046.4, 318904.5};
  const SceneAnswer answer = answer_of(values, {1, 2, 3, 4, 5}, 1e-3, 0.3);
  const SceneResult& result = answer.results.front();
  CHECK(std::abs(result.value - values.back()) < result.error_estimate);
}

TEST_CASE("a change without a new layer does not replace what is known of the rim",
          "[pillar][plan]") {
  // The layer takes 0.9 of the error of 0.01; a higher degree alone takes none of the rest.
  const std::vector<double> values = {1.01, 1.001, 1.001, 1.0001, 1.0001};
  const SceneAnswer answer = answer_of(values, {1, 2, 2, 3, 3}, 1e-3, 0.1);
  CHECK(answer.discretisation.degree == 3);
  CHECK(answer.results.front().error_estimate >= 0.89e-3);
}

TEST_CASE("a refusal for an error that no mesh reduces does not blame the mesh", "[pillar][plan]") {
  const auto refusal = [](double left_out, double change) {
    ErrorControl control{.tolerance = 1e-3, .share_left = 0.1};
    for (int i = 0; i < 3; ++i) control.meshes.push_back({.degree = i, .layers = i + 1});
    try {
      answer_within(control, [&](const Discretisation& mesh) {
        SceneAnswer answer;
        answer.discretisation = mesh;
        answer.results.push_back({"voltage", 1.0 + change * mesh.degree, "V"});
        answer.results.back().left_out = left_out;
        return answer;
      });
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal(4e-3, 0.0).find("of which no finer mesh reduces about 0.004") != std::string::npos);
  CHECK(refusal(1e-5, 0.1).find("of which") == std::string::npos);
  CHECK(refusal(1e-5, 0.1).find("the finest mesh (degree 2)") == 0);
}
