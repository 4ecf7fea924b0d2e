#include "models/experiment/test_phases.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

using Kind = TestPhase::Kind;

constexpr double kPreload_s = 2.0;  // to reach the preload
constexpr double kTare_s = 1.0;
constexpr double kRetract_s = 1.0;

void require_plan(bool is_good, const std::string& text) {
  if (!is_good) throw std::invalid_argument("the test file: " + text);
}

// "ramp", or "ramp_2" if there are several.
std::string numbered(const std::string& name, std::size_t i, std::size_t n) {
  return n > 1 ? name + "_" + std::to_string(i + 1) : name;
}

TestPhase wait(std::string name, double duration_s, std::string text) {
  return {.kind = Kind::kWait,
          .name = std::move(name),
          .text = std::move(text),
          .duration_s = duration_s};
}

TestPhase move(std::string name, std::string purpose, double depth_m, double move_s,
               std::string load_key, std::string speed_key, std::string text) {
  return {.kind = Kind::kMove,
          .name = std::move(name),
          .purpose = std::move(purpose),
          .text = std::move(text),
          .depth_m = depth_m,
          .move_s = move_s,
          .load_key = std::move(load_key),
          .speed_key = std::move(speed_key)};
}

TestPhase by_force(Kind kind, std::string name, std::string purpose, double force_N, double move_s,
                   double duration_s, std::string load_key, std::string text) {
  return {.kind = kind,
          .name = std::move(name),
          .purpose = std::move(purpose),
          .text = std::move(text),
          .force_N = force_N,
          .move_s = move_s,
          .duration_s = duration_s,
          .load_key = std::move(load_key)};
}

void add_ramp_hold(const TestPlan& plan, std::vector<TestPhase>& phases) {
  require_plan(plan.depth_m > 0.0 && plan.ramp_s > 0.0 && plan.hold_s >= 0.0,
               "depth and duration under [ramp] must be positive and hold not negative");
  phases.push_back(move("ramp", "ramp", plan.depth_m, plan.ramp_s, "depth under [ramp]",
                        "duration under [ramp]", "To full depth at constant speed"));
  phases.push_back(wait("hold", plan.hold_s, "Relaxation at full depth"));
  if (!(plan.recovery_s > 0.0)) return;
  require_plan(plan.unload_to_fraction >= 0.0 && plan.unload_to_fraction < 1.0,
               "unload_to_fraction under [recovery] must lie in [0, 1)");
  TestPhase unload = move("unload", "unload", plan.unload_to_fraction * plan.depth_m, 0.0, "", "",
                          "Quickly to a part of the depth, still in contact");
  unload.speed_m_s = plan.unload_speed_m_s;
  phases.push_back(unload);
  phases.push_back(wait("recovery", plan.recovery_s, "Hold after the unloading"));
}

void add_levels(const TestPlan& plan, std::vector<TestPhase>& phases) {
  const std::size_t n = plan.levels.size();
  require_plan(n > 0, "protocol \"levels\" needs [[levels]], each with depth, duration and hold");
  double before_m = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const DepthLevel& level = plan.levels[i];
    const std::string where = "level " + std::to_string(i + 1) + " under [[levels]]";
    require_plan(level.depth_m >= 0.0 && level.ramp_s > 0.0 && level.hold_s >= 0.0,
                 where + ": depth and hold must not be negative, and duration positive");
    require_plan(level.depth_m != before_m, where + ": the depth must differ from the one before");
    const bool is_up = level.depth_m > before_m;
    phases.push_back(move(numbered(is_up ? "ramp" : "unload", i, n), is_up ? "ramp" : "unload",
                          level.depth_m, level.ramp_s, "depth of " + where, "duration of " + where,
                          "To level " + std::to_string(i + 1)));
    phases.push_back(wait(numbered("hold", i, n), level.hold_s, "Relaxation at that level"));
    before_m = level.depth_m;
  }
}

void add_creep(const TestPlan& plan, std::vector<TestPhase>& phases) {
  const CreepPlan& creep = plan.creep;
  require_plan(creep.force_N > 0.0 && creep.ramp_s > 0.0 && creep.hold_s > 0.0,
               "force, duration and hold under [creep] must be positive");
  require_plan(creep.tolerance_N >= 0.0 && creep.tolerance_N < creep.force_N,
               "tolerance under [creep] must be between 0 and the force");
  phases.push_back(by_force(Kind::kLoad, "ramp", "ramp", creep.force_N, creep.ramp_s, 0.0,
                            "force under [creep]", "To the force"));
  phases.back().speed_key = "duration under [creep]";
  phases.push_back(by_force(Kind::kHoldForce, "creep", "creep", creep.force_N, 0.0, creep.hold_s,
                            "force under [creep]", "Creep under constant force"));
}

void add_cycles(const TestPlan& plan, std::vector<TestPhase>& phases) {
  const CyclePlan& cycles = plan.cycles;
  require_plan(cycles.count > 0 && cycles.depth_m > 0.0 && cycles.ramp_s > 0.0,
               "count, depth and duration under [cycles] must be positive");
  require_plan(cycles.hold_s >= 0.0 && cycles.rest_s >= 0.0,
               "hold and rest under [cycles] must not be negative");
  require_plan(cycles.unload_to_fraction >= 0.0 && cycles.unload_to_fraction < 1.0,
               "unload_to_fraction under [cycles] must lie in [0, 1)");
  const auto n = static_cast<std::size_t>(cycles.count);
  for (std::size_t i = 0; i < n; ++i) {
    phases.push_back(move(numbered("load", i, n), i == 0 ? "ramp" : "load", cycles.depth_m,
                          cycles.ramp_s, "depth under [cycles]", "duration under [cycles]",
                          "Loading, cycle " + std::to_string(i + 1)));
    if (cycles.hold_s > 0.0) {
      phases.push_back(wait(numbered("hold", i, n), cycles.hold_s, "Hold at full depth"));
    }
    phases.push_back(move(numbered("unload", i, n), "unload",
                          cycles.unload_to_fraction * cycles.depth_m, cycles.ramp_s, "",
                          "duration under [cycles]", "Unloading, cycle " + std::to_string(i + 1)));
    if (cycles.rest_s > 0.0) {
      phases.push_back(wait(numbered("rest", i, n), cycles.rest_s, "Rest after unloading"));
    }
  }
}

void add_staircase(const TestPlan& plan, std::vector<TestPhase>& phases) {
  const StaircasePlan& stairs = plan.staircase;
  require_plan(
      stairs.steps > 0 && stairs.depth_m > 0.0 && stairs.step_s > 0.0 && stairs.hold_s >= 0.0,
      "steps, depth and duration under [staircase] must be positive, and hold not negative");
  const int n_down = stairs.is_down_too ? stairs.steps - 1 : 0;
  const auto n = static_cast<std::size_t>(stairs.steps + n_down);
  for (std::size_t i = 0; i < n; ++i) {
    const int step = static_cast<int>(i) + 1;
    const bool is_up = step <= stairs.steps;
    const double share = static_cast<double>(is_up ? step : 2 * stairs.steps - step) / stairs.steps;
    phases.push_back(move(numbered("step", i, n), is_up ? "ramp" : "unload", share * stairs.depth_m,
                          stairs.step_s, "depth under [staircase]", "duration under [staircase]",
                          std::string(is_up ? "Up" : "Down") + " to step " +
                              std::to_string(is_up ? step : 2 * stairs.steps - step)));
    phases.push_back(wait(numbered("hold", i, n), stairs.hold_s, "On that step"));
  }
}

void add_compliance(const TestPlan& plan, std::vector<TestPhase>& phases) {
  const CompliancePlan& block = plan.compliance;
  require_plan(block.steps > 2 && block.force_N > 0.0 && block.hold_s > 0.0,
               "force and hold under [compliance] must be positive, and steps at least 3");
  const auto n = static_cast<std::size_t>(block.steps);
  for (std::size_t i = 0; i < n; ++i) {
    const double force_N = block.force_N * static_cast<double>(i + 1) / block.steps;
    phases.push_back(by_force(Kind::kLoad, numbered("press", i, n), "ramp", force_N, 1.0, 0.0,
                              "force under [compliance]", "Pressing harder"));
    phases.push_back(wait(numbered("hold", i, n), block.hold_s, "At that force"));
  }
}

double largest(const std::vector<TestPhase>& phases, double TestPhase::*member) {
  double largest = 0.0;
  for (const TestPhase& phase : phases) largest = std::max(largest, phase.*member);
  return largest;
}

using AddPhases = void (*)(const TestPlan&, std::vector<TestPhase>&);
constexpr std::pair<const char*, AddPhases> kProtocols[] = {
    {"ramp-hold", add_ramp_hold}, {"levels", add_levels},       {"creep", add_creep},
    {"cycles", add_cycles},       {"staircase", add_staircase}, {"compliance", add_compliance}};

AddPhases protocol_named(const std::string& name) {
  std::string known;
  for (const auto& [word, add] : kProtocols) {
    if (name == word) return add;
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  throw std::invalid_argument("protocol '" + name + "' of the test file is unknown; known are " +
                              known);
}

}  // namespace

std::vector<TestPhase> phases_from_plan(const TestPlan& plan) {
  require_plan(
      plan.approach_speed_m_s > 0.0 && plan.unload_speed_m_s > 0.0 && plan.retract_speed_m_s > 0.0,
      "all speeds must be positive");
  require_plan(plan.contact_force_N > 0.0 && plan.gap_m > 0.0 && plan.retract_m >= plan.gap_m,
               "contact_force and gap under [approach] must be positive, and distance under "
               "[retract] not below gap");
  require_plan(plan.preload_N >= 0.0 && plan.preload_s >= 0.0,
               "force and hold under [preload] must not be negative");
  const AddPhases add = protocol_named(plan.protocol);
  std::vector<TestPhase> phases;
  phases.push_back(wait("tare", kTare_s, "Zero of the load cell"));
  phases.back().kind = Kind::kTare;
  phases.push_back(wait("approach", 0.0, "In short jogs until the punch touches"));
  phases.back().kind = Kind::kApproach;
  phases.push_back(wait("baseline", plan.baseline_s, "Out of contact, before the test"));
  if (plan.preload_N > 0.0) {
    phases.push_back(by_force(Kind::kLoad, "preload", "preload", plan.preload_N, kPreload_s, 0.0,
                              "force under [preload]", "To the preload"));
    phases.push_back(by_force(Kind::kHoldForce, "preload_hold", "preload", plan.preload_N, 0.0,
                              plan.preload_s, "force under [preload]", "At the preload"));
  }
  add(plan, phases);
  phases.push_back(wait("retract", kRetract_s, "Off the specimen"));
  phases.back().kind = Kind::kRetract;
  phases.push_back(wait("baseline_after", plan.baseline_s, "Out of contact, after the test"));
  return phases;
}

double deepest_m(const std::vector<TestPhase>& phases) {
  return largest(phases, &TestPhase::depth_m);
}

double highest_force_N(const std::vector<TestPhase>& phases) {
  return largest(phases, &TestPhase::force_N);
}

double planned_s(const std::vector<TestPhase>& phases, std::size_t from, double approach_s) {
  double sum_s = 0.0;
  for (std::size_t i = from; i < phases.size(); ++i) {
    const TestPhase& phase = phases[i];
    sum_s += phase.duration_s + phase.move_s + (phase.kind == Kind::kApproach ? approach_s : 0.0);
  }
  return sum_s;
}

}  // namespace viscard
