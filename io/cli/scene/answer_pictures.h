#pragma once

#include "io/flow/scenes/array_sweep.h"
#include "io/flow/scenes/compared_answers.h"
#include "io/plots/plot.h"
#include "models/answer/scene_answer.h"
#include "models/sensor/sensor_design.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// Pictures of answers, name and SVG. Empty without gnuplot; the tables hold the same numbers.
using Pictures = std::vector<std::pair<std::string, std::string>>;

// Curves: histories over time, responses over frequency (log magnitude above phase), spectra.
Pictures pictures_of(const SceneAnswer& answer);

// Curves and profiles of voltages that two answers have, in one picture each: "compared_NAME".
struct ComparedNames {
  std::string here, other;  // of the legend
};
Pictures pictures_of_compared(const SceneAnswer& here, const SceneAnswer& other,
                              const ComparedAnswers& compared, const ComparedNames& names);

// A result that every pillar of a row has ("centre_voltage_1", "centre_voltage_2", ...) over the
// pillars, with its error. If they differ by decades, its magnitude on a logarithmic axis.
Pictures pictures_over_pillars(const SceneAnswer& answer, const std::vector<int>& loaded);

// Each result of a sweep over the parameter with the most values, one line for each combination of
// the others, with the limit on the deviation if the sweep has one.
Pictures pictures_over_sweep(const ArraySweep& sweep, const std::vector<SweepPoint>& points,
                             const std::map<std::size_t, SweepRow>& rows);

// True if the largest magnitude is over 30 times the smallest that is not zero: a logarithmic axis.
bool spans_decades(const std::vector<double>& values);

// A phase in rad without the jumps of a whole turn that come from the range of an angle.
std::vector<double> unwrapped(std::vector<double> phase_rad);

// Draws a picture with this id in its SVG; false if gnuplot is not installed.
bool draw(const std::string& name, const Plot& plot, const char* id, Pictures& pictures);

// File names and pictures: buckling and matting limits of the length against spacing, the widest
// flaw-insensitive pillar against the adhesion strength, sensitivity and pitch against spacing, and
// the admissible lengths at the design's diameter and around it.
std::vector<std::pair<std::string, Plot>> design_pictures(const SensorGeometry& geometry,
                                                          const SensorMaterial& material,
                                                          const SensorRequirements& requirements);

}  // namespace viscard
