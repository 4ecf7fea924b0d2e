#include "fit/large_strain/foam_rows.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

// Largest |ln| of the lateral stretches; 0 without any.
double lateral_scale_of(const LargeStrainTest& test) {
  double largest = 0.0;
  for (std::size_t i = 0; i < test.lateral_stretch.size(); ++i) {
    const double s = test.lateral_stretch[i];
    if (!(std::isfinite(s) && s > 0.0)) {
      throw std::runtime_error("reading " + std::to_string(i + 1) + " of the " + test.name +
                               " test has the lateral stretch " + text_of(s) +
                               "; it is positive, and 1 at rest");
    }
    largest = std::max(largest, std::abs(std::log(s)));
  }
  return largest;
}

}  // namespace

FoamRows::FoamRows(const std::vector<LargeStrainTest>& tests) {
  double scale_Pa = 0.0;
  for (const LargeStrainTest& test : tests) {
    double largest_Pa = 0.0;
    for (const double stress : test.nominal_stress_Pa)
      largest_Pa = std::max(largest_Pa, std::abs(stress));
    scale_Pa = std::max(scale_Pa, largest_Pa);
    // Sides that stay at 1 are a datum, too: they count by the strain along the force.
    double lateral = lateral_scale_of(test);
    if (lateral == 0.0) {
      for (const double s : test.stretch) lateral = std::max(lateral, std::abs(std::log(s)));
    }
    for (std::size_t i = 0; i < test.stretch.size(); ++i) {
      Reading reading{test.foam_test, test.stretch[i]};
      reading.stress_scale_Pa = largest_Pa > 0.0 ? largest_Pa : 1.0;
      reading.stress_Pa = test.nominal_stress_Pa[i];
      if (!test.lateral_stretch.empty()) {
        reading.lateral_row = 0;
        reading.lateral_scale = lateral;
        reading.log_lateral = std::log(test.lateral_stretch[i]);
      }
      readings_.push_back(reading);
    }
  }
  scale_Pa_ = scale_Pa > 0.0 ? scale_Pa : 1.0;
  fill_data();
}

// The rows of a test stand together, so that the memory of residuals is that along a test.
void FoamRows::fill_data() {
  std::vector<double> values;
  for (std::size_t first = 0, last = 0; first < readings_.size(); first = last) {
    while (last < readings_.size() && readings_[last].test == readings_[first].test &&
           readings_[last].stress_scale_Pa == readings_[first].stress_scale_Pa) {
      ++last;
    }
    for (std::size_t i = first; i < last; ++i) {
      readings_[i].stress_row = static_cast<Eigen::Index>(values.size());
      values.push_back(readings_[i].stress_Pa / readings_[i].stress_scale_Pa);
    }
    for (std::size_t i = first; i < last; ++i) {
      if (readings_[i].lateral_row < 0) continue;
      readings_[i].lateral_row = static_cast<Eigen::Index>(values.size());
      values.push_back(readings_[i].log_lateral / readings_[i].lateral_scale);
    }
  }
  data_ = Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::VectorXd FoamRows::model(const FoamLaw& law) const {
  Eigen::VectorXd out(data_.size());
  for (const Reading& reading : readings_) {
    const FoamState state = foam_state(law, reading.test, reading.measured);
    out[reading.stress_row] = state.nominal_stress_Pa / reading.stress_scale_Pa;
    if (reading.lateral_row >= 0)
      out[reading.lateral_row] = state.log_strain[2] / reading.lateral_scale;
  }
  return out;
}

FoamRows FoamRows::thinned(std::size_t most) const {
  if (readings_.size() <= most) return *this;
  FoamRows out;
  out.scale_Pa_ = scale_Pa_;
  const double step = static_cast<double>(readings_.size()) / static_cast<double>(most);
  for (std::size_t i = 0; i < most; ++i)
    out.readings_.push_back(readings_[static_cast<std::size_t>(static_cast<double>(i) * step)]);
  out.fill_data();
  return out;
}

}  // namespace viscard
