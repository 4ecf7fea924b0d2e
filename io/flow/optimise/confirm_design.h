#pragma once

#include "io/flow/design/judge_scene.h"
#include "io/flow/optimise/solved_values.h"

#include <string>
#include <vector>

namespace viscard {

// An objective at the design, from the solver.
struct DesignedObjective {
  std::string quantity, unit;
  double value = 0.0, error_estimate = 0.0;
};

// A design and what the solver finds of it, with its values rounded to four digits.
struct OptimisedDesign {
  StudyValues values;                 // of the choices, then of the ranges
  std::string scene_text;             // beside the specification's scene
  Judgement judgement;                // of that scene, at its own tolerance
  std::vector<double> probabilities;  // of each line; empty: not asked
  std::vector<DesignedObjective> objectives;
  bool is_feasible = false;  // all lines pass, with the probability that is asked
  // Feasible: the limits and ends of ranges that hold the design. Otherwise those that stop every design: the
  // limits that fail, and what holds the others.
  std::vector<std::string> active;
  std::size_t n_solved = 0;  // quantities that were solved
};

// Judges the scene at a point, its dimensions rounded, at the scene's own tolerance, and names the limits that hold
// it or stop it.
OptimisedDesign confirmed_design(const DesignSpec& spec, const DesignSpace& space,
                                 const SolvedValues& solved, const DesignPoint& point);

// Of the standard normal distribution: the deviate below which this share lies.
double deviate_of(double probability);

}  // namespace viscard
