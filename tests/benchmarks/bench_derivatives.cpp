// Times derivatives of a sensor by all its quantities, from the solver and as differences of whole answers.
//   bench_derivatives SCENE.toml
// SCENE.toml has quantities with +-. Prints processor times on one thread, on the scene's own mesh and on
// the finest one: of a whole answer, of the solution that is reused, of an answer that reuses it, and of the
// derivatives by all inputs with four answers for each, which is what an extrapolation needs at least.
#include "io/basics/atomic_file.h"
#include "io/flow/scenes/uncertain_scene.h"
#include "models/scene/simulate.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace viscard;

double since_s(std::clock_t begin) {
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// Four points for each deviate.
std::vector<Eigen::VectorXd> points_of(const UncertainScene& scene) {
  const Eigen::Index n = count_deviates(scene.inputs());
  std::vector<Eigen::VectorXd> points;
  for (Eigen::Index d = 0; d < n; ++d) {
    for (const double step : {0.25, -0.25, 0.125, -0.125}) {
      points.push_back(step * Eigen::VectorXd::Unit(n, d));
    }
  }
  return points;
}

void time_on(const UncertainScene& scene, const Discretisation& mesh) {
  const std::vector<Eigen::VectorXd> points = points_of(scene);
  const Eigen::VectorXd nominal = Eigen::VectorXd::Zero(count_deviates(scene.inputs()));
  const SceneAnswer answer = answer_on(scene.reduced_at(nominal), mesh);
  std::clock_t begin = std::clock();
  for (const Eigen::VectorXd& point : points) answer_on(scene.reduced_at(point), mesh);
  const double whole_s = since_s(begin);
  begin = std::clock();
  const auto first_order = first_order_answers(scene.reduced_at(nominal), mesh);
  if (!first_order) throw std::runtime_error("the scene has no first-order answers");
  const double solution_s = since_s(begin);
  std::size_t taken = 0;
  for (const Eigen::VectorXd& point : points) {
    if (first_order(scene.reduced_at(point))) ++taken;
  }
  const double solver_s = since_s(begin);
  const auto n = static_cast<double>(points.size());
  fmt::print(
      "degree {}, {} layers, {} unknowns: derivatives by {} inputs in {:.3f} s from the solver "
      "({} of {} answers reuse the solution), {:.3f} s as differences: {:.1f} times\n"
      "  a whole answer {:.2f} ms, the solution {:.2f} ms, an answer that reuses it {:.2f} ms\n",
      mesh.degree, mesh.layers, answer.unknowns, scene.inputs().size(), solver_s, taken,
      points.size(), whole_s, whole_s / solver_s, 1e3 * whole_s / n, 1e3 * solution_s,
      1e3 * (solver_s - solution_s) / n);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: bench_derivatives SCENE.toml");
  const std::string path = argv[1];
  const SceneFile file = read_scene(path);
  const UncertainScene scene(file, read_file(path), path);
  time_on(scene, simulate(file.scene).discretisation);
  time_on(scene, {.degree = 10, .layers = 5});
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_derivatives: {}\n", error.what());
  return 1;
}
