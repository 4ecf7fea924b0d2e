#pragma once

#include "models/array/film/layered_film.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Charge on an equipotential disc on the face of the film that is read (eq. S5), as a sum of modes of
// one harmonic m of the angle, with the transforms j_(m + 2 l)(k a), l = 0, 1, ... Only the first mode of
// m = 0 has a net charge. The film's potential per charge is averaged over the directions.
class DiscCharge {
 public:
  // Harmonics 0 to `harmonics` - 1 with `modes` each (6 give the capacitance to 1e-6).
  DiscCharge(const LayeredFilm& film, double radius_m, int harmonics, int modes, int film_degree);

  double radius_m() const { return radius_m_; }
  int modes() const { return static_cast<int>(influence_.front().rows()); }
  int harmonics() const { return static_cast<int>(influence_.size()); }
  // Of the disc alone, the film free to move.
  double capacitance_F() const { return capacitance_F_; }
  // Transforms of the modes of harmonic m at k.
  Eigen::VectorXd transforms(int harmonic, double k_1_m) const;
  // Transform of the charge at equal potential over its sum: how an open electrode weighs the potential
  // under it.
  double weight(double k_1_m) const;
  // Amplitudes of the additional charge, with zero net charge, that makes the disc equipotential:
  // C/m of the modes. `moments`: of the surrounding potential, sum over the waves of amplitude
  // times transforms(); a column per load. If they are those of the first modes alone, the others
  // have no charge.
  Eigen::MatrixXd induced(int harmonic, const Eigen::MatrixXd& moments) const;

 private:
  void integrate(const LayeredFilm& film, int film_degree);

  double radius_m_;
  std::vector<Eigen::MatrixXd> influence_;  // by harmonic: potential of mode i per charge of mode j
  Eigen::VectorXd at_equal_potential_;      // amplitudes of harmonic 0 at unit charge
  double capacitance_F_ = 0.0;
};

// Potential of the face that is read per charge on it at k, averaged over the directions, V m2/C.
class ChargePotential {
 public:
  ChargePotential(const LayeredFilm& film, double largest_k_1_m, int film_degree);
  // V m2/C at a wave number up to the largest.
  double at(double k_1_m) const;

 private:
  std::vector<FilmWaves> directions_;
};

// The potential p(k) per charge less its limit c/k for short waves, which is that of a half-space: what the other face
// adds, as a sum over waves of weight (k p - c) dk/(2 pi), on panels no longer than `longest`.
struct ScreenedWaves {
  double limit_Vm_C = 0.0;
  std::vector<double> k_1_m, weight;  // the weight of each wave, V/C
};
ScreenedWaves screened_waves(const LayeredFilm& film, double longest_1_m, int film_degree);

}  // namespace viscard
