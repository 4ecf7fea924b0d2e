#include "models/array/layer/layer_waves.h"

#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

constexpr int kSamples = 10;        // per panel
constexpr int kLayerDegree = 10;    // of the elements across film and layer
constexpr double kShortest = 1e-9;  // k times the thickness that stands for 0
// Ends of the panels in units of 1/thickness. Beyond the last one the reference of eq. L2 is exact to
// 4e-9, and the film reads less than 1e-6. Nearly incompressible layers and thick films need the small ones.
constexpr std::array<double, 11> kPanelEnds = {0.0, 0.03, 0.1, 0.3,  0.8, 1.8,
                                               3.5, 6.0,  9.0, 13.0, 20.0};

}  // namespace

double reference_spectrum_m(double k_1_m, double thickness_m) {
  return -std::expm1(-k_1_m * thickness_m) / k_1_m;
}

LayerWaves::LayerWaves(const LayeredFilm& stack, bool is_plane) {
  require(stack.layers.size() == 2, "the stack must be a film and one layer");
  const FilmLayer& layer = stack.layers.back();
  require(layer.medium.is_isotropic, "the layer must be isotropic");
  thickness_m_ = layer.thickness_m;
  const double nu = stack.is_plane_stress ? 0.0 : layer.medium.poisson_ratio;
  const double shear_Pa = layer.medium.stiffness_Pa(3, 3);
  const double young_Pa = 2.0 * shear_Pa * (1.0 + layer.medium.poisson_ratio);
  reference_m_Pa_ = half_space_compliance_m_Pa(young_Pa, nu, 1.0);
  std::vector<double> breaks_1_m;
  for (const double end : kPanelEnds) breaks_1_m.push_back(end / thickness_m_);
  const int count = is_plane ? 1 : 3;
  for (int j = 0; j < count; ++j) {
    directions_.emplace_back(stack, 0.25 * std::numbers::pi * j, breaks_1_m.back(), kLayerDegree);
  }
  panels_ = ChebyshevPanels(std::move(breaks_1_m), kSamples, [this](double k_1_m) {
    const LayerAnswer answer = sample(k_1_m).answer;
    Eigen::RowVectorXd row(4);
    row << answer.sinking_m_Pa, answer.reading_V_Pa[0], answer.reading_V_Pa[1],
        answer.reading_V_Pa[2];
    return row;
  });
  estimate_error();
}

LayerWaves::Sample LayerWaves::sample(double k_1_m) const {
  std::array<double, 3> sinking{}, reading{};
  for (std::size_t j = 0; j < directions_.size(); ++j) {
    const Eigen::Matrix4d response = directions_[j].response(k_1_m);
    sinking[j] = response(2, 2);
    reading[j] = -response(3, 2);  // a pressure is a negative t_z
  }
  Sample sample;
  const double known_m_Pa = reference_m_Pa_ * reference_spectrum_m(k_1_m, thickness_m_);
  if (directions_.size() == 1) {
    sample.answer = {sinking[0] - known_m_Pa, {reading[0], 0.0, 0.0}};
    return sample;
  }
  sample.answer.sinking_m_Pa = 0.25 * (sinking[0] + 2.0 * sinking[1] + sinking[2]) - known_m_Pa;
  sample.answer.reading_V_Pa = {0.25 * (reading[0] + 2.0 * reading[1] + reading[2]),
                                0.5 * (reading[0] - reading[2]),
                                0.25 * (reading[0] - 2.0 * reading[1] + reading[2])};
  const auto [least, largest] = std::minmax_element(sinking.begin(), sinking.end());
  sample.uneven_m_Pa = *largest - *least;
  return sample;
}

LayerAnswer LayerWaves::at(double k_1_m) const {
  const Eigen::RowVectorXd row = panels_.at(k_1_m);
  return {row[0], {row[1], row[2], row[3]}};
}

void LayerWaves::estimate_error() {
  const Sample longest = sample(kShortest / thickness_m_);
  double largest_sinking = 0.0;
  double sinking_change = 0.0;
  double reading_change = 0.0;
  double uneven = 0.0;
  const std::vector<double>& breaks_1_m = panels_.breaks();
  for (std::size_t panel = 0; panel + 1 < breaks_1_m.size(); ++panel) {
    const double k_1_m = 0.5 * (breaks_1_m[panel] + breaks_1_m[panel + 1]);
    const Sample exact = sample(k_1_m);
    const LayerAnswer ours = at(k_1_m);
    const double whole_m_Pa =
        exact.answer.sinking_m_Pa + reference_m_Pa_ * reference_spectrum_m(k_1_m, thickness_m_);
    largest_sinking = std::max(largest_sinking, whole_m_Pa);
    sinking_change =
        std::max(sinking_change, std::abs(ours.sinking_m_Pa - exact.answer.sinking_m_Pa));
    uneven = std::max(uneven, exact.uneven_m_Pa / whole_m_Pa);
    for (std::size_t m = 0; m < 3; ++m) {
      reading_change =
          std::max(reading_change, std::abs(ours.reading_V_Pa[m] - exact.answer.reading_V_Pa[m]));
    }
  }
  const double largest_reading = std::abs(longest.answer.reading_V_Pa[0]);
  error_ = sinking_change / largest_sinking + 0.5 * uneven;
  if (largest_reading > 0.0) error_ += reading_change / largest_reading;
}

}  // namespace viscard
