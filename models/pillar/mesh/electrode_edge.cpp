#include "models/pillar/mesh/electrode_edge.h"

#include "models/pillar/mesh/line_mesh.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// Cuts the intervals on either side of a break into `layers` pieces that shrink toward the break.
// An interval that is already cut for the rim of the bond stays as it is.
void grade_toward(double at, const Discretisation& d, std::vector<double>& breaks) {
  const double near = 1e-9 * (breaks.back() - breaks.front());
  std::vector<double> graded{breaks.front()};
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double left = breaks[i - 1], right = breaks[i];
    const bool from_left = std::abs(right - at) <= near;
    if (!from_left && std::abs(left - at) > near) {
      graded.push_back(right);
      continue;
    }
    const std::vector<double> pieces = graded_breaks(left, right, d.layers, d.ratio, from_left);
    graded.insert(graded.end(), pieces.begin() + 1, pieces.end());
  }
  breaks = std::move(graded);
}

}  // namespace

void grade_toward_electrode(const FilmGeometry& film, const Discretisation& d,
                            std::vector<double>& x, std::vector<double>& z) {
  const double edge_m = film.electrode_radius_m;
  const double near = 1e-9 * (x.back() - x.front());
  const bool is_there =
      std::any_of(x.begin(), x.end(), [&](double b) { return std::abs(b - edge_m) <= near; });
  if (!is_there) {
    x.insert(std::upper_bound(x.begin(), x.end(), edge_m), edge_m);
    grade_toward(edge_m, d, x);
  }
  if (film.electrode_is_below) grade_toward(z.front(), d, z);
}

}  // namespace viscard
