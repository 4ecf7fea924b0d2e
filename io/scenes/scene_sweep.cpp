#include "io/scenes/scene_file.h"

#include <fmt/format.h>

namespace viscard {

std::vector<SweepPoint> points_of(const ArrayScene& scene, const ArraySweep& sweep) {
  const ArrayGeometry& own = scene.geometry;
  const auto values = [](const std::vector<double>& list, double single) {
    return list.empty() ? std::vector<double>{single} : list;
  };
  std::vector<SweepPoint> points;
  for (const double diameter_m : values(sweep.diameter_m, own.diameter_m)) {
    for (const double thickness_m : values(sweep.thickness_m, own.film_thickness_m)) {
      for (const double spacing_m : values(sweep.spacing_m, own.spacing_m)) {
        SweepPoint point{scene, ""};
        ArrayGeometry& g = point.scene.geometry;
        g.diameter_m = diameter_m;
        g.film_thickness_m = thickness_m;
        g.spacing_m = spacing_m;
        if (sweep.length_over_diameter > 0.0) g.length_m = sweep.length_over_diameter * diameter_m;
        const auto name = [&](const char* what, const std::vector<double>& list, double value_m) {
          if (list.empty()) return;
          point.label +=
              fmt::format("{}{} {:.6g} um", point.label.empty() ? "" : ", ", what, value_m * 1e6);
        };
        name("diameter", sweep.diameter_m, diameter_m);
        name("thickness", sweep.thickness_m, thickness_m);
        name("spacing", sweep.spacing_m, spacing_m);
        points.push_back(std::move(point));
      }
    }
  }
  return points;
}

}  // namespace viscard
