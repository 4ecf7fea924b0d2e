#include "io/scenes/sensing_section.h"

#include "io/scenes/touch_section.h"

#include <cmath>

namespace viscard {
namespace {

void show_conductor(FieldVisitor& v, HeatConductor& one) {
  v.quantity({.key = "conductivity", .unit = "W/m/K", .range = Range::kPositive},
             one.conductivity_W_mK);
  v.quantity({.key = "capacity", .unit = "J/m3/K", .range = Range::kPositive}, one.capacity_J_m3K);
}

bool has_heat(const HeatScene& heat) {
  return heat.temperature_K != 0.0 || heat.pyroelectric_C_m2K != 0.0 ||
         heat.pillar.conductivity_W_mK > 0.0 || heat.film.conductivity_W_mK > 0.0;
}

}  // namespace

void show_heat(FieldVisitor& v, RawSensing& s) {
  v.quantity({.key = "temperature", .unit = "K"}, s.heat.temperature_K);
  v.section("pillar", [&](FieldVisitor& one) { show_conductor(one, s.heat.pillar); });
  v.section("film", [&](FieldVisitor& one) { show_conductor(one, s.heat.film); });
  v.quantity({.key = "pyroelectric", .unit = "C/m2/K"}, s.heat.pyroelectric_C_m2K);
  v.boolean("dummy", s.has_dummy);
  v.quantity({.key = "dummy_ratio"}, s.dummy.ratio);
  v.quantity({.key = "dummy_mismatch"}, s.dummy.mismatch);
  v.quantity({.key = "end_time", .unit = "s", .range = Range::kPositive}, s.heat.end_time_s);
}

void show_noise(FieldVisitor& v, RawSensing& s) {
  v.quantity({.key = "temperature", .unit = "K", .range = Range::kPositive}, s.noise.temperature_K);
  v.quantity({.key = "from", .unit = "Hz", .range = Range::kPositive}, s.noise.from_Hz);
  v.quantity({.key = "to", .unit = "Hz", .range = Range::kPositive}, s.noise.to_Hz);
  v.quantity({.key = "loss_tangent", .range = Range::kNotNegative}, s.noise.loss_tangent);
  v.quantity({.key = "amplifier", .unit = "V", .range = Range::kNotNegative},
             s.noise.amplifier_V_rtHz);
}

void fill_sensing(const RawSensing& raw, const RawDrive& drive, SpaceScene& scene) {
  if (has_heat(raw.heat)) {
    scene.heat = raw.heat;
    if (raw.has_dummy) scene.heat->dummy = raw.dummy;
  }
  if (!(raw.noise.to_Hz > 0.0)) return;
  scene.noise = raw.noise;
  if (!drive.readout.empty()) scene.noise_readout = readout_from(drive, scene);
}

}  // namespace viscard
