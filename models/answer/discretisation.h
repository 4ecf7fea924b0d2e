#pragma once

namespace viscard {

// Graded (the default): elements shrink by `ratio` toward the rim of the bond, where the stress is
// singular (clamped-free corner), in `layers` layers in each direction.
struct Discretisation {
  int degree = 4;
  int layers = 2;
  double ratio = 0.15;
  int shaft_elements = 2;   // along the pillar above the graded foot
  int film_elements = 1;    // across the film outside the graded part
  bool grades_top = false;  // toward the top as well, whose rim is singular under a dead pressure
  // Largest element size of the pillar in both directions, about one wavelength; 0: no limit.
  double longest_m = 0.0;
  // For waves that decay: longest_m applies only within this distance of the pillar's side and its
  // top (or foot). Deeper elements may be longer by their extra distance. 0 applies it everywhere.
  double skin_m = 0.0;
  bool skin_at_foot = false;
  // Uniform mesh instead of a graded one: elements of about this size in both directions.
  double uniform_m = 0.0;
};

}  // namespace viscard
