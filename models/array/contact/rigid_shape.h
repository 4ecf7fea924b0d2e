#pragma once

#include <vector>

namespace viscard {

// Kinds of rigid surfaces.
enum class ShapeKind {
  kPlane,
  kCylinder,  // its axis along the direction
  kSphere,
  kParaboloid,  // r^2/(2 R), the sphere's parabola
  kWedge,       // its ridge along the direction
  kEdge,        // a half-plane, to the right of a line along the direction
  kTable,       // heights on a grid
};

// One with a radius of curvature.
inline bool is_round(ShapeKind kind) {
  return kind == ShapeKind::kCylinder || kind == ShapeKind::kSphere ||
         kind == ShapeKind::kParaboloid;
}

// Heights of a surface above its lowest point on a grid, x fastest; bilinear between them.
struct HeightTable {
  std::vector<double> x_m, y_m;  // ascending, at least two of each
  std::vector<double> height_m;
  bool is_random = false;  // drawn by rough_heights()
};

// A rigid surface above the plane x, y, turned downward. Its height is counted from the point `at`:
// the apex of a cylinder, sphere or wedge, the level of a plane, the zero of a table.
struct RigidShape {
  ShapeKind kind = ShapeKind::kPlane;
  double x_m = 0.0, y_m = 0.0;        // the point `at`
  double radius_m = 0.0;              // of cylinder, sphere and paraboloid
  double slope = 0.0;                 // of a wedge: rise of its flanks per length
  double direction_rad = 0.0;         // of axis, ridge or edge, from y towards -x
  double tilt_x = 0.0, tilt_y = 0.0;  // rise of the whole shape along x and y
  HeightTable table;
};

// Throws std::invalid_argument for a radius that is not positive, or a table whose axes do not ascend
// or whose heights are not finite or too few.
void validate(const RigidShape& shape);

// Height of the surface, m; infinite where the shape has none (beside an edge, beyond a sphere's
// equator, outside a table).
double height_m(const RigidShape& shape, double x_m, double y_m);

// At most the smallest height within the distance r of a point, so that tops out of reach need no search.
double least_height_m(const RigidShape& shape, double x_m, double y_m, double r_m);

// Of a table: its lowest node within the distance r of a point, as height there; infinite if there is none.
double lowest_node_m(const RigidShape& shape, double x_m, double y_m, double r_m);
// Shortest distance of its places along an axis; infinite for other shapes.
double finest_step_m(const RigidShape& shape);

// Steepest rise that the shape has within the distance r of a point. Infinite at an edge.
double largest_slope(const RigidShape& shape, double x_m, double y_m, double r_m);

}  // namespace viscard
