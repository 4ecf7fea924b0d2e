// What a sensor shows of a surface that slides over it.
#include "io/flow/design/required_values.h"
#include "io/flow/design/single_bodies.h"
#include "models/pillar/analyses/analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscard {
namespace {

// A signal is seen if it is five times the noise. Source: Rose, J. Opt. Soc. Am. 38 (1948) 196.
constexpr double kSeen = 5.0;

RequiredValue no_motion(const std::string& why) {
  return {.how = why};
}

// A curve and its error between the points; the ends' values beyond them.
struct ValueAt {
  double value = 0.0, error = 0.0;
};
ValueAt at_time(const SceneCurve& curve, double time_s) {
  const auto after = std::upper_bound(curve.x.begin(), curve.x.end(), time_s);
  const auto i = static_cast<std::size_t>(after - curve.x.begin());
  const auto error = [&](std::size_t k) { return curve.error.empty() ? 0.0 : curve.error[k]; };
  if (i == 0) return {curve.value.front(), error(0)};
  if (i == curve.x.size()) return {curve.value.back(), error(i - 1)};
  const double share = (time_s - curve.x[i - 1]) / (curve.x[i] - curve.x[i - 1]);
  return {std::lerp(curve.value[i - 1], curve.value[i], share), std::max(error(i - 1), error(i))};
}

// The rms noise of one electrode with its amplifier, under a load at rest.
double noise_V(const SpaceScene& given, const SceneSolver& solve) {
  SpaceScene at_rest = given;
  at_rest.press.reset();
  at_rest.touch.reset();
  at_rest.pressure_Pa = 1.0;
  at_rest.effects.clear();
  at_rest.wanted = {"noise_voltage"};
  const SceneAnswer answer = solve(at_rest);
  const SceneResult* noise = result_in(answer, "noise_voltage");
  return noise == nullptr ? std::numeric_limits<double>::quiet_NaN() : noise->value;
}

SpaceScene scanned(SpaceScene scene, double friction) {
  scene.press->friction_coefficient = friction;
  scene.effects.clear();
  scene.wanted = {"reading"};
  if (std::isfinite(friction)) scene.wanted.emplace_back("slip");
  return scene;
}

// The first time at which a curve is above zero, and the point before it; infinite: never.
struct Onset {
  double time_s = std::numeric_limits<double>::infinity(), step_s = 0.0;
};
Onset onset_of(const SceneCurve& slip) {
  for (std::size_t i = 1; i < slip.x.size(); ++i) {
    if (slip.value[i] > slip.error[i] && slip.value[i] > 0.0)
      return {slip.x[i - 1], slip.x[i] - slip.x[i - 1]};
  }
  return {};
}

// The first slip of any top.
Onset first_slip(const SceneAnswer& slides) {
  Onset first;
  for (const SceneCurve& curve : slides.curves) {
    if (!curve.name.starts_with("slip_")) continue;
    const Onset one = onset_of(curve);
    if (one.time_s < first.time_s) first = one;
  }
  return first;
}

// Where a reading of tops that slide first differs from that of tops that stuck by more than a limit.
struct Sight {
  Onset at;
  std::string reading;
  double largest_V = 0.0;  // difference of any reading at any time, less its error
};
Sight first_sight(const SceneAnswer& slides, const SceneAnswer& sticks, double from_s,
                  double limit_V) {
  Sight seen;
  for (const SceneCurve& curve : slides.curves) {
    if (!curve.name.starts_with("reading_")) continue;
    const SceneCurve* stuck = curve_in(sticks, curve.name);
    if (stuck == nullptr) continue;
    for (std::size_t i = 1; i < curve.x.size(); ++i) {
      if (curve.x[i] <= from_s) continue;
      const ValueAt here = at_time(curve, curve.x[i]), there = at_time(*stuck, curve.x[i]);
      const double size_V = std::abs(here.value - there.value) - here.error - there.error;
      seen.largest_V = std::max(seen.largest_V, size_V);
      if (size_V < limit_V || curve.x[i] >= seen.at.time_s) continue;
      seen.at = {curve.x[i], curve.x[i] - curve.x[i - 1]};
      seen.reading = curve.name;
    }
  }
  return seen;
}

}  // namespace

RequiredValue required_slip_latency(const Scene& scene, const Requirements&,
                                    const SceneSolver& solve) {
  const auto* given = std::get_if<SpaceScene>(&scene);
  if (given == nullptr || !given->touch || !given->touch->is_path() || !given->noise ||
      !given->touch->readout || given->press->friction != Friction::kCoulomb ||
      !std::isfinite(given->press->friction_coefficient)) {
    return no_motion(
        "needs an array in the plane under a shape with a path and a number as friction, with "
        "[noise] and [readout]");
  }
  const SceneAnswer slides = solve(scanned(*given, given->press->friction_coefficient));
  const Onset first = first_slip(slides);
  if (!std::isfinite(first.time_s)) return no_motion("no top slides on this path");
  const SceneAnswer sticks = solve(scanned(*given, std::numeric_limits<double>::infinity()));
  const double noise = noise_V(*given, solve);
  const Sight seen = first_sight(slides, sticks, first.time_s, kSeen * noise);
  const std::string most =
      fmt::format("slip changes readings by at most {:.2g} times their noise of {:.3g} V",
                  seen.largest_V / noise, noise);
  if (seen.reading.empty()) return no_motion(fmt::format("{}; {:g} are seen", most, kSeen));
  return {true, seen.at.time_s - first.time_s, first.step_s + seen.at.step_s,
          fmt::format("first in {}; {}", seen.reading, most)};
}

RequiredValue required_texture_amplitude(const Scene& scene, const Requirements& requirements,
                                         const SceneSolver& solve) {
  const double wavelength_m = requirements.texture_wavelength_m;
  const double speed_m_s = requirements.texture_speed_m_s;
  if (std::isnan(wavelength_m) || std::isnan(speed_m_s)) {
    return no_motion("needs require.texture_wavelength and require.texture_speed");
  }
  const auto* given = std::get_if<SpaceScene>(&scene);
  auto one = single_body(scene);
  const auto middle = given == nullptr ? std::nullopt : middle_pillar(*given);
  if (!middle || !one || !given->noise || !given->noise_readout) {
    return no_motion("needs an array in the plane with [noise] and [readout]");
  }
  const double frequency_Hz = speed_m_s / wavelength_m;
  if (frequency_Hz < given->noise->from_Hz || frequency_Hz > given->noise->to_Hz) {
    return no_motion(
        fmt::format("the texture passes at {:.4g} Hz, outside the band of [noise]", frequency_Hz));
  }
  SpaceScene pressed = *given;
  pressed.press.reset();
  pressed.touch.reset();
  pressed.pressure_Pa = 1.0;
  pressed.shear_x_Pa = pressed.shear_y_Pa = 0.0;
  pressed.loaded = {{pressed.pillars[*middle].row, pressed.pillars[*middle].column}};
  pressed.effects.clear();
  pressed.wanted = {"resolution_pressure", "electrode_capacitance"};
  const SceneAnswer reading = solve(pressed);
  const SceneResult* resolution = result_in(reading, "resolution_pressure");
  const SceneResult* capacitance = result_in(reading, "electrode_capacitance");
  if (resolution == nullptr || capacitance == nullptr) {
    return no_motion("the electrodes read no pressure");
  }
  one->drive = HarmonicDrive{.pressure_Pa = 1.0, .frequencies_Hz = {frequency_Hz}};
  const SceneAnswer swing = solve(*one);
  const SceneCurve* real = curve_in(swing, "top_displacement_real");
  const SceneCurve* imaginary = curve_in(swing, "top_displacement_imaginary");
  if (real == nullptr || imaginary == nullptr) return no_motion("the pillar gives no motion");
  const ValueAt re = at_time(*real, frequency_Hz), im = at_time(*imaginary, frequency_Hz);
  const double m_per_Pa = std::hypot(re.value, im.value);
  // A ridge sin(2 pi x/lambda) moves the mean of a round top of radius a by 2 J_1(q)/q of it, q = 2 pi a/lambda.
  const double q = 2.0 * std::numbers::pi * 0.5 * given->diameter_m / wavelength_m;
  const double over_top = std::abs(2.0 * std::cyl_bessel_j(1.0, q) / q);
  if (over_top < 1e-3) {
    return no_motion("a top averages this wavelength out; it is too short for the diameter");
  }
  const ReadoutFilter filter = readout_filter(*given->noise_readout, capacitance->value);
  const double passed =
      std::abs(response(filter, 2.0 * std::numbers::pi * frequency_Hz)) / filter.gain;
  const double seen_Pa = kSeen * resolution->value / passed;
  const double value_m = seen_Pa * m_per_Pa / over_top;
  const double relative =
      (re.error + im.error) / m_per_Pa + resolution->error_estimate / std::abs(resolution->value);
  return {true, value_m, relative * value_m,
          fmt::format("in full contact, at {:.4g} Hz; reads as {:g} times the noise", frequency_Hz,
                      kSeen)};
}

}  // namespace viscard
