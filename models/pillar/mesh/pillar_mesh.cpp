#include "models/pillar/mesh/pillar_mesh.h"

#include "models/answer/scene_mistake.h"
#include "models/maths/require.h"
#include "models/pillar/mesh/film_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace viscard {
namespace {

// Divides every interval into equal pieces no longer than `size`.
std::vector<double> cut(const std::vector<double>& breaks, double size) {
  std::vector<double> fine;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double pieces = std::ceil((breaks[i] - breaks[i - 1]) / size * (1.0 - 1e-9));
    append_breaks(fine, graded_breaks(breaks[i - 1], breaks[i],
                                      std::max(1, static_cast<int>(pieces)), 1.0, true));
  }
  return fine;
}

// Divides the range between two breaks into pieces whose size may grow with the distance from one
// end: see skin_m.
class WaveBreaks {
 public:
  WaveBreaks(const Discretisation& d, double end_m)
      : size_m_(d.longest_m), skin_m_(d.skin_m), end_m_(end_m) {}

  std::vector<double> cut_between(const std::vector<double>& breaks, double from, double to) const {
    std::vector<double> all;
    const double near = 1e-9 * (to - from);
    for (const double b : breaks) {
      if (!all.empty() && b > from + near && b <= to + near) cut(all.back(), b, all);
      append_breaks(all, {b});
    }
    return all;
  }

 private:
  // Number of elements between the end and a point at this distance, int ds/size(s).
  double count_to(double distance_m) const {
    if (skin_m_ == 0.0 || distance_m <= skin_m_) return distance_m / size_m_;
    return skin_m_ / size_m_ + std::log1p((distance_m - skin_m_) / size_m_);
  }
  double distance_of(double count) const {
    const double in_skin = skin_m_ / size_m_;
    if (skin_m_ == 0.0 || count <= in_skin) return count * size_m_;
    return skin_m_ + size_m_ * std::expm1(count - in_skin);
  }
  // Breaks within (from, to) that divide the number of elements between them equally.
  void cut(double from, double to, std::vector<double>& all) const {
    const double a = count_to(std::abs(from - end_m_));
    const double b = count_to(std::abs(to - end_m_));
    const int pieces = static_cast<int>(std::ceil(std::abs(b - a) * (1.0 - 1e-9)));
    // The middle decides the side: one of the two breaks may be the end itself, up to rounding.
    const double side = 0.5 * (from + to) > end_m_ ? 1.0 : -1.0;
    for (int i = 1; i < pieces; ++i) {
      append_breaks(all, {end_m_ + side * distance_of(a + (b - a) * i / pieces)});
    }
  }

  double size_m_, skin_m_, end_m_;
};

std::vector<double> pillar_heights(const PillarGeometry& g, double radius_m,
                                   const Discretisation& d) {
  const double foot_m = std::min(2.0 * radius_m, g.length_m);
  std::vector<double> breaks = graded_breaks(0.0, foot_m, d.layers, d.ratio, false);
  if (g.length_m > foot_m * (1.0 + 1e-9)) {
    append_breaks(breaks, graded_breaks(foot_m, g.length_m, d.shaft_elements, 1.0, true));
  }
  return breaks;
}

void validate_flare(const Flare& flare, const char* key, const char* what, double radius_m) {
  at_key(key, [&] {
    require(std::isfinite(flare.width_m) && flare.height_m >= 0.0 && std::isfinite(flare.height_m),
            std::string(what) + " needs a finite width and height");
    require(flare.width_m == 0.0 || flare.height_m != 0.0, std::string(what) + " needs a height");
    require(flare.width_m > -radius_m, std::string(what) + " takes " + micrometres(-flare.width_m) +
                                           " off a radius of " + micrometres(radius_m) +
                                           ": nothing is left");
  });
}

// 1 at the end; falls to 0 at the height of the flare.
double share_of(const Flare& flare, double from_end_m) {
  if (flare.width_m == 0.0) return 0.0;
  return std::max(1.0 - from_end_m / flare.height_m, 0.0);
}

double radius_slope(const PillarGeometry& g, double z_m) {
  double slope = 0.0;
  if (g.foot.width_m != 0.0)
    slope -= 2.0 * g.foot.width_m * share_of(g.foot, z_m) / g.foot.height_m;
  if (g.tip.width_m != 0.0)
    slope += 2.0 * g.tip.width_m * share_of(g.tip, g.length_m - z_m) / g.tip.height_m;
  return slope;
}

bool has_flares(const PillarGeometry& g) {
  return g.foot.width_m != 0.0 || g.tip.width_m != 0.0;
}

// Lines that every mesh must contain, graded or uniform.
struct Breaks {
  std::vector<double> x, z;
};

Breaks necessary_breaks(const PillarGeometry& g) {
  const double radius_m = bond_radius_m(g);
  Breaks breaks{{0.0, radius_m}, {0.0, g.length_m}};
  if (g.film) {
    append_breaks(breaks.x, {g.film->radius_m});
    breaks.z.insert(breaks.z.begin(), -g.film->thickness_m);
  }
  return breaks;
}

Breaks graded_mesh_breaks(const PillarGeometry& g, const Discretisation& d) {
  const double radius_m = bond_radius_m(g);
  Breaks breaks{graded_breaks(0.0, radius_m, d.layers, d.ratio, true), {}};
  if (g.film) {
    append_breaks(breaks.x, film_radii(*g.film, radius_m, d));
    breaks.z = film_heights(*g.film, radius_m, d);
  }
  append_breaks(breaks.z, pillar_heights(g, radius_m, d));
  return breaks;
}

// A dead pressure on a top that rotates acts as a shear along it, d_z u times the pressure (eq.
// 21), while the free side bears none. At the rim between them the stress is logarithmic in the
// distance, so a rising degree alone only halves the error per step. The corner is weaker than the
// bond's (displacements grow as r), so half of the layers are enough.
void grade_toward_top(const Discretisation& d, std::vector<double>& z) {
  const double top_m = z.back();
  z.pop_back();
  append_breaks(z, graded_breaks(z.back(), top_m, 1 + d.layers / 2, d.ratio, true));
}

}  // namespace

double bond_radius_m(const PillarGeometry& g) {
  return 0.5 * g.diameter_m + g.foot.width_m;
}

double radius_at_m(const PillarGeometry& g, double z_m) {
  const double foot = share_of(g.foot, z_m);
  const double tip = share_of(g.tip, g.length_m - z_m);
  return 0.5 * g.diameter_m + g.foot.width_m * foot * foot + g.tip.width_m * tip * tip;
}

void validate(const PillarGeometry& g) {
  require_positive("the pillar's diameter", g.diameter_m * 1e6, "um");
  require_positive("the pillar's length", g.length_m * 1e6, "um");
  validate_flare(g.foot, "geometry.foot", "the fillet at the foot", 0.5 * g.diameter_m);
  validate_flare(g.tip, "geometry.tip", "the mushroom at the tip", 0.5 * g.diameter_m);
  if (g.foot.height_m + g.tip.height_m > g.length_m * (1.0 + 1e-12)) {
    throw SceneMistake(g.tip.height_m > g.foot.height_m ? "geometry.tip" : "geometry.foot",
                       "fillet and mushroom tip together are " +
                           micrometres(g.foot.height_m + g.tip.height_m) +
                           " high, more than the pillar");
  }
  if (!g.film) return;
  require_positive("the film's thickness", g.film->thickness_m * 1e6, "um");
  require_positive("the film's radius", g.film->radius_m * 1e6, "um");
  // Relative to the diameter; rounding of node positions matters below.
  constexpr double kThinnest = 1e-6;
  if (g.film->thickness_m < kThinnest * g.diameter_m) {
    throw SceneMistake("geometry.film.thickness",
                       "the film is thinner than a millionth of the pillar's diameter, too thin "
                       "for any mesh here; leave the film out");
  }
  if (g.film->radius_m < bond_radius_m(g) * (1.0 - kSameLength)) {
    throw SceneMistake("geometry.film.radius",
                       "the film's radius of " + micrometres(g.film->radius_m, 12) +
                           " is smaller than the pillar's of " + micrometres(bond_radius_m(g), 12));
  }
  if (!(g.film->electrode_radius_m >= 0.0 &&
        g.film->electrode_radius_m <= g.film->radius_m * (1.0 + kSameLength))) {
    throw SceneMistake("geometry.electrode.radius", "the electrode's radius of " +
                                                        micrometres(g.film->electrode_radius_m) +
                                                        " does not lie on the film");
  }
}

PillarMesh pillar_mesh(const PillarGeometry& g, const Discretisation& d) {
  validate(g);
  const double radius_m = bond_radius_m(g);
  const bool is_uniform = d.uniform_m > 0.0;
  Breaks breaks = is_uniform ? necessary_breaks(g) : graded_mesh_breaks(g, d);
  if (g.film && !is_uniform) grade_film(*g.film, radius_m, d, breaks.x, breaks.z);
  if (g.film && is_uniform && g.film->electrode_radius_m > 0.0) {
    insert_break(breaks.x, g.film->electrode_radius_m);
  }
  if (d.grades_top && !is_uniform) grade_toward_top(d, breaks.z);
  if (g.foot.width_m != 0.0) insert_break(breaks.z, g.foot.height_m);
  if (g.tip.width_m != 0.0) insert_break(breaks.z, g.length_m - g.tip.height_m);
  if (is_uniform) {
    breaks = {cut(breaks.x, d.uniform_m), cut(breaks.z, d.uniform_m)};
  } else if (d.longest_m > 0.0) {
    const double end_m = d.skin_at_foot ? 0.0 : g.length_m;
    breaks = {WaveBreaks(d, radius_m).cut_between(breaks.x, 0.0, radius_m),
              WaveBreaks(d, end_m).cut_between(breaks.z, 0.0, g.length_m)};
  }
  const auto below = [](const std::vector<double>& all, double at) {
    return static_cast<int>(
        std::count_if(all.begin(), all.end(), [&](double b) { return b < at; }));
  };
  PillarMesh mesh{Section(LineMesh(breaks.x, d.degree), LineMesh(breaks.z, d.degree),
                          [&](double r_m, double z_m) {
                            if (z_m < 0.0) return kFilmRegion;
                            return r_m < radius_m ? kPillarRegion : Section::kEmpty;
                          }),
                  below(breaks.x, radius_m * (1.0 - 1e-9)), below(breaks.z, -1e-9 * g.length_m),
                  static_cast<int>(breaks.z.size()) - 1};
  if (has_flares(g)) {
    mesh.section.stretch(kPillarRegion, [g, radius_m](double z_m) {
      return Stretch{radius_at_m(g, z_m) / radius_m, radius_slope(g, z_m) / radius_m};
    });
  }
  return mesh;
}

std::vector<int> nodes_on_break(const Section& section, int break_row, int first_column,
                                int last_column) {
  std::vector<int> nodes;
  const int p = section.degree();
  for (int ix = first_column * p; ix <= last_column * p; ++ix) {
    const int node = section.node(ix, break_row * p);
    if (node >= 0) nodes.push_back(node);
  }
  return nodes;
}

}  // namespace viscard
