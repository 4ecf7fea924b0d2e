#include "io/config/config_show.h"

namespace viscard {
namespace {

using enum Range;

// The sections of single protocols. A section is required if its protocol is selected.
void show_protocols(FieldVisitor& fields, TestPlan& plan) {
  fields.section("preload", [&](FieldVisitor& inner) {
    inner.quantity({"force", quantities::kBenchForce, kNotNegative}, plan.preload_N);
    inner.quantity({"hold", quantities::kHold, kNotNegative}, plan.preload_s);
  });
  fields.list(
      "levels", plan.levels.size(), [&](std::size_t size) { plan.levels.assign(size, {}); },
      [&](FieldVisitor& inner, std::size_t i) {
        inner.quantity({"depth", quantities::kDepth, kNotNegative, true}, plan.levels[i].depth_m);
        inner.quantity({"duration", quantities::kRamp, kPositive}, plan.levels[i].ramp_s);
        inner.quantity({"hold", quantities::kHold, kNotNegative}, plan.levels[i].hold_s);
      });
  fields.section("creep", [&](FieldVisitor& inner) {
    inner.quantity({"force", quantities::kBenchForce, kNotNegative, plan.protocol == "creep"},
                   plan.creep.force_N);
    inner.quantity({"duration", quantities::kRamp, kPositive}, plan.creep.ramp_s);
    inner.quantity({"hold", quantities::kHold, kPositive}, plan.creep.hold_s);
    inner.quantity({"tolerance", "N", kNotNegative}, plan.creep.tolerance_N);
    inner.quantity({"depth_limit", quantities::kDepth, kNotNegative}, plan.creep.depth_limit_m);
  });
  fields.section("cycles", [&](FieldVisitor& inner) {
    inner.integer("count", 1, 100000, plan.cycles.count);
    inner.quantity({"depth", quantities::kDepth, kNotNegative, plan.protocol == "cycles"},
                   plan.cycles.depth_m);
    inner.quantity({"duration", quantities::kRamp, kPositive}, plan.cycles.ramp_s);
    inner.quantity({"hold", quantities::kHold, kNotNegative}, plan.cycles.hold_s);
    inner.quantity({"rest", quantities::kHold, kNotNegative}, plan.cycles.rest_s);
    inner.quantity({"unload_to_fraction", "1", kFraction}, plan.cycles.unload_to_fraction);
  });
  fields.section("compliance", [&](FieldVisitor& inner) {
    inner.integer("steps", 3, 1000, plan.compliance.steps);
    inner.quantity({"force", quantities::kBenchForce, kNotNegative, plan.protocol == "compliance"},
                   plan.compliance.force_N);
    inner.quantity({"hold", quantities::kHold, kPositive}, plan.compliance.hold_s);
  });
  fields.section("staircase", [&](FieldVisitor& inner) {
    inner.integer("steps", 1, 10000, plan.staircase.steps);
    inner.quantity({"depth", quantities::kDepth, kNotNegative, plan.protocol == "staircase"},
                   plan.staircase.depth_m);
    inner.quantity({"duration", quantities::kRamp, kPositive}, plan.staircase.step_s);
    inner.quantity({"hold", quantities::kHold, kNotNegative}, plan.staircase.hold_s);
    inner.boolean("down", plan.staircase.is_down_too);
  });
}

}  // namespace

void show_test(FieldVisitor& fields, TestPlan& plan) {
  fields.text({"name", "stress relaxation"}, plan.name);
  fields.section("approach", [&](FieldVisitor& inner) {
    inner.quantity({"speed", "m/s", kPositive}, plan.approach_speed_m_s);
    inner.quantity({"limit", "m", kPositive}, plan.approach_limit_m);
    inner.quantity({"surface", "m", kNotNegative}, plan.surface_m);
    inner.quantity({"surface_margin", "m", kPositive}, plan.surface_margin_m);
    inner.quantity({"contact_force", quantities::kBenchForce, kPositive}, plan.contact_force_N);
    inner.quantity({"gap", quantities::kDepth, kNotNegative}, plan.gap_m);
    inner.quantity({"baseline", quantities::kHold, kNotNegative}, plan.baseline_s);
  });
  fields.text({"protocol", "ramp-hold"}, plan.protocol);
  show_protocols(fields, plan);
  const bool is_ramp_hold = plan.protocol == "ramp-hold";
  fields.section("ramp", [&](FieldVisitor& inner) {
    inner.quantity({"depth", quantities::kDepth, kPositive, is_ramp_hold}, plan.depth_m);
    inner.quantity({"duration", quantities::kRamp, kPositive}, plan.ramp_s);
    inner.quantity({"hold", quantities::kHold, kNotNegative}, plan.hold_s);
  });
  fields.section("recovery", [&](FieldVisitor& inner) {
    inner.quantity({"unload_to_fraction", "1", kFraction}, plan.unload_to_fraction);
    inner.quantity({"unload_speed", "m/s", kPositive}, plan.unload_speed_m_s);
    inner.quantity({"hold", quantities::kHold, kNotNegative}, plan.recovery_s);
  });
  fields.section("retract", [&](FieldVisitor& inner) {
    inner.quantity({"speed", "m/s", kPositive}, plan.retract_speed_m_s);
    inner.quantity({"distance", "m", kPositive}, plan.retract_m);
  });
}

}  // namespace viscard
