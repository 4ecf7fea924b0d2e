#include "models/array/plane/array_geometry.h"

#include "models/answer/scene_mistake.h"
#include "models/maths/require.h"
#include "models/pillar/mesh/film_mesh.h"

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
  // Layers toward a mark; 0: the mark is not singular. A singular mark that is full already still
  // sets the length of the elements there.
  const auto layers_to = [&](const MeshMark& mark) {
    const int left = layers - mark.fewer_layers;
    return mark.is_singular && (mark.fewer_layers == 0 || left > 1) ? left : 0;
  };
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    const double a = marks[i].x;
    const double b = marks[i + 1].x;
    const int to_a = layers_to(marks[i]);
    const int to_b = layers_to(marks[i + 1]);
    const int singular_ends = (to_a > 0 ? 1 : 0) + (to_b > 0 ? 1 : 0);
    double reach = singular_ends == 0 ? 0.0 : reach_m;
    // If little would remain between the graded parts, they fill the whole interval.
    if (singular_ends > 0 && b - a < 1.5 * singular_ends * reach_m) reach = (b - a) / singular_ends;
    const double left = a + (to_a > 0 ? reach : 0.0);
    const double right = b - (to_b > 0 ? reach : 0.0);
    if (to_a > 0) append_breaks(breaks, graded_breaks(a, left, to_a, ratio, false));
    if (right - left > 1e-9 * (b - a)) {
      const int n = std::max(1, static_cast<int>(std::ceil((right - left) / largest_m - 1e-9)));
      append_breaks(breaks, graded_breaks(left, right, n, 1.0, true));
    }
    if (to_b > 0) append_breaks(breaks, graded_breaks(right, b, to_b, ratio, true));
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
  static Lines across_film(const ArrayGeometry& g, const Discretisation& d) {
    return {d, std::min(0.5 * g.diameter_m, g.film_thickness_m), d.layers};
  }
  // In a thin film only what leaves a rim varies over its thickness; farther away the field varies with the
  // pillar, as in lubrication. Elements therefore grow from the rim up to the pillar's radius.
  static Lines along_film(const ArrayGeometry& g, const Discretisation& d) {
    constexpr double kThin = 0.1;  // of the radius
    const double radius_m = 0.5 * g.diameter_m;
    const double thin = g.film_thickness_m / radius_m;
    if (thin >= kThin || !(d.ratio > 0.0 && d.ratio < 1.0)) return across_film(g, d);
    const int more = static_cast<int>(std::ceil(std::log(thin) / std::log(d.ratio)));
    return {d, radius_m, d.layers + more};
  }

  std::vector<double> between(std::vector<MeshMark> along) const {
    if (!(d_.uniform_m > 0.0)) {
      return breaks_between(along, reach_m_, 2.0 * reach_m_, layers_, d_.ratio);
    }
    for (MeshMark& mark : along) mark.is_singular = false;
    return breaks_between(along, 0.0, d_.uniform_m, 1, d_.ratio);
  }

 private:
  Lines(const Discretisation& d, double reach_m, int layers)
      : d_(d), reach_m_(reach_m), layers_(layers) {}

  const Discretisation& d_;
  double reach_m_;
  int layers_;
};

// Ends of a cell: how far they lie beyond pillar and electrode, and whether the film ends there.
struct CellEnd {
  double beyond_m = 0.0;
  bool is_film_end = false;
};

// Where the film ends, its held bottom has a corner. It gets fewer layers than the rims of pillars,
// because its effect decreases with its distance from them.
MeshMark film_end(double x, double beyond_m, double thickness_m) {
  return {x, true, layers_not_felt(beyond_m, thickness_m)};
}

CellMesh cell_mesh(const ArrayGeometry& g, const ArrayElectrodes& e, const CellEnd& on_left,
                   const CellEnd& on_right, const Lines& lines) {
  const double R = 0.5 * g.diameter_m;
  const double half_width = electrode_half_width_m(g, e);
  const double half_load = std::max(R, half_width);
  const auto end = [&](double side, const CellEnd& at) {
    const double x = side * (half_load + at.beyond_m);
    return at.is_film_end ? film_end(x, at.beyond_m, g.film_thickness_m)
                          : MeshMark{x, at.beyond_m == 0.0};
  };
  std::vector<MeshMark> marks{end(-1.0, on_left), end(1.0, on_right)};
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
  const Lines lines = Lines::along_film(g, d), heights = Lines::across_film(g, d);
  const FilmBeside beside = film_beside(g, e);
  const double half_load = std::max(R, electrode_half_width_m(g, e));
  const bool is_cut = g.ends == FilmEnds::kFree;
  const double edge = is_cut ? g.film_edge_m : 0.5 * g.spacing_m;
  const double rest = edge - (half_load - R + beside.outside_m);
  const bool has_edge = rest > kShortestPiece * R;
  const CellEnd inside{beside.inside_m};
  const CellEnd outside{beside.outside_m, is_cut && !has_edge && beside.outside_m > 0.0};
  ArrayMesh mesh;
  mesh.ends_differ = g.count > 1 && (inside.beyond_m != outside.beyond_m || outside.is_film_end);
  const CellEnd in_row = g.count > 1 ? inside : outside;
  const auto cell = [&](const CellEnd& left, const CellEnd& right) {
    return cell_mesh(g, e, left, right, lines);
  };
  mesh.cell = cell(in_row, in_row);
  mesh.first_cell = mesh.ends_differ ? cell(outside, in_row) : mesh.cell;
  mesh.last_cell = mesh.ends_differ ? cell(in_row, outside) : mesh.cell;
  const double gap = g.spacing_m - 2.0 * (half_load - R + in_row.beyond_m);
  const bool gap_at_rim = in_row.beyond_m == 0.0;
  if (g.count > 1) mesh.gap_x = lines.between({{0.0, gap_at_rim}, {gap, gap_at_rim}});
  const double beyond_load_m = edge - (half_load - R);
  if (has_edge) {
    mesh.edge_x = lines.between({{0.0, outside.beyond_m == 0.0},
                                 is_cut ? film_end(rest, beyond_load_m, t) : MeshMark{rest}});
  }
  // Singular at the bottom: an electrode's edge, and the held corner where the film ends.
  const bool bottom_electrode = e.is_equipotential && e.grounded == FilmFace::kTop;
  const MeshMark bottom = bottom_electrode ? MeshMark{-t, true}
                          : is_cut         ? film_end(-t, beyond_load_m, t)
                                           : MeshMark{-t};
  mesh.film_z = heights.between({bottom, {0.0, true}});
  const std::vector<MeshMark> shaft = {{0.0, true}, {g.length_m, d.grades_top, (d.layers - 1) / 2}};
  mesh.pillar_z = d.uniform_m > 0.0 ? heights.between(shaft)
                                    : breaks_between(shaft, 2.0 * R, 4.0 * R / d.shaft_elements,
                                                     d.layers, d.ratio);
  return mesh;
}

}  // namespace viscard
