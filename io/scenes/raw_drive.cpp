#include "io/scenes/raw_drive.h"

#include "io/scenes/scene_words.h"

#include <cmath>
#include <numbers>

namespace viscard {
namespace {

// Straight pieces that stand for half a sine: they err by (pi/256)^2/8 = 2e-5 of its height.
constexpr int kPulsePieces = 256;

std::vector<HistoryPoint> half_sine(double height, double duration_s) {
  std::vector<HistoryPoint> points;
  for (int i = 0; i <= kPulsePieces; ++i) {
    const double share = static_cast<double>(i) / kPulsePieces;
    points.push_back({share * duration_s, height * std::sin(std::numbers::pi * share)});
  }
  points.back().value = 0.0;
  return points;
}

}  // namespace

void show_drive(FieldVisitor& v, const char* history_unit, RawDrive& d) {
  v.section("load", [&](FieldVisitor& l) {
    l.quantity({.key = "pressure", .unit = "Pa"}, d.pressure_Pa);
    l.quantity({.key = "shear", .unit = "Pa"}, d.shear_Pa);
    l.quantity({.key = "force", .unit = "N"}, d.force_N);
    l.quantity({.key = "displacement", .unit = "m"}, d.displacement_m);
    l.quantity({.key = "acceleration", .unit = "m/s2"}, d.acceleration_m_s2);
    l.quantity({.key = "voltage", .unit = "V"}, d.voltage_V);
    l.text({"on", "top"}, d.load_on);
    l.text({"direction", "axial"}, d.direction);
  });
  show_times(v, d.load_on == "base" ? "m/s2" : history_unit, d);
}

void show_times(FieldVisitor& v, const char* unit, RawDrive& d) {
  v.section("frequencies", [&](FieldVisitor& f) {
    f.quantity({.key = "from", .unit = "Hz", .range = Range::kPositive}, d.from_Hz);
    f.quantity({.key = "to", .unit = "Hz", .range = Range::kPositive}, d.to_Hz);
    f.integer("count", 1, 100000, d.count);
    f.text({"spacing", "log"}, d.spacing);
  });
  v.quantity({.key = "end_time", .unit = "s", .range = Range::kPositive}, d.end_time_s);
  v.integer("outputs", 10, 200000, d.outputs);
  v.section("pulse", [&](FieldVisitor& p) {
    p.quantity({.key = "height", .unit = unit}, d.pulse_height);
    p.quantity({.key = "duration", .unit = "s", .range = Range::kPositive}, d.pulse_duration_s);
  });
  v.quantity_pairs("history", "s", unit, d.history);
}

void show_readout(FieldVisitor& v, RawDrive& d) {
  v.text({"kind", "voltage"}, d.readout);
  v.quantity({.key = "resistance", .unit = "ohm", .range = Range::kPositive}, d.resistance_Ohm);
  v.quantity({.key = "capacitance", .unit = "F", .range = Range::kPositive}, d.capacitance_F);
  v.quantity({.key = "film_resistivity", .unit = "ohm m", .range = Range::kPositive},
             d.film_resistivity_Ohm_m);
}

std::vector<double> frequencies_of(const RawDrive& raw) {
  std::vector<double> frequencies_Hz;
  if (raw.from_Hz == 0.0) return frequencies_Hz;
  const bool is_log =
      choice<bool>("analysis.frequencies.spacing", raw.spacing, {{"log", true}, {"linear", false}});
  const double to_Hz = raw.to_Hz > 0.0 ? raw.to_Hz : raw.from_Hz;
  const auto n = raw.count > 0 ? raw.count : (raw.to_Hz > 0.0 ? 100 : 1);
  if (n > 1 && !(to_Hz > raw.from_Hz)) {
    throw SceneMistake("analysis.frequencies", "'to' must lie above 'from'");
  }
  for (std::int64_t i = 0; i < n; ++i) {
    const double share = n == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(n - 1);
    frequencies_Hz.push_back(is_log ? raw.from_Hz * std::pow(to_Hz / raw.from_Hz, share)
                                    : raw.from_Hz + share * (to_Hz - raw.from_Hz));
  }
  return frequencies_Hz;
}

std::vector<HistoryPoint> history_of(const RawDrive& raw) {
  if (raw.pulse_duration_s > 0.0) {
    if (!raw.history.empty()) {
      throw SceneMistake("analysis.pulse", "a scene has a history or a pulse, not both");
    }
    return half_sine(raw.pulse_height, raw.pulse_duration_s);
  }
  std::vector<HistoryPoint> history;
  for (const auto& [time_s, value] : raw.history) history.push_back({time_s, value});
  validate(history);
  // A history may begin with nothing at time 0 and jump there.
  if (history.size() > 1 && history[0].time_s == history[1].time_s) {
    if (history[0].value == 0.0) history.erase(history.begin());
  }
  return history;
}

}  // namespace viscard
