#pragma once

#include "models/material/prony_series.h"
#include "models/maths/course.h"

#include <cstddef>
#include <vector>

namespace viscard {

// The surface under a flat punch that may lift off. In contact the surface follows the punch. If
// that would need a pulling force, the punch has lifted off: the force is zero and the surface
// recovers on its own, until the punch meets it again. Both follow from the relaxation series,
// exactly for a depth that is linear between samples (except within the step of a change).
// Columns rather than a Course: the fit takes them beside the columns of its table.
struct ContactCourse {
  std::vector<double> surface_m;  // the punch's depth in contact, the free surface's out of it
  std::vector<char> is_free;      // out of contact, after the first touch
  std::size_t n_contacts = 1;     // times that contact was made; lifts of single samples are noise
};

// punch_m: depth of the punch at each sample. contact_m: depth of the surface at rest. first: first sample in contact.
// The scale of the series does not matter.
ContactCourse contact_course(const Course& punch_m, double contact_m, std::size_t first,
                             const PronySeries& series);

// Runs of contact of at least three samples, each after at least three free ones. first: first sample in contact.
std::size_t count_contacts(const std::vector<char>& is_free, std::size_t first);

}  // namespace viscard
