#pragma once

#include "io/flow/optimise/optimise_design.h"
#include "io/plots/plot.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// Designs of which none is better than another in both objectives: the two ends, each the best in
// one objective, and between them the best in the first at even steps of the second (the
// epsilon-constraint method: Haimes, Lasdon & Wismer, IEEE Trans. Syst. Man Cybern. 1 (1971) 296).
// With choices, those of all combinations together. With one objective, or if nothing is feasible,
// a single design: the best one, or the one with the smallest violation.
struct DesignFront {
  std::vector<OptimisedDesign> designs;  // best in the first objective first
  std::size_t n_solved = 0;
};
// Throws what optimise_design() throws; the message names the choice.
DesignFront design_front(const DesignSpec& spec,
                         const std::function<void(double, const std::string&)>& progress);

// The second objective over the first, one dot for each design; designs with the same choices share an ink.
Plot picture_of_front(const DesignSpec& spec, const DesignFront& front);

}  // namespace viscard
