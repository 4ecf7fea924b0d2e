#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/space/space_array.h"
#include "models/array/space/touch_course.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

// Names of the results of a touch beside those of a shape at rest: reading, of wired electrodes; of a
// shape that moves with friction slip, m, the way of the shape over each top up to the end; largest_slip; and the
// curves sliding_tops and sticking_tops.
std::vector<std::string> touch_results(const SpaceScene& scene);

// Adds the map of slip, if the scene wants it.
void add_slip(const SpaceScene& scene, const TouchCourse& course, SceneAnswer& answer);

// Adds the curves of the pillars that the scene names, or of the one that bears most: their voltages and
// readings ("mean_voltage_3_4", "reading_3_4"; eq. S16) without errors.
void add_voltage_curves(const SpaceScene& scene, const SpaceResponse& response,
                        const TouchCourse& course, SceneAnswer& answer);

// Adds errors to those curves: the effect of the changes of the loads, and `relative` times the
// reference value of the tolerance. Also adds the curves of the shape and of single tops: depth,
// contact_force, contacts, pillar_force_3_4, shear_force_x_3_4, slip_3_4; and the peaks and the ends of all curves
// as results.
void finish_curves(const SpaceScene& scene, const TouchCourse& course, double relative,
                   SceneAnswer& answer);

constexpr const char* kTouchReading = "reading";

std::string place_ending(const SpacePillar& one);  // "_3_4"

// The pillars that the scene names in its results; or under a shape that moves all of a small array; or the one that
// bears most at the end.
std::vector<std::size_t> followed_pillars(const SpaceScene& scene, const TouchCourse& course);

// One quantity of one pillar at the times of the course.
struct PillarCurve {
  std::string map;  // "mean_voltage", or "reading"
  std::size_t pillar = 0;
  std::vector<double> value;
  std::vector<double> step_change;  // of a reading: change from half as many steps
};

// The voltages and readings that the scene asks for, under loads in time. is_size: the loads are
// magnitudes of changes, and the returned values are magnitudes too.
std::vector<PillarCurve> curves_of(const SpaceScene& scene, const SpaceResponse& response,
                                   const TouchCourse& course, const std::vector<TopLoads>& loads_Pa,
                                   bool is_size);

// Sums of p12/p11 over the neighbours of each electrode (eq. S16).
std::vector<double> influence_of_neighbours(const SpaceScene& scene,
                                            const std::vector<std::size_t>& pillars);

}  // namespace viscard
