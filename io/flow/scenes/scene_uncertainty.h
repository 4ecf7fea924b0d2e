#pragma once

#include "io/flow/scenes/uncertain_scene.h"
#include "models/answer/scene_answer.h"
#include "models/maths/interval.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// Share of one input in the variance of one result.
struct CauseShare {
  double share = 0.0;           // of this input alone
  double with_others = 0.0;     // and jointly with other inputs
  double standard_error = 0.0;  // of a sampled share
};

// Effect of the inputs of a scene on one result, beside the error of the computation.
struct ResultUncertainty {
  std::string name, unit;
  double value = 0.0;
  double numerical_error = 0.0;  // of the answer, in the unit
  double standard_uncertainty = 0.0;
  Interval interval_95;     // infinite if there is none
  std::string no_interval;  // why there is none; empty: there is one
  double end_error =
      0.0;  // of the ends of an interval that is not linear: standard error of samples, or largest
            // difference of a curved answer to the scene's own
  double linear_disagreement =
      0.0;                         // of the linear answer at the ends of the interval, in the unit
  std::vector<CauseShare> causes;  // one for each input
};

struct SceneUncertainty {
  std::vector<UncertainInput> inputs;
  std::vector<std::string> descriptions;  // of the inputs
  std::vector<ResultUncertainty> results;
  bool is_sampled = false;
  bool is_curved = false;  // quadratic in the inputs, or in the logarithm
  // linear, quadratic or sobol
  const char* method() const { return is_sampled ? "sobol" : is_curved ? "quadratic" : "linear"; }
  std::string reason;  // why the result is sampled, or why it is not
  // Of each input: its derivatives come from the solver, which reuses one solution; otherwise they are
  // differences of answers.
  std::vector<bool> by_solver;
  std::size_t n_answers = 0, n_failed = 0;
  double failed_share = 0.0;      // of the samples of the intervals, largest of all results
  std::size_t n_first_order = 0;  // answers that reuse the solution, not among n_answers
  Discretisation mesh;            // that was sampled on
  double mesh_error = 0.0;        // of deviations on it, relative to the standard uncertainty
  double slope_error = 0.0;       // largest, likewise
  std::vector<std::string> notes;
};

// Share of the variance that inputs cause only together.
double share_jointly(const ResultUncertainty& result);
void show_keys(ResultVisitor& v, const SceneUncertainty& uncertainty);

struct UncertaintyOptions {
  std::optional<std::size_t> n_samples;  // sampled with so many answers; otherwise the plan decides
  std::function<void(double)> progress;  // called with the fraction done; may be empty
};

// Intervals of the results of an answer and their causes. Linear in the inputs where that differs from
// the scene's own answers by less than the tolerance; else quadratic, or quadratic in the logarithm, where that differs
// by less than samples would leave of the interval's width; sampled on a Sobol' sequence otherwise. `answer` is
// that of the scene. Throws std::runtime_error naming the file.
SceneUncertainty scene_uncertainty(const UncertainScene& scene, const SceneAnswer& answer,
                                   const UncertaintyOptions& options);

}  // namespace viscard
