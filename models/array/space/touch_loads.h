#pragma once

#include "models/array/space/space_contact.h"
#include "models/array/space/space_scene.h"
#include "models/array/space/touch_steps.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace viscard {

// Loads on the tops in time, on one grid of the tops and with one set of steps. Not a Course: each sample has the loads
// of all touched pillars.
struct GridCourse {
  std::vector<double> depth_m, force_N;  // by sample
  std::vector<int> contacts;
  std::vector<TopLoads> loads_Pa;  // of the touched pillars
  // Of a shape that moves with friction: how far it has slid over the touched pillars, and the tops over which it slides.
  std::vector<Eigen::VectorXd> slip_m;
  std::vector<int> sliding;
  // For maps: the end of a contact that grows, otherwise the largest force; of a path its end, if at least half of the
  // largest force is left there.
  std::size_t shown_at = 0;
  SpaceContact shown;
  SpaceContact largest;  // for notes; without relaxation if the contact grows
};

double area_of(const SpaceScene& scene, std::size_t pillar);  // of its top

// All pillars that the shape may reach, ascending.
std::vector<std::size_t> touched_in(const SpaceScene& scene, const SpaceTops& tops,
                                    const std::vector<TouchSample>& samples);

// By correspondence (eq. S14, S15), from elastic states at the given number of equal steps of
// depth. Nothing if any contact shrinks.
std::optional<GridCourse> growing_course(const SpaceScene& scene, const SpaceTops& tops,
                                         const std::vector<TouchSample>& samples,
                                         const std::vector<std::size_t>& touched, int parts);

// Step by step, for any history (eq. T6).
GridCourse stepped_course(const SpaceScene& scene, const SpaceTops& tops,
                          const std::vector<TouchSample>& samples,
                          const std::vector<std::size_t>& touched);

}  // namespace viscard
