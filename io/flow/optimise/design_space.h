#pragma once

#include "io/flow/optimise/design_spec.h"
#include "io/flow/sweep/study.h"
#include "models/scene/scene.h"

#include <string>
#include <vector>

namespace viscard {

// A point of the ranges: for each its share of the way from `from` to `to`, 0 to 1.
using DesignPoint = std::vector<double>;

// The scenes that a specification allows.
class DesignSpace {
 public:
  // Throws std::runtime_error for ends without common unit, of a key that the scene does not have, or
  // that are no range.
  explicit DesignSpace(const DesignSpec& spec);

  std::size_t size() const { return axes_.size(); }
  // The value of a range in its own unit.
  double value_at(std::size_t range, double share) const;
  const std::string& unit_of(std::size_t range) const {
    return axes_[range].unit;
  }  // as in the file
  // With so many significant digits; what the scene states behind +- is kept.
  StudyValues values_at(const DesignPoint& point, int digits) const;
  // Throw std::runtime_error where there is no such scene.
  std::string text_at(const DesignPoint& point, int digits) const;
  Scene scene_at(const DesignPoint& point) const;

 private:
  struct Axis {
    std::string key, unit, uncertainty;
    double from = 0.0, to = 0.0;
    bool is_log = true;
  };
  const DesignSpec* spec_;
  std::vector<Axis> axes_;
};

}  // namespace viscard
