#include "models/array/plane/array_geometry.h"

#include "models/maths/require.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace viscard {
namespace {

// Relative to the pillar's radius: a shorter piece of film is left out.
constexpr double kShortestPiece = 1e-6;

void require_length(double value_m, bool may_be_zero, const char* key, const char* what) {
  at_key(key, [&] {
    (may_be_zero ? require_not_negative : require_positive)(what, value_m * 1e6, "um");
  });
}

int column_of(const std::vector<double>& breaks, double x) {
  const auto nearest = std::min_element(breaks.begin(), breaks.end(), [&](double a, double b) {
    return std::abs(a - x) < std::abs(b - x);
  });
  return static_cast<int>(nearest - breaks.begin());
}

}  // namespace

double electrode_half_width_m(const ArrayGeometry& g, const ArrayElectrodes& e) {
  return e.half_width_m > 0.0 ? e.half_width_m : 0.5 * g.diameter_m;
}

ArrayGeometry lone(ArrayGeometry geometry) {
  geometry.count = 1;
  geometry.ends = FilmEnds::kMirror;
  geometry.spacing_m = 15.0 * std::max(geometry.diameter_m, 1.6 * geometry.film_thickness_m);
  return geometry;
}

void validate(const ArrayGeometry& g, const ArrayElectrodes& e) {
  if (g.count < 1 || g.count > 4096) {
    throw SceneMistake("geometry.count", "the array has " + std::to_string(g.count) +
                                             " pillars; it must have between 1 and 4096");
  }
  require_length(g.diameter_m, false, "geometry.diameter", "the pillars' diameter");
  require_length(g.length_m, false, "geometry.length", "the pillars' length");
  require_length(g.film_thickness_m, false, "geometry.film.thickness", "the film's thickness");
  require_length(e.half_width_m, true, "geometry.electrode.radius", "the electrodes' half width");
  const bool has_gap = g.count > 1 || g.ends == FilmEnds::kMirror;
  if (has_gap) {
    require_length(g.spacing_m, false, "geometry.spacing",
                   "the spacing (edge to edge; pillars must not overlap)");
  }
  if (g.ends == FilmEnds::kFree) {
    require_length(g.film_edge_m, true, "geometry.film.edge", "the film's edge");
  }
  const double beyond_m = electrode_half_width_m(g, e) - 0.5 * g.diameter_m;
  if (has_gap && !(beyond_m < 0.5 * g.spacing_m * (1.0 - kSameLength))) {
    throw SceneMistake("geometry.electrode.radius",
                       "the electrodes reach " + micrometres(beyond_m) +
                           " beyond their pillars and overlap at a spacing of " +
                           micrometres(g.spacing_m));
  }
  if (g.ends == FilmEnds::kFree && beyond_m > g.film_edge_m + kSameLength * g.diameter_m) {
    throw SceneMistake(
        "geometry.film.edge",
        "the outer electrodes lie outside the film; make it at least " + micrometres(beyond_m, 12));
  }
}

std::vector<double> breaks_between(const std::vector<MeshMark>& marks, double reach_m,
                                   double largest_m, int layers, double ratio) {
  std::vector<double> breaks;
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    const double a = marks[i].x;
    const double b = marks[i + 1].x;
    const int singular_ends = (marks[i].is_singular ? 1 : 0) + (marks[i + 1].is_singular ? 1 : 0);
    double reach = singular_ends == 0 ? 0.0 : reach_m;
    // If little would remain between the graded parts, they fill the whole interval.
    if (singular_ends > 0 && b - a < 1.5 * singular_ends * reach_m) reach = (b - a) / singular_ends;
    const double left = a + (marks[i].is_singular ? reach : 0.0);
    const double right = b - (marks[i + 1].is_singular ? reach : 0.0);
    if (marks[i].is_singular) append_breaks(breaks, graded_breaks(a, left, layers, ratio, false));
    if (right - left > 1e-9 * (b - a)) {
      const int n = std::max(1, static_cast<int>(std::ceil((right - left) / largest_m - 1e-9)));
      append_breaks(breaks, graded_breaks(left, right, n, 1.0, true));
    }
    if (marks[i + 1].is_singular)
      append_breaks(breaks, graded_breaks(right, b, layers, ratio, true));
  }
  return breaks;
}

namespace {

// Film beside a pillar that belongs to its cell, beyond pillar and electrode: to another pillar and
// to an end of the row.
struct FilmBeside {
  double inside_m = 0.0;
  double outside_m = 0.0;
};

FilmBeside film_beside(const ArrayGeometry& g, const ArrayElectrodes& e) {
  const double R = 0.5 * g.diameter_m;
  const double beyond_m = electrode_half_width_m(g, e) - R;
  const bool is_wider = beyond_m > kSameLength * R;
  if (!is_wider && !(e.is_equipotential && beyond_m > -kSameLength * R)) return {};
  const double t = g.film_thickness_m;
  const double inside_m = std::min(t, 0.5 * (0.5 * g.spacing_m - beyond_m));
  if (g.ends == FilmEnds::kMirror) return {inside_m, inside_m};
  const double rest_m = g.film_edge_m - beyond_m;
  if (rest_m < kShortestPiece * R) return {inside_m, 0.0};
  if (g.count == 1) return {0.0, std::min(t, rest_m)};
  return {inside_m, std::min(inside_m, rest_m)};
}

// The lines of a mesh along x or z between marks.
class Lines {
 public:
  Lines(const ArrayGeometry& g, const Discretisation& d)
      : d_(d), reach_m_(std::min(0.5 * g.diameter_m, g.film_thickness_m)) {}

  std::vector<double> between(std::vector<MeshMark> along) const {
    if (!(d_.uniform_m > 0.0)) {
      return breaks_between(along, reach_m_, 2.0 * reach_m_, d_.layers, d_.ratio);
    }
    for (MeshMark& mark : along) mark.is_singular = false;
    return breaks_between(along, 0.0, d_.uniform_m, 1, d_.ratio);
  }

 private:
  const Discretisation& d_;
  double reach_m_;
};

CellMesh cell_mesh(const ArrayGeometry& g, const ArrayElectrodes& e, double left_m, double right_m,
                   const Lines& lines) {
  const double R = 0.5 * g.diameter_m;
  const double half_width = electrode_half_width_m(g, e);
  const double half_load = std::max(R, half_width);
  std::vector<MeshMark> marks{{-half_load - left_m, left_m == 0.0},
                              {half_load + right_m, right_m == 0.0}};
  const auto add_pair = [&](double x, bool is_singular) {
    for (const double mark : {-x, x}) {
      const bool is_inside =
          mark > marks[0].x * (1.0 - kSameLength) && mark < marks[1].x * (1.0 - kSameLength);
      if (is_inside) marks.push_back({mark, is_singular});
    }
  };
  add_pair(R, true);
  if (std::abs(half_width - R) > kSameLength * R) add_pair(half_width, e.is_equipotential);
  std::sort(marks.begin(), marks.end(),
            [](const MeshMark& a, const MeshMark& b) { return a.x < b.x; });
  CellMesh cell;
  cell.x = lines.between(marks);
  cell.first_pillar_column = column_of(cell.x, -R);
  cell.last_pillar_column = column_of(cell.x, R);
  return cell;
}

}  // namespace

ArrayMesh array_mesh(const ArrayGeometry& g, const ArrayElectrodes& e, const Discretisation& d) {
  validate(g, e);
  const double R = 0.5 * g.diameter_m;
  const double t = g.film_thickness_m;
  const Lines lines(g, d);
  const FilmBeside beside = film_beside(g, e);
  const auto cell = [&](double left_m, double right_m) {
    return cell_mesh(g, e, left_m, right_m, lines);
  };
  ArrayMesh mesh;
  mesh.ends_differ = g.count > 1 && beside.inside_m != beside.outside_m;
  const double in_row_m = g.count > 1 ? beside.inside_m : beside.outside_m;
  mesh.cell = cell(in_row_m, in_row_m);
  mesh.first_cell = mesh.ends_differ ? cell(beside.outside_m, in_row_m) : mesh.cell;
  mesh.last_cell = mesh.ends_differ ? cell(in_row_m, beside.outside_m) : mesh.cell;
  const double half_load = std::max(R, electrode_half_width_m(g, e));
  const double gap = g.spacing_m - 2.0 * (half_load - R + in_row_m);
  const bool gap_at_rim = in_row_m == 0.0;
  if (g.count > 1) mesh.gap_x = lines.between({{0.0, gap_at_rim}, {gap, gap_at_rim}});
  const double edge = g.ends == FilmEnds::kMirror ? 0.5 * g.spacing_m : g.film_edge_m;
  const double rest = edge - (half_load - R + beside.outside_m);
  if (rest > kShortestPiece * R) {
    mesh.edge_x = lines.between({{0.0, beside.outside_m == 0.0}, {rest, false}});
  }
  // Singular at the bottom: an electrode's edge, and the held corner of a film that ends nearby.
  const bool bottom_electrode = e.is_equipotential && e.grounded == FilmFace::kTop;
  const bool bottom_corner = g.ends == FilmEnds::kFree && edge < t;
  mesh.film_z = lines.between({{-t, bottom_electrode || bottom_corner}, {0.0, true}});
  const std::vector<MeshMark> shaft = {{0.0, true}, {g.length_m, false}};
  mesh.pillar_z = d.uniform_m > 0.0 ? lines.between(shaft)
                                    : breaks_between(shaft, 2.0 * R, 4.0 * R / d.shaft_elements,
                                                     d.layers, d.ratio);
  return mesh;
}

}  // namespace viscard
