#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/plan/effects.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

using std::numbers::pi;

// Traction at the bond is not uniform, so that the film yields a little more than under a uniform
// one; the largest such factor seen over random scenes is 1.3 (tests/scenes).
constexpr double kUnevenTraction = 1.5;
// Change of the stress at half the radius over E_pillar/E_film times min(1, t/R), likewise.
constexpr double kStressShare = 2.0;

struct FilmElasticity {
  double young_Pa = 0.0, shear_Pa = 0.0, nu = 0.0;  // of the most compliant direction
};

FilmElasticity elasticity_of(const Medium& film) {
  if (film.is_isotropic) {
    return {2.0 * film.shear_Pa * (1.0 + film.poisson_ratio), film.shear_Pa, film.poisson_ratio};
  }
  const Matrix6d s = film.stiffness_Pa.inverse();
  return {1.0 / s.diagonal().head(3).maxCoeff(), 1.0 / s.diagonal().tail(3).maxCoeff(), 0.0};
}

// Share of the deflection under each kind of load that the film adds to the pillar's own.
struct FilmShares {
  double axial = 0.0, bending = 0.0, shear = 0.0, torsion = 0.0;
  double lateral() const { return 2.0 * bending + shear; }
};

// The film under the pillar yields less than the column of film below it would, standing alone, and
// on a wide film less than a half-space does under a disc (eq. E1).
FilmShares shares_of(const Scene& scene) {
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

// Frequency below which the film itself does not vibrate (a bonded layer in shear), over the
// highest frequency the modes asked for can have.
double film_over_pillar_frequency(const Scene& scene) {
  const double R = 0.5 * scene.geometry.diameter_m;
  const double L = scene.geometry.length_m;
  const double E = scene.pillar.E0_Pa;
  const double rho = scene.pillar.rho_kg_m3;
  const double film_Hz = std::sqrt(elasticity_of(*scene.film).shear_Pa / scene.film->rho_kg_m3) /
                         (4.0 * scene.geometry.film->thickness_m);
  const double rod_Hz = (2.0 * scene.modes - 1.0) / (4.0 * L) * std::sqrt(E / rho);
  const double shear_m_s = std::sqrt(E / (2.0 * (1.0 + scene.pillar.nu) * rho));
  const double ovalling_Hz = scene.plane ? 0.0 : 2.3 * shear_m_s / (2.0 * pi * R);
  return film_Hz / std::hypot(rod_Hz, ovalling_Hz);
}

EffectEstimate modal_film_estimate(const Scene& scene, const FilmShares& shares) {
  const double ratio = film_over_pillar_frequency(scene);
  if (ratio < 2.0) {
    return {EffectRole::kNeeded, 1.0, "film over pillar frequency", ratio,
            "the film vibrates among the modes asked for"};
  }
  const double largest = std::max({shares.axial, shares.lateral(), shares.torsion});
  return {EffectRole::kOptional, kUnevenTraction * largest / (1.0 - 1.0 / (ratio * ratio)),
          "base compliance over pillar's", largest, "lowers the frequencies of pillar and film"};
}

bool asks_for_electric(const Scene& scene) {
  if (!scene.electrodes) return false;
  return asks_for(scene, "electrode_voltage") || asks_for(scene, "electrode_charge") ||
         asks_for(scene, "electrode_capacitance") || asks_for(scene, "displacement_per_volt") ||
         asks_for(scene, "potential_at_centre") || asks_for(scene, "potential_mean") ||
         asks_for(scene, "quadrant_charge") || asks_for(scene, "quadrant_voltage") ||
         scene.readout || scene.drive_V != 0.0;
}

// Largest share of electric in elastic energy that any strain can cause: the largest eigenvalue of
// eps^-1 e c^-1 e^t (eq. E2).
double coupling_of(const Medium& film) {
  const Matrix6d c = film.is_isotropic && std::isinf(film.bulk_Pa)
                         ? Matrix6d(film.stiffness_Pa + 1e3 * film.shear_Pa * volumetric_form())
                         : film.stiffness_Pa;
  const Eigen::Matrix3d converse = film.piezo_C_m2 * c.ldlt().solve(film.piezo_C_m2.transpose());
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> modes(converse,
                                                                        film.permittivity_F_m);
  return modes.eigenvalues().maxCoeff();
}

}  // namespace

EffectEstimate film_compliance_estimate(const Scene& scene) {
  if (!scene.film) return {.reason = scene.fixed_bottom ? "the base is rigid" : "there is no film"};
  const FilmShares shares = shares_of(scene);
  const auto forced = scene.effects.find("piezo_coupling");
  if (asks_for_electric(scene) ||
      (scene.electrodes && forced != scene.effects.end() && forced->second == EffectChoice::kOn)) {
    return {EffectRole::kNeeded, 1.0, "E A/(k L)", shares.axial, "its potential is asked for"};
  }
  if (!scene.fixed_bottom) {
    return {EffectRole::kNeeded, 1.0, "E A/(k L)", shares.axial, "it is free and moves itself"};
  }
  switch (scene.kind) {
    case AnalysisKind::kModal:
      return modal_film_estimate(scene, shares);
    case AnalysisKind::kHarmonic:
    case AnalysisKind::kTransient:
      return {EffectRole::kNeeded, 1.0, "E A/(k L)", shares.axial, "it moves every resonance"};
    case AnalysisKind::kBuckling:
      // A plate halves the free length above the foot, whose turn then counts twice.
      return {EffectRole::kOptional,
              (scene.plate_on_top ? 2.0 : 1.0) * kUnevenTraction * shares.lateral(), "2 E I/(k L)",
              2.0 * shares.bending, "the base turns under the bent pillar"};
    default:
      break;
  }
  // A force at the end turns the foot by F L c: 3 E I c/L of the beam's F L^3/(3 E I).
  if (is_sideways(scene)) {
    const double share = 3.0 * shares.bending + shares.shear;
    return {EffectRole::kOptional, kUnevenTraction * share, "3 E I/(k L)", 3.0 * shares.bending,
            "the base turns and slides under the bent pillar"};
  }
  if (!scene.electrodes && scene.kind == AnalysisKind::kStatic &&
      asks_for(scene, "film_bottom_stress_mean")) {
    return {EffectRole::kNeeded, 1.0, "E A/(k L)", shares.axial, "its own stress is asked for"};
  }
  double error = kUnevenTraction * shares.axial;
  if (scene.kind == AnalysisKind::kStatic && asks_for(scene, "base_stress_at_half_radius")) {
    const double R = 0.5 * scene.geometry.diameter_m;
    const double thin = std::min(1.0, scene.geometry.film->thickness_m / R);
    const double stress_error =
        kStressShare * thin * scene.pillar.E0_Pa / elasticity_of(*scene.film).young_Pa;
    // Of a top that is moved the force changes too.
    error = moves_top(scene) ? error + stress_error : std::max(error, stress_error);
  }
  return {EffectRole::kOptional, error, "E A/(k L)", shares.axial,
          "the film's deflection over the pillar's"};
}

void leave_out_film(Scene& scene) {
  scene.film.reset();
  scene.geometry.film.reset();
  scene.electrodes.reset();
}

EffectEstimate piezo_coupling_estimate(const Scene& scene) {
  if (!scene.electrodes || !scene.film) return {.reason = "no electrode"};
  const double coupling = coupling_of(*scene.film);
  EffectEstimate estimate{EffectRole::kOptional, coupling, "k^2 of the film", coupling,
                          "electric back on elastic energy"};
  if (!asks_for_electric(scene)) {
    estimate.error *= kUnevenTraction * shares_of(scene).axial;
    estimate.reason = "only the film's share of the deflection feels it";
  } else if (is_sideways(scene)) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason = "quadrants are answered both ways";
  } else if (scene.kind != AnalysisKind::kStatic || scene.drive_V != 0.0 ||
             asks_for(scene, "displacement_per_volt")) {
    estimate.role = EffectRole::kNeeded;
    estimate.reason = scene.kind != AnalysisKind::kStatic ? "voltages in time need both ways"
                      : scene.drive_V != 0.0              ? "the film is driven by a voltage"
                      : scene.wanted.empty()
                          ? "without a [want] everything is asked for, the motion per volt too"
                          : "the motion per volt is asked for";
  }
  return estimate;
}

void leave_out_piezo_coupling(Scene& scene) {
  if (asks_for_electric(scene)) {
    scene.one_way_potential = true;
  } else {
    scene.electrodes.reset();
  }
}

EffectEstimate crosstalk_estimate(const Scene&) {
  return {.reason = "a single pillar"};
}

}  // namespace viscard
