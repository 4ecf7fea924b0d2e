#include "models/pillar/pillar_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

void require_length(double value_m, const char* what) {
  if (!(value_m > 0.0) || !std::isfinite(value_m)) {
    throw std::invalid_argument(std::string(what) + " is " + std::to_string(value_m * 1e6) +
                                " um; it must be positive and finite");
  }
}

void append(std::vector<double>& breaks, const std::vector<double>& more) {
  if (more.empty()) return;  // a film no wider than its pillar adds nothing
  const double same = 1e-9 * std::abs(more.back() - more.front());
  for (const double x : more) {
    if (breaks.empty() || x > breaks.back() + same) breaks.push_back(x);
  }
}

// Equal elements no longer than h_m.
std::vector<double> equal_breaks(double from_m, double to_m, double h_m) {
  const int count = std::max(1, static_cast<int>(std::ceil((to_m - from_m) / h_m - 1e-9)));
  return graded_breaks(from_m, to_m, count, 1.0, true);
}

std::vector<double> film_radii(const FilmGeometry& film, double radius_m, const Discretisation& d) {
  std::vector<double> breaks;
  if (d.uniform_m > 0.0) {
    if (film.radius_m > radius_m * (1.0 + 1e-9)) {
      breaks = equal_breaks(radius_m, film.radius_m, d.uniform_m);
    }
    return breaks;
  }
  const double graded_m = std::min(2.0 * radius_m, film.radius_m);
  if (graded_m > radius_m * (1.0 + 1e-9)) {
    append(breaks, graded_breaks(radius_m, graded_m, d.layers, d.ratio, false));
  }
  if (film.radius_m > graded_m * (1.0 + 1e-9)) {
    append(breaks, graded_breaks(graded_m, film.radius_m, d.film_elements, 1.0, true));
  }
  return breaks;
}

std::vector<double> pillar_heights(const PillarGeometry& g, double radius_m,
                                   const Discretisation& d) {
  if (d.uniform_m > 0.0) return equal_breaks(0.0, g.length_m, d.uniform_m);
  const double foot_m = std::min(2.0 * radius_m, g.length_m);
  std::vector<double> breaks = graded_breaks(0.0, foot_m, d.layers, d.ratio, false);
  if (g.length_m > foot_m * (1.0 + 1e-9)) {
    append(breaks, graded_breaks(foot_m, g.length_m, d.shaft_elements, 1.0, true));
  }
  return breaks;
}

}  // namespace

void validate(const PillarGeometry& g) {
  require_length(g.diameter_m, "the pillar's diameter");
  require_length(g.length_m, "the pillar's length");
  if (!g.film) return;
  require_length(g.film->thickness_m, "the film's thickness");
  require_length(g.film->radius_m, "the film's radius");
  if (g.film->radius_m < 0.5 * g.diameter_m * (1.0 - 1e-12)) {
    throw std::invalid_argument("the film's radius of " + std::to_string(g.film->radius_m * 1e6) +
                                " um is smaller than the pillar's of " +
                                std::to_string(g.diameter_m * 0.5e6) + " um");
  }
  if (!(g.film->electrode_radius_m >= 0.0 && g.film->electrode_radius_m <= g.film->radius_m)) {
    throw std::invalid_argument("the electrode's radius of " +
                                std::to_string(g.film->electrode_radius_m * 1e6) +
                                " um does not lie on the film");
  }
}

PillarMesh pillar_mesh(const PillarGeometry& g, const Discretisation& d) {
  validate(g);
  const double radius_m = 0.5 * g.diameter_m;
  const bool is_uniform = d.uniform_m > 0.0;
  std::vector<double> x = is_uniform ? equal_breaks(0.0, radius_m, d.uniform_m)
                                     : graded_breaks(0.0, radius_m, d.layers, d.ratio, true);
  std::vector<double> z;
  if (g.film) {
    append(x, film_radii(*g.film, radius_m, d));
    const double edge_m = g.film->electrode_radius_m;
    const double near_m = 1e-9 * radius_m;
    const bool is_break =
        std::any_of(x.begin(), x.end(), [&](double b) { return std::abs(b - edge_m) <= near_m; });
    if (edge_m > 0.0 && !is_break) x.insert(std::upper_bound(x.begin(), x.end(), edge_m), edge_m);
    const double graded_m = std::min(g.film->thickness_m, radius_m);
    if (is_uniform) z = equal_breaks(-g.film->thickness_m, 0.0, d.uniform_m);
    if (!is_uniform && g.film->thickness_m > graded_m * (1.0 + 1e-9))
      z.push_back(-g.film->thickness_m);
    if (!is_uniform) append(z, graded_breaks(-graded_m, 0.0, d.layers, d.ratio, true));
  }
  const int bond_row = z.empty() ? 0 : static_cast<int>(z.size()) - 1;
  append(z, pillar_heights(g, radius_m, d));
  const int top_row = static_cast<int>(z.size()) - 1;
  const int pillar_columns = static_cast<int>(
      std::count_if(x.begin(), x.end(), [&](double b) { return b < radius_m * (1.0 - 1e-9); }));
  Section section(LineMesh(x, d.degree), LineMesh(z, d.degree), [&](double r_m, double z_m) {
    if (z_m < 0.0) return kFilmRegion;
    return r_m < radius_m ? kPillarRegion : Section::kEmpty;
  });
  return {std::move(section), pillar_columns, bond_row, top_row};
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
