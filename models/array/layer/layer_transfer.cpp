#include "models/array/layer/layer_transfer.h"

#include "models/array/contact/rough_surface.h"
#include "models/maths/gauss_legendre.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace viscard {
namespace {

constexpr double kLongest = 1e-9;      // k times the thickness that stands for 0
constexpr double kShortestWave = 0.5;  // of the curves, over the layer's thickness
constexpr double kLongestWave = 50.0;
constexpr int kWavesPerDoubling = 8;

// Of the random surface whose table the shape has; 0 for other shapes.
double correlation_length_m(const LayerScene& scene) {
  const HeightTable& table = scene.press.shape.table;
  return table.is_random ? kLinesPerCorrelation * (table.x_m[1] - table.x_m[0]) : 0.0;
}

}  // namespace

LayerTransfer layer_transfer(const LayerWaves& waves, double k_1_m) {
  const double k = std::max(k_1_m, kLongest / waves.thickness_m());
  LayerTransfer transfer;
  transfer.sinking_m_Pa = waves.reference_m_Pa() * reference_spectrum_m(k, waves.thickness_m());
  if (k > waves.largest_k_1_m()) return transfer;  // no such wave reaches the film
  const LayerAnswer answer = waves.at(k);
  transfer.sinking_m_Pa += answer.sinking_m_Pa;
  for (const double harmonic : answer.reading_V_Pa) transfer.reading_V_Pa += harmonic;
  return transfer;
}

double half_wavelength_m(const LayerWaves& waves) {
  const double half_V_Pa = 0.5 * layer_transfer(waves, 0.0).reading_V_Pa;
  double low_1_m = 0.0, high_1_m = waves.largest_k_1_m();
  for (int i = 0; i < 60; ++i) {
    const double middle_1_m = 0.5 * (low_1_m + high_1_m);
    const bool is_long = layer_transfer(waves, middle_1_m).reading_V_Pa / half_V_Pa > 1.0;
    (is_long ? low_1_m : high_1_m) = middle_1_m;
  }
  return 2.0 * std::numbers::pi / low_1_m;
}

LayerBlurring layer_blurring(const LayerWaves& waves, bool is_plane, double correlation_length_m,
                             double radius_m) {
  constexpr int kPoints = 8, kPanels = 48;
  constexpr double kLastWave =
      12.0;  // times the correlation length: exp(-36) of the spectrum is left
  const double end_1_m = kLastWave / correlation_length_m;
  const QuadratureRule rule = gauss_legendre(kPoints);
  double heights = 0.0, readings = 0.0, both = 0.0, total = 0.0;
  for (int panel = 0; panel < kPanels; ++panel) {
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double k_1_m = end_1_m * (panel + rule.points[q]) / kPanels;
      const double phase = 0.5 * k_1_m * correlation_length_m;
      const double spectrum = rule.weights[q] * std::exp(-phase * phase) * (is_plane ? 1.0 : k_1_m);
      const double mean = mean_of_wave(is_plane, k_1_m * radius_m);
      total += spectrum;
      heights += spectrum * mean * mean;
      if (k_1_m > waves.largest_k_1_m()) continue;
      const double sinking_m_Pa = layer_transfer(waves, k_1_m).sinking_m_Pa;
      const LayerAnswer answer = waves.at(k_1_m);
      // Over the directions of the wave the harmonics 2 and 4 of the reading have mean 0.
      const double even = answer.reading_V_Pa[0] / sinking_m_Pa;
      double square = even * even;
      both += spectrum * mean * even;
      for (std::size_t m = 1; m < 3; ++m) {
        square += 0.5 * std::pow(answer.reading_V_Pa[m] / sinking_m_Pa, 2.0);
      }
      readings += spectrum * square;
    }
  }
  return {std::abs(both) / std::sqrt(heights * readings), std::sqrt(readings / total)};
}

std::vector<std::string> transfer_names(const LayerScene& scene) {
  std::vector<std::string> names = {"half_wavelength", "voltage_per_pressure",
                                    "voltage_per_height"};
  if (correlation_length_m(scene) > 0.0) {
    names.insert(names.end(), {"blurring", "voltage_per_rms_height"});
  }
  return names;
}

void add_transfer(const LayerScene& scene, const LayerWaves& waves, SceneAnswer& answer) {
  const auto wants = [&](const char* name) {
    return std::find(scene.wanted.begin(), scene.wanted.end(), name) != scene.wanted.end();
  };
  if (wants("half_wavelength")) {
    answer.results.push_back({"half_wavelength", half_wavelength_m(waves), "m"});
  }
  if (correlation_length_m(scene) > 0.0) {
    const LayerBlurring blurring = layer_blurring(
        waves, scene.is_plane(), correlation_length_m(scene), scene.electrode_radius_m);
    if (wants("blurring")) answer.results.push_back({"blurring", blurring.correlation, "1"});
    if (wants("voltage_per_rms_height")) {
      answer.results.push_back({"voltage_per_rms_height", blurring.voltage_V_m, "V/m"});
    }
  }
  for (const char* const name : {"voltage_per_pressure", "voltage_per_height"}) {
    if (!wants(name)) continue;
    const bool is_pressure = std::string(name) == "voltage_per_pressure";
    SceneCurve curve{.name = name, .unit = is_pressure ? "V/Pa" : "V/m", .x_name = "wavelength_m"};
    const double doublings = std::log2(kLongestWave / kShortestWave);
    const int count = static_cast<int>(std::ceil(doublings * kWavesPerDoubling));
    for (int i = 0; i <= count; ++i) {
      const double wavelength_m =
          kShortestWave * scene.thickness_m * std::pow(2.0, doublings * i / count);
      const LayerTransfer at = layer_transfer(waves, 2.0 * std::numbers::pi / wavelength_m);
      curve.x.push_back(wavelength_m);
      curve.value.push_back(is_pressure ? at.reading_V_Pa : at.reading_V_Pa / at.sinking_m_Pa);
    }
    answer.curves.push_back(std::move(curve));
  }
}

}  // namespace viscard
