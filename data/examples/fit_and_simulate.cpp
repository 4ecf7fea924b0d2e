// Fits a table, keeps the material, and lets a pillar of it creep under 10 kPa.
#include "io/basics/atomic_file.h"
#include "io/flow/fit_file.h"
#include "io/materials/material_file.h"
#include "io/scenes/scene_file.h"
#include "models/scene/simulate.h"

#include <cstdio>
#include <stdexcept>

int main(int argc, char** argv) try {
  if (argc != 2) throw std::invalid_argument("usage: fit_and_simulate TABLE.csv");
  const viscard::FittedFile fitted = viscard::fit_file(argv[1], {});
  std::printf("E0 = %.4g MPa in %zu terms\n", fitted.result.E0_Pa / 1e6,
              fitted.result.terms.size());
  const viscard::Material material = viscard::material_from_fitted(fitted, {.nu = 0.495});
  viscard::write_file("material.json", viscard::json_from_material(material), /*overwrite=*/true);

  const char* scene = R"(tolerance = 1e-3
      geometry = { diameter = "40 um", length = "120 um" }
      materials = { pillar = { file = "material.json" } }
      analysis = { kind = "creep", history = [["0 s", "10 kPa"], ["10 s", "10 kPa"]] })";
  const auto answer = viscard::simulate(viscard::scene_from_toml(scene, "creep.toml").scene);
  for (const viscard::SceneResult& result : answer.results) {
    std::printf("%s = %.5g +- %.1g %s\n", result.name.c_str(), result.value, result.error_estimate,
                result.unit.c_str());
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
