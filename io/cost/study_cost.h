#pragma once

#include "models/pillar/mesh/pillar_mesh.h"
#include "models/scene/scene.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What accuracy costs: one scene on many discretisations, with effects on and off, each compared
// with an answer on a finer mesh with all effects on.
struct CostRow {
  std::string discretisation;  // "h1 5 um", "p4", "graded p5, 2 layers"
  std::string effects;         // "all on", "without film_compliance"
  Discretisation mesh;
  int unknowns = 0;          // of the largest system
  double wall_s = 0.0;       // median of repeats
  double memory_B = 0.0;     // rise of the resident set at its peak; 0: below one page or unknown
  double error = 0.0;        // largest relative one of what is asked for
  bool is_on_front = false;  // no other row is both faster and more accurate
};

struct CostAdvice {
  double tolerance = 0.0;
  std::string text;  // one line, also if no row is accurate enough
  int row = -1;      // of the cheapest that is; its error is at most half the tolerance
};

struct CostStudy {
  std::vector<CostRow> rows;
  std::vector<CostAdvice> advice;
  double reference_error = 0.0;  // relative change of the reference from one degree less
  int left_out = 0;              // rows for which the budget was too short
};

struct CostOptions {
  double budget_s = 60.0;
  int repeats = 3;                                           // of rows that take less than 0.3 s
  std::function<void(double, const std::string&)> progress;  // fraction, row; may be empty
};

// How much longer plain linear elements ("h1" rows) take to an error than the quickest row that has
// it. Between and beyond the h1 rows the time is read off the straight line through the nearest two
// in log error against log time, as errors fall with a power of the mesh size.
struct LinearFactor {
  double error = 0.0;
  double factor = 0.0;
  bool is_extrapolated = false;  // finer linear meshes than any that were run
  std::string quickest;          // discretisation it is compared with
};
// Empty if no row reaches the error or fewer than two h1 rows have errors that fall with the mesh.
std::optional<LinearFactor> factor_over_linear(const CostStudy& study, double error);

// Throws what simulate() throws for a scene that contradicts itself.
CostStudy study_cost(const Scene& scene, const CostOptions& options);

}  // namespace viscard
