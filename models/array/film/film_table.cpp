#include "models/array/film/film_table.h"

#include "models/maths/gauss_legendre.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

constexpr int kSamplePoints = 12;  // per panel, which doubles k: 3e-8 of exp(-k t) up to k t = 10
constexpr int kGradedPoints = 8;   // Gauss points per panel of k

// The panels begin at a wave number so small that two effects are negligible below it: waves are far
// longer than t E_film/E, over which the film passes its stretch to the backing, and their phase at
// the farthest pillar is small.
double first_break_1_m(const LayeredFilm& film, double far_m) {
  constexpr double kOfPhase = 0.3, kOfStretch = 0.1;
  double smallest_1_m = kOfPhase / far_m;
  if (film.backing) {
    const FilmLayer& own = film.layers.front();
    smallest_1_m = std::min(smallest_1_m, kOfStretch * film.backing->young_modulus_Pa /
                                              (own.medium.stiffness_Pa(2, 2) * own.thickness_m));
  }
  return smallest_1_m;
}

}  // namespace

FilmTable::FilmTable(const LayeredFilm& film, double largest_kt, int harmonics, int degree,
                     double far_m)
    : far_m_(far_m) {
  const double largest_1_m = largest_kt / thickness_m(film);
  for (int j = 0; j <= harmonics; ++j) {
    directions_.emplace_back(film, 0.5 * std::numbers::pi * j / harmonics, largest_1_m, degree);
  }
  const double first_1_m = std::min(first_break_1_m(film, far_m), 0.5 * largest_1_m);
  const int panels = static_cast<int>(std::ceil(std::log2(largest_1_m / first_1_m)));
  std::vector<double> breaks_1_m;
  for (int panel = panels; panel >= 0; --panel) {
    breaks_1_m.push_back(std::ldexp(largest_1_m, -panel));
  }
  panels_ = ChebyshevPanels(std::move(breaks_1_m), kSamplePoints, [this](double k_1_m) {
    Eigen::RowVectorXd values(16 * static_cast<Eigen::Index>(directions_.size()));
    for (std::size_t j = 0; j < directions_.size(); ++j) {
      const Eigen::Matrix4d response = directions_[j].response(k_1_m);
      values.segment<16>(16 * static_cast<Eigen::Index>(j)) = response.reshaped().transpose();
    }
    return values;
  });
}

std::vector<Eigen::Matrix4d> FilmTable::at(double k_1_m) const {
  std::vector<Eigen::Matrix4d> responses;
  if (k_1_m < smallest_k_1_m()) {
    for (const FilmWaves& direction : directions_) responses.push_back(direction.response(k_1_m));
    return responses;
  }
  const Eigen::RowVectorXd values = panels_.at(k_1_m);
  for (Eigen::Index j = 0; j < values.size(); j += 16) {
    responses.emplace_back(Eigen::Map<const Eigen::Matrix4d>(values.data() + j));
  }
  return responses;
}

void each_graded_wave(double smallest_1_m, double largest_1_m, double longest_1_m,
                      const std::function<void(double k_1_m, double weight_1_m2)>& with) {
  const QuadratureRule rule = gauss_legendre(kGradedPoints);
  double from_1_m = 0.0;
  double to_1_m = std::min({smallest_1_m, longest_1_m, largest_1_m});
  while (from_1_m < largest_1_m * (1.0 - 1e-12)) {
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double k_1_m = from_1_m + (to_1_m - from_1_m) * rule.points[q];
      with(k_1_m, rule.weights[q] * (to_1_m - from_1_m) * k_1_m / (2.0 * std::numbers::pi));
    }
    from_1_m = to_1_m;
    // The rest is shared evenly among panels as long as allowed.
    const double rest_1_m = largest_1_m - from_1_m;
    const double even_1_m = rest_1_m / std::max(1.0, std::ceil(rest_1_m / longest_1_m));
    to_1_m = from_1_m + std::min({from_1_m, even_1_m, rest_1_m});
  }
}

double cut(double of_largest) {
  const double s = std::clamp((of_largest - kCutFrom) / (1.0 - kCutFrom), 0.0, 1.0);
  return s * s * s * s * (35.0 - s * (84.0 - s * (70.0 - 20.0 * s)));
}

}  // namespace viscard
