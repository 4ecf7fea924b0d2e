#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/system/medium.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace viscard {

// One layer of a film.
struct FilmLayer {
  Medium medium;
  double thickness_m = 0.0;
};

// An elastic half-space under the film.
struct Backing {
  double young_modulus_Pa = 0.0;
  double poisson_ratio = 0.0;
};

// Layers of constant thickness without lateral ends, from the bottom upward. The first one is the
// piezoelectric film: one of its faces is grounded, the other carries no charge and is read. Layers
// above it have no potential. The bottom is held unless there is a backing.
struct LayeredFilm {
  std::vector<FilmLayer> layers;
  FilmFace grounded = FilmFace::kTop;
  std::optional<Backing> backing;
  // A strip that is free to widen across the waves (no stress along y), instead of one that cannot.
  bool is_plane_stress = false;
};

// Throws std::invalid_argument for a stack without layers, a thickness or constant that is not
// positive, a film without permittivity, or a medium that couples the in-plane and the out-of-plane
// shears (its axis 3 is then no twofold axis, eq. S1) or is incompressible.
void validate(const LayeredFilm& film);

double thickness_m(const LayeredFilm& film);  // of all layers

// The film under tractions that are waves along one direction (eq. S1). With x along the wave:
//   u_x = i a, u_y = i b, u_z = w, potential phi, times exp(i k x), all four real; tractions on the top
//   t_x = i tau_x, t_y = i tau_y, t_z; charge q per area on the face that is read.
// Elements of degree p across the layers; each is short enough for waves up to the largest k.
class FilmWaves {
 public:
  // The direction is at `angle_rad` from axis 1 of the film.
  FilmWaves(const LayeredFilm& film, double angle_rad, double largest_k_1_m, int degree);

  // (a, b, w of the top in m; phi in V) per unit (tau_x, tau_y, t_z in Pa; q in C/m2). k > 0; without
  // a backing also k = 0.
  Eigen::Matrix4d response(double k_1_m) const;
  // Its last row, at a quarter of the cost: V per unit (tau_x, tau_y, t_z; q).
  Eigen::Vector4d reading(double k_1_m) const;

 private:
  Eigen::MatrixXd matrix(double k_1_m) const;

  double length_m_ = 0.0;  // unit of length: the film's thickness
  double stress_Pa_ = 0.0;
  double potential_V_ = 0.0;
  std::optional<Backing> backing_;
  std::array<int, 4> top_{};                 // unknowns a, b, w, phi of the top; -1: none
  std::array<int, 4> bottom_{};              // of the bottom
  int read_ = 0;                             // unknown of the potential that is read
  std::array<Eigen::MatrixXd, 3> by_power_;  // the matrix in powers of k times the unit of length
};

// Compliance of a half-space for normal loads, w/t_z = 2 (1 - nu^2)/(E k), m/Pa.
double half_space_compliance_m_Pa(double young_modulus_Pa, double poisson_ratio, double k_1_m);

}  // namespace viscard
