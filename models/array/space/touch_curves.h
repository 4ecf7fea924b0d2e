#pragma once

#include "models/array/space/space_array.h"
#include "models/array/space/touch_course.h"
#include "models/scene/common/scene_answer.h"

#include <string>
#include <vector>

namespace viscard {

// Names of the results of a touch beside those of a shape at rest: reading, of wired electrodes.
std::vector<std::string> touch_results(const SpaceScene& scene);

// Adds the curves of the pillars that the scene names, or of the one that bears most: their voltages and
// readings ("mean_voltage_3_4", "reading_3_4"; eq. S16) without errors.
void add_voltage_curves(const SpaceScene& scene, const SpaceResponse& response,
                        const TouchCourse& course, SceneAnswer& answer);

// Adds errors to those curves: the effect of the changes of the loads, and `relative` times the
// reference value of the tolerance. Also adds the curves of the shape and of single tops: depth,
// contact_force, contacts, pillar_force_3_4; and the peaks and the ends of all curves as results.
void finish_curves(const SpaceScene& scene, const TouchCourse& course, double relative,
                   SceneAnswer& answer);

}  // namespace viscard
