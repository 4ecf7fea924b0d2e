#include "models/pillar/analyses/analysis.h"

#include <algorithm>
#include <numbers>

namespace viscard {

using std::numbers::pi;

FilmElasticity elasticity_of(const Medium& film) {
  if (film.is_isotropic) {
    return {2.0 * film.shear_Pa * (1.0 + film.poisson_ratio), film.shear_Pa, film.poisson_ratio};
  }
  const Matrix6d s = inverse(film.stiffness_Pa);
  return {1.0 / s.diagonal().head(3).maxCoeff(), 1.0 / s.diagonal().tail(3).maxCoeff(), 0.0};
}

// The film under the pillar is stiffer than a free-standing column of film would be, and a wide
// film is stiffer than a half-space under a disc (eq. E1).
FilmShares film_shares(const PillarScene& scene) {
  const double R = 0.5 * scene.geometry.diameter_m;
  const double L = scene.geometry.length_m;
  const double t = scene.geometry.film->thickness_m;
  const double E = scene.pillar.E0_Pa;
  const double G = E / (2.0 * (1.0 + scene.pillar.nu));
  const FilmElasticity f = elasticity_of(*scene.film);
  const double A = scene.plane ? 2.0 * R : pi * R * R;
  const double I = scene.plane ? 2.0 * R * R * R / 3.0 : pi * R * R * R * R / 4.0;
  const bool is_wide = !scene.plane && scene.geometry.film->radius_m >= 2.0 * R;
  const auto least = [&](double column, double half_space) {
    return is_wide ? std::min(column, half_space) : column;
  };
  FilmShares shares;
  shares.axial =
      E * A / L *
      least(t / (f.young_Pa * A), 16.0 * (1.0 - f.nu * f.nu) / (3.0 * pi * pi * f.young_Pa * R));
  shares.bending =
      E * I / L * least(t / (f.young_Pa * I), 3.0 * (1.0 - f.nu) / (8.0 * f.shear_Pa * R * R * R));
  shares.shear = G * A / L *
                 least(t / (f.shear_Pa * A) + t * t * t / (3.0 * f.young_Pa * I),
                       (2.0 - f.nu) / (8.0 * f.shear_Pa * R));
  shares.torsion = G / f.shear_Pa / L * least(t, 3.0 * pi * R / 32.0);
  return shares;
}

}  // namespace viscard
