#include "models/array/layer/layer_window.h"

#include "models/answer/scene_mistake.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kFirstStep = 1e-3;  // of the search for a force, over the indentation
constexpr double kGrowth = 1.4;      // of a window whose rim is touched

// The square that the shape can touch at all.
LayerGrid bounds_of(const LayerScene& scene) {
  if (scene.width_m > 0.0) return {0.0, 0.0, scene.width_m, 0};
  const RigidShape& shape = scene.press.shape;
  if (shape.kind != ShapeKind::kTable) return {shape.x_m, shape.y_m, kEndless, 0};
  const HeightTable& table = shape.table;
  const double along_x_m = table.x_m.back() - table.x_m.front();
  const double along_y_m = scene.is_plane() ? 0.0 : table.y_m.back() - table.y_m.front();
  return {shape.x_m + 0.5 * (table.x_m.front() + table.x_m.back()),
          shape.y_m + 0.5 * (table.y_m.front() + table.y_m.back()), std::max(along_x_m, along_y_m),
          0};
}

// Half of a square around the point `at` that contains all overlap; endless if nothing bounds it.
double overlap_reach_m(const RigidShape& shape, double depth_m) {
  const double tilt = std::hypot(shape.tilt_x, shape.tilt_y);
  const double R_m = shape.radius_m;
  switch (shape.kind) {
    case ShapeKind::kCylinder:
    case ShapeKind::kSphere:
      return std::min(R_m, std::sqrt(2.0 * R_m * depth_m) + 2.0 * R_m * tilt);
    case ShapeKind::kParaboloid:
      return std::sqrt(2.0 * R_m * depth_m) + 2.0 * R_m * tilt;
    case ShapeKind::kWedge:
      return tilt < shape.slope ? depth_m / (shape.slope - tilt) : kEndless;
    default:
      return kEndless;
  }
}

// Lower bound of the height of the shape's lowest point above the point `at`.
double lowest_height_m(const RigidShape& shape, const LayerGrid& bounds) {
  if (!std::isfinite(bounds.width_m)) {
    return -shape.radius_m * std::hypot(shape.tilt_x, shape.tilt_y) *
           std::hypot(shape.tilt_x, shape.tilt_y);
  }
  return std::min(0.0, least_height_m(shape, bounds.x_m, bounds.y_m,
                                      0.5 * std::numbers::sqrt2 * bounds.width_m));
}

class WindowSearch {
 public:
  WindowSearch(const LayerScene& scene, const LayerWaves& waves)
      : scene_(&scene),
        waves_(&waves),
        bounds_(bounds_of(scene)),
        lowest_m_(lowest_height_m(scene.press.shape, bounds_)),
        count_(scene.is_plane() ? 256 : 32) {}

  LayerWindow at_depth(double depth_m) const {
    LayerGrid grid = bounds_;
    if (!scene_->feels_contact) {
      const LayerPressure all = solved(grid, depth_m);
      return {all.grid, depth_m, depth_m - lowest_m_, all.force_N};
    }
    const double reach_m = 2.2 * overlap_reach_m(scene_->press.shape, depth_m);
    if (reach_m < 0.8 * bounds_.width_m) {
      grid = {scene_->press.shape.x_m, scene_->press.shape.y_m, reach_m, 0};
    }
    constexpr int kMostSteps = 12;
    LayerPressure found = solved(grid, depth_m);
    for (int step = 0; step < kMostSteps; ++step) {
      const LayerGrid next = fitted(found);
      const bool is_same =
          next.width_m >= 0.8 * found.grid.width_m && next.width_m <= found.grid.width_m;
      if (is_same || found.force_N == 0.0) break;
      found = solved(next, depth_m);
    }
    return {found.grid, depth_m, depth_m - lowest_m_, found.force_N};
  }

  // A depth whose force is at least the wanted one, and at most about twice that.
  LayerWindow at_force(double force_N) const {
    double deep_m = 1e-3 * scene_->thickness_m;  // below the lowest point
    LayerWindow window = at_depth(lowest_m_ + deep_m);
    while (window.force_N < force_N) {
      if (deep_m >= scene_->thickness_m) {
        throw window.force_N == 0.0
            ? SceneMistake("shape",
                           "nothing of the layer lies under the shape; move it with shape.at")
            : SceneMistake("shape.force", "would press the layer flat; it is " +
                                              micrometres(scene_->thickness_m) + " thick");
      }
      deep_m *= 2.0;
      window = at_depth(lowest_m_ + deep_m);
    }
    while (window.force_N > 2.0 * force_N && deep_m > 1e-15 * scene_->thickness_m) {
      const LayerWindow less = at_depth(lowest_m_ + 0.5 * deep_m);
      if (less.force_N < force_N) break;
      deep_m *= 0.5;
      window = less;
    }
    // The depth of the force, in the window of a little more depth.
    const LayerContact coarse = contact(window.grid);
    const double found_m = coarse.with_force(force_N, window.depth_m, kFirstStep * deep_m).depth_m;
    return at_depth(found_m);
  }

 private:
  LayerContact contact(LayerGrid grid) const {
    grid.count = count_;
    if (grid.width_m > kWidestWindow * scene_->thickness_m) {
      throw SceneMistake("geometry.thickness",
                         "the shape touches " + micrometres(grid.width_m, 4) +
                             " of the layer, which is only " + micrometres(scene_->thickness_m) +
                             " thick; a layer is answered up to a hundred thicknesses, so press "
                             "less deep, or give a smaller geometry.width");
    }
    const LayerKernel kernel(*waves_, scene_->is_plane(), 1.5 * grid.width_m, {});
    return {kernel, press_of(*scene_), grid};
  }
  LayerPressure solved(const LayerGrid& grid, double depth_m) const {
    return contact(grid).to_depth(depth_m);
  }

  // The window around the touched cells, with two more cells on each side.
  LayerGrid fitted(const LayerPressure& found) const {
    if (found.touches_rim()) {
      LayerGrid grown = found.grid;
      grown.width_m *= kGrowth;
      return grown.width_m < bounds_.width_m ? grown : bounds_;
    }
    Eigen::Index first[2] = {found.grid.count, found.grid.count};
    Eigen::Index last[2] = {-1, -1};
    for (Eigen::Index j = 0; j < found.pressure_Pa.cols(); ++j) {
      for (Eigen::Index i = 0; i < found.pressure_Pa.rows(); ++i) {
        if (found.pressure_Pa(i, j) == 0.0) continue;
        const Eigen::Index at[2] = {i, j};
        for (int axis = 0; axis < 2; ++axis) {
          first[axis] = std::min(first[axis], at[axis]);
          last[axis] = std::max(last[axis], at[axis]);
        }
      }
    }
    const LayerGrid& grid = found.grid;
    const Eigen::Index along_y = scene_->is_plane() ? 0 : last[1] - first[1];
    const auto span = static_cast<double>(std::max(last[0] - first[0], along_y) + 5);
    LayerGrid next{0.5 * (grid.place_m(grid.x_m, first[0]) + grid.place_m(grid.x_m, last[0])),
                   grid.y_m, span * grid.cell_m(), 0};
    if (!scene_->is_plane()) {
      next.y_m = 0.5 * (grid.place_m(grid.y_m, first[1]) + grid.place_m(grid.y_m, last[1]));
    }
    return next;
  }

  const LayerScene* scene_;
  const LayerWaves* waves_;
  LayerGrid bounds_;
  double lowest_m_;
  int count_;
};

}  // namespace

LayerWindow layer_window(const LayerScene& scene, const LayerWaves& waves) {
  const WindowSearch search(scene, waves);
  return scene.press.force_N > 0.0 ? search.at_force(scene.press.force_N)
                                   : search.at_depth(scene.press.depth_m);
}

}  // namespace viscard
