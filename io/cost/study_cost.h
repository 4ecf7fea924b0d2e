#pragma once

#include "io/cost/cost_clock.h"
#include "models/pillar/mesh/pillar_mesh.h"
#include "models/scene/scene.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

struct CostTrials;

// What accuracy costs: one scene on many discretisations, with effects on and off, each compared
// with an answer on a finer mesh with all effects on.
struct CostRow {
  std::string discretisation;  // "h1 5 um", "p4", "graded p5, 2 layers"
  std::string effects;         // "all on", "without film_compliance"
  Discretisation mesh;
  int unknowns = 0;          // of the largest system
  double cpu_s = 0.0;        // processor time, median of repeats; rows are ranked by it
  double wall_s = 0.0;       // median of repeats
  double memory_B = 0.0;     // rise of the resident set at its peak; 0: below one page or unknown
  double error = 0.0;        // largest relative one of what is asked for
  bool is_on_front = false;  // no other row takes less processor time and is as accurate
};

// A row that did not fit into the budget, as the model of cost predicts it.
struct PredictedRow {
  std::string discretisation, effects;
  // Number of unknowns, processor time and memory.
  double unknowns = 0.0, cpu_s = 0.0, memory_B = 0.0;
};

// A row whose mesh has no answer, such as one too coarse for Newton's method.
struct FailedRow {
  std::string discretisation, effects, reason;
};

// Which row to take for one tolerance.
struct CostAdvice {
  double tolerance = 0.0;
  std::string text;  // one line, also if no row is accurate enough
  int row = -1;      // of the cheapest that is; its error is at most half the tolerance
};

// Processor time of one kind of elements, cpu_s = fixed_s + seconds * unknowns^exponent.
struct CostLaw {
  std::string kind;       // "h1", "h2", "p", "graded p"
  double fixed_s = 0.0;   // that no mesh changes
  double seconds = 0.0;   // of a system with one unknown
  double exponent = 0.0;  // of the number of unknowns
};

// Error against time over discretisations.
struct CostStudy {
  std::vector<CostRow> rows;
  std::vector<PredictedRow> predicted;
  std::vector<FailedRow> failed;
  std::vector<CostLaw> laws;  // that predicted them, of the kinds that have two rows or more
  std::vector<CostAdvice> advice;
  std::vector<std::string> notes;  // remarks for the reader, plain sentences
  std::string reference;           // discretisation of the answer that errors refer to
  // Relative: the change of the reference from a lower degree, and what every mesh has (steps, modes left out).
  double reference_error = 0.0;
  std::string why_alone;   // why there is no lower degree; empty if there is
  int left_out = 0;        // rows for which the budget was too short
  double tolerance = 0.0;  // of the scene
  double budget_s = 0.0;
  double wall_s = 0.0;  // of the whole study
  CostMachine machine;
};

// Shows all keys of it to a visitor.
void show_keys(ResultVisitor& v, const CostStudy& study);

// How long a study may take.
struct CostOptions {
  double budget_s = 60.0;                                    // of wall time
  std::optional<double> cpu_budget_s = {};                   // of processor time as well
  int repeats = 3;                                           // of rows that take less than 0.3 s
  std::function<void(double, const std::string&)> progress;  // fraction, row; may be empty
  CostClock clock = process_clock();
};

// How much longer plain linear elements ("h1" rows) take to an error than the quickest row that has
// it. Between and beyond the h1 rows the time is read off the straight line through the nearest two
// in log error against log time, as errors fall with a power of the mesh size.
struct LinearFactor {
  double error = 0.0;            // relative, to which both are compared
  double factor = 0.0;           // of processor times
  bool is_extrapolated = false;  // finer linear meshes than any that were run
  std::string quickest;          // discretisation it is compared with
};
// Empty if no row reaches the error or fewer than two h1 rows have errors that fall with the mesh.
std::optional<LinearFactor> factor_over_linear(const CostStudy& study, double error);

// Ends within the budgets: a row, or a finer reference, only starts if the model of cost predicts that it
// ends in time, and what takes longer is ended and counts as predicted. One row of linear elements and the
// coarsest reference start in any case, and so do three cheap rows that take less than 0.1 s each. A mesh without an answer does not end
// the study. Throws what simulate() throws for a scene that contradicts itself, and std::runtime_error if no
// reference, or no row, has an answer within the budgets.
CostStudy study_cost(const Scene& scene, const CostOptions& options);
CostStudy study_of(const CostTrials& trials, const CostOptions& options);

// Marks the front and writes the advice of a study whose rows are complete.
void rank_by_processor_time(CostStudy& study);

}  // namespace viscard
