#include "models/pillar/time/load_history.h"

#include "models/answer/scene_mistake.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

// Length of the first block after a corner over the fastest relaxation time. The polynomials of the
// stepper have a low order there, so the start must be this short to keep their error negligible.
constexpr double kFirstBlock = 1e-3;

// Equal steps from start to end, during which the controlled value is linear.
struct Block {
  double start_s = 0.0, end_s = 0.0;  // equal: a jump
  double first = 0.0, last = 0.0;     // controlled value
  bool after_corner = false;          // the rate of loading jumps at the start
};

// Ends of blocks in (start, end]: doubling from the fastest time, and including the wanted times.
std::vector<double> block_ends(double start_s, double end_s, double first_s,
                               const std::vector<double>& wanted_s) {
  std::vector<double> ends;
  for (double length_s = first_s; start_s + length_s < end_s && length_s < end_s - start_s;
       length_s *= 2.0) {
    // A time equal to the last one in double precision would make an empty step.
    if (start_s + length_s > (ends.empty() ? start_s : ends.back()))
      ends.push_back(start_s + length_s);
  }
  for (const double time_s : wanted_s) {
    if (time_s > start_s && time_s < end_s) ends.push_back(time_s);
  }
  ends.push_back(end_s);
  std::sort(ends.begin(), ends.end());
  // Merge times so close that a step between them would be lost in rounding.
  std::vector<double> kept;
  for (const double time_s : ends) {
    if (!kept.empty() && time_s - kept.back() <= 1e-12 * time_s)
      kept.back() = time_s;
    else
      kept.push_back(time_s);
  }
  return kept;
}

std::vector<Block> blocks_of(const Course& history, double first_s,
                             const std::vector<double>& wanted_s) {
  validate_history(history);
  if (history.size() < 2 || history.front().time_s != 0.0 || !(history.back().time_s > 0.0)) {
    throw std::invalid_argument("a load history starts at 0 s and ends later");
  }
  std::vector<Block> blocks;
  if (history.front().value != 0.0) blocks.push_back({0.0, 0.0, 0.0, history.front().value});
  for (std::size_t i = 1; i < history.size(); ++i) {
    const CoursePoint& from = history[i - 1];
    const CoursePoint& to = history[i];
    if (to.time_s == from.time_s) {
      blocks.push_back({to.time_s, to.time_s, from.value, to.value});
      continue;
    }
    const double slope = (to.value - from.value) / (to.time_s - from.time_s);
    double start_s = from.time_s;
    double start_value = from.value;
    for (const double end_s : block_ends(from.time_s, to.time_s, first_s, wanted_s)) {
      const double end_value =
          end_s == to.time_s ? to.value : from.value + slope * (end_s - from.time_s);
      blocks.push_back({start_s, end_s, start_value, end_value, start_s == from.time_s});
      start_s = end_s;
      start_value = end_value;
    }
  }
  return blocks;
}

// Outputs x times of one run with n steps per block, at the times of the coarsest level.
struct Run {
  Eigen::MatrixXd values;  // force, displacement, observers
  std::vector<double> time_s;
  int steps = 0;
  int factorisations = 0;
};

Run run_once(const ViscoelasticSystem& system, Control control, const std::vector<Block>& blocks,
             int first_steps, int refinement, const HistoryOptions& options) {
  Run run;
  ViscoelasticStepper stepper(system, options.order);
  std::vector<Eigen::VectorXd> rows;
  const auto record = [&](double time_s) {
    Eigen::VectorXd row(static_cast<Eigen::Index>(2 + options.observers.size()));
    row[0] = stepper.force();
    row[1] = stepper.displacement();
    for (std::size_t i = 0; i < options.observers.size(); ++i) {
      row[static_cast<Eigen::Index>(i + 2)] =
          options.observers[i].dot(stepper.displacement_vector());
    }
    run.time_s.push_back(time_s);
    rows.push_back(row);
  };
  record(0.0);
  for (const Block& block : blocks) {
    if (block.after_corner) stepper.start_anew();
    const bool is_jump = block.end_s == block.start_s;
    const int steps = is_jump ? 1 : first_steps * refinement;
    const double dt_s = (block.end_s - block.start_s) / steps;
    for (int step = 1; step <= steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      stepper.advance(dt_s, control, block.first + share * (block.last - block.first));
      if (is_jump || step % refinement == 0)
        record(block.start_s + share * (block.end_s - block.start_s));
    }
    run.steps += steps;
  }
  run.factorisations = stepper.factorisations();
  run.values.resize(rows.front().size(), static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    run.values.col(static_cast<Eigen::Index>(i)) = rows[i];
  return run;
}

double largest_relative_change(const Eigen::MatrixXd& now, const Eigen::MatrixXd& before,
                               double floor) {
  double largest = 0.0;
  for (Eigen::Index row = 0; row < now.rows(); ++row) {
    const double scale = floor * now.row(row).cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < now.cols(); ++i) {
      const double change = std::abs(now(row, i) - before(row, i));
      if (change > 0.0)
        largest = std::max(largest, change / std::max(std::abs(now(row, i)), scale));
    }
  }
  return largest;
}

std::vector<double> row_of(const Eigen::MatrixXd& values, Eigen::Index row) {
  const Eigen::VectorXd out = values.row(row);
  return {out.begin(), out.end()};
}

}  // namespace

void validate_history(const Course& history) {
  for (std::size_t i = 0; i < history.size(); ++i) {
    const CoursePoint& point = history[i];
    const std::string key = "analysis.history." + std::to_string(i + 1);
    if (!std::isfinite(point.time_s) || !std::isfinite(point.value)) {
      throw SceneMistake(key, "point " + std::to_string(i + 1) + " of the history is not finite");
    }
    const double last_s = i == 0 ? 0.0 : history[i - 1].time_s;
    if (point.time_s < last_s) {
      throw SceneMistake(key, "point " + std::to_string(i + 1) +
                                  " of the history goes back in time, from " + text_of(last_s) +
                                  " s to " + text_of(point.time_s) +
                                  " s; put the points in order (a time given twice is a jump)");
    }
  }
}

HistoryResult run_history(const ViscoelasticSystem& system, Control control, const Course& history,
                          const HistoryOptions& options) {
  const std::vector<Block> blocks = blocks_of(
      history, kFirstBlock * relaxation_times(system.terms).fastest_s, options.output_times_s);
  HistoryResult result;
  Eigen::MatrixXd values;
  // One order less than that of the stepper: the order observed for a dense spectrum.
  const double gain_of_halving = std::max(1.0, std::exp2(options.order - 1) - 1.0);
  bool has_stalled = false;
  const int first_level = options.only_level.value_or(0);
  for (int level = first_level; level < options.max_levels && !result.converged && !has_stalled;
       ++level) {
    const Run run = run_once(system, control, blocks, options.first_steps, 1 << level, options);
    result.steps += run.steps;
    result.factorisations += run.factorisations;
    result.time_s = run.time_s;
    result.level = level;
    if (options.only_level) {
      result.converged = true;
    } else if (level > 0) {
      const double last = result.error_estimate;
      result.error_estimate =
          largest_relative_change(run.values, values, options.relative_floor) / gain_of_halving;
      result.converged = result.error_estimate <= options.tolerance;
      has_stalled = level > 1 && result.error_estimate > 0.5 * last;  // rounding, not step size
    }
    values = run.values;
  }
  result.force = row_of(values, 0);
  result.displacement = row_of(values, 1);
  for (Eigen::Index i = 2; i < values.rows(); ++i) result.observed.push_back(row_of(values, i));
  return result;
}

}  // namespace viscard
