#pragma once

#include "models/array/film/layered_film.h"
#include "models/maths/chebyshev_panel.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

namespace viscard {

// The answers of a film on a backing to waves of any length, along L + 1 directions between 0 and 90
// degrees: samples of FilmWaves on panels that halve toward long waves, and polynomials between them. A
// soft backing lets the film bend and stretch over many times its thickness, so that long waves matter.
class FilmTable {
 public:
  // Waves up to k t = largest_kt, t the thickness of all layers, for loads whose effect reaches up
  // to `far_m`; harmonics L and degree as in PotentialAccuracy (models/array/space).
  FilmTable(const LayeredFilm& film, double largest_kt, int harmonics, int degree, double far_m);

  // FilmWaves::response by direction. Waves longer than the panels are solved directly.
  std::vector<Eigen::Matrix4d> at(double k_1_m) const;
  // Calls with(angle, share, response) for these directions; the shares are those of a mean over all angles.
  template <typename With>
  void each_direction(double k_1_m, const With& with) const {
    const std::vector<Eigen::Matrix4d> responses = at(k_1_m);
    const auto last = static_cast<double>(responses.size() - 1);
    for (std::size_t j = 0; j < responses.size(); ++j) {
      const bool is_end = j == 0 || j + 1 == responses.size();
      with(0.5 * std::numbers::pi * static_cast<double>(j) / last, (is_end ? 0.5 : 1.0) / last,
           responses[j]);
    }
  }
  double smallest_k_1_m() const { return panels_.breaks().front(); }
  double largest_k_1_m() const { return panels_.breaks().back(); }
  double far_m() const { return far_m_; }

 private:
  std::vector<FilmWaves> directions_;
  double far_m_ = 0.0;
  ChebyshevPanels panels_;  // 16 entries of each direction
};

// Calls with(k, weight of k dk/(2 pi)) for panels that double from the longest waves on, until they are
// as long as `longest`.
void each_graded_wave(double smallest_1_m, double largest_1_m, double longest_1_m,
                      const std::function<void(double k_1_m, double weight_1_m2)>& with);

// Weight that lets the shortest waves fade out: rises smoothly from 0 to 1 with of_largest, the
// wave number over the largest one. The error of truncation at neighbours then decreases with the
// distance.
constexpr double kCutFrom = 0.5;  // of the largest k, where it begins to rise
double cut(double of_largest);

}  // namespace viscard
