#pragma once

#include "models/array/contact/relaxing_tops.h"
#include "models/array/space/space_scene.h"

#include <vector>

namespace viscard {

// Sets the history of a scene's shape, and its deepest state as the depth or force of the shape, at the place of its path
// where it presses most, to which estimates refer. In creep that is the force that presses elastic pillars to the same depth.
void press_in_time(SpaceScene& scene, SpaceTouch touch);

// Throws SceneMistake for a history or path that does not start at 0 s, for pillars that do not relax alike, and
// for a readout without electrodes.
void check_touch(const SpaceScene& scene);

// Upper bound of the effect of relaxation on a force or depth: the share of the moduli that is lost
// at the end of the history (or of the compliance that is gained), times the total variation of the
// history over its peak.
double relaxed_share(const SpaceScene& scene);

// The time steps of a shape's history, between which elastic loads are taken as linear.
struct TouchSample {
  double time_s = 0.0;
  double value = 0.0;    // of the history, m or N
  double elastic = 0.0;  // depth, or the force that presses elastic pillars as deep (eq. S15)
  bool is_new = false;   // halves a step of the samples with half as many steps
  double x_m = 0.0, y_m = 0.0;  // of the shape
};

// Blocks that double in length after each corner of the history, from a quarter of the fastest time of the
// material and the readout on, with the same number of steps each. A jump has two samples. In no block does the shape
// move further than the smallest top is wide.
std::vector<TouchSample> touch_samples(const SpaceScene& scene, int steps);

// True if the contact grows or stays from sample to sample, judged by the shape alone.
bool is_growing(const std::vector<TouchSample>& samples);

// The elastic value at the end of a history that never falls, above the given one.
double bound_on_elastic(const SpaceScene& scene, const std::vector<TouchSample>& samples);

RelaxationStep relaxation_step(const std::vector<MaterialTerm>& terms, double dt_s);

double largest_value(const std::vector<TouchSample>& samples);  // elastic

// Loads that are linear between the samples, relaxed (eq. 5, exact for any steps).
std::vector<TopLoads> relaxed(const std::vector<MaterialTerm>& terms,
                              const std::vector<TouchSample>& samples,
                              const std::vector<TopLoads>& elastic);

// An electrode of that capacitance and its film.
FilmPort film_port(const SpaceScene& scene, double capacitance_F);

// Change of the reading by half as many steps, relative to its largest value, for a voltage in
// proportion to the force; 0 without a readout.
double change_of_reading(const SpaceScene& scene, const std::vector<TouchSample>& samples,
                         const std::vector<double>& force_N);

}  // namespace viscard
