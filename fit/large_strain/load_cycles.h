#pragma once

#include "fit/large_strain/large_strain_data.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace viscard {

// One loading with the unloading after it: rows first to peak load, peak to last unload.
struct LoadCycle {
  std::size_t first = 0, peak = 0, last = 0;
};

// The cycles of a test by the turning points of its strain |ln s|; a change of direction counts if it
// is more than a twentieth of the range. A record that begins with unloading has no cycle for it. A stretch that
// goes one way through 1, such as a sorted table from compression to tension, is one cycle of all rows, and so are a
// compression and a tension below each other, each from rest.
std::vector<LoadCycle> load_cycles(const std::vector<double>& stretch);

// A table without times in any order of its rows: no stretch stands twice, and the stress never falls with
// it, so that its rows are one curve. Cycles have hysteresis or repeat a stretch.
bool is_unsorted_curve(const LargeStrainTest& test);
// The same rows in ascending order of the stretch.
LargeStrainTest sorted_by_stretch(const LargeStrainTest& test);
// Share of the inner rows at which the stretch turns: 2/3 on average in a shuffled table.
double share_of_turns(const std::vector<double>& stretch);

// Softening of a rubber by its first loading (Mullins, Rubber Chem. Technol. 42 (1969) 339): one minus
// the ratio of the stresses of the last and the first cycle, while loading, at the smaller of their
// peak stretches. Nothing for fewer than two cycles.
std::optional<double> softening(const LargeStrainTest& test, const std::vector<LoadCycle>& cycles);

// The test with only the loading rows of one cycle; with times, the rows before are its history.
LargeStrainTest loading_of(const LargeStrainTest& test, const LoadCycle& cycle);

}  // namespace viscard
