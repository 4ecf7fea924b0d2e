#pragma once

#include "models/array/film/layered_film.h"
#include "models/maths/chebyshev_panel.h"

#include <array>
#include <vector>

namespace viscard {

// A layer on the film under a pressure p = exp(i k x) on its face: the sinking of the face, and the
// potential that is read. The potential has the harmonics 0, 2 and 4 of the wave's direction.
struct LayerAnswer {
  double sinking_m_Pa = 0.0;  // without the reference of eq. L2, mean over the directions
  std::array<double, 3> reading_V_Pa{};
};

// The answer at all k, from samples of FilmWaves on panels and polynomials between them (eq. L1).
class LayerWaves {
 public:
  // The stack is the film and one isotropic layer on it. In a plane, waves run along axis 1 only.
  LayerWaves(const LayeredFilm& stack, bool is_plane);

  // The answer at a wave number up to the largest.
  LayerAnswer at(double k_1_m) const;
  double largest_k_1_m() const { return panels_.breaks().back(); }
  double thickness_m() const { return thickness_m_; }        // of the layer
  double reference_m_Pa() const { return reference_m_Pa_; }  // A of eq. L2, times k

  // Relative error of the answers: polynomials against the film at the middle of each panel, and the
  // largest share of the sinking that depends on the direction, which the pressure is solved without.
  double error() const { return error_; }

 private:
  struct Sample {
    LayerAnswer answer;
    double uneven_m_Pa = 0.0;  // largest difference over the directions
  };
  Sample sample(double k_1_m) const;
  void estimate_error();

  std::vector<FilmWaves> directions_;  // at 0, or at 0, 45 and 90 degrees
  double thickness_m_ = 0.0;
  double reference_m_Pa_ = 0.0;
  ChebyshevPanels panels_;  // sinking and readings
  double error_ = 0.0;
};

// The part of the sinking that is known in closed form, divided by A: (1 - exp(-k b))/k, b the
// thickness.
double reference_spectrum_m(double k_1_m, double thickness_m);

}  // namespace viscard
