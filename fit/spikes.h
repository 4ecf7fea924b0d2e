#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace viscard {

// Numbers of samples that stand alone: further from the mean of their two neighbours than eight
// standard deviations of the noise (median of third differences, which spikes do not move), and
// than twice the difference of the neighbours, so that no steep part of a curve is taken for one.
// Only in records of at least 200 samples that are sampled evenly: elsewhere a neighbour says
// nothing. A local form of Hampel's identifier (J. Am. Stat. Assoc. 69 (1974) 383).
std::vector<std::size_t> isolated_spikes(std::span<const double> time_s,
                                         std::span<const double> values);

// The column without these rows (ascending).
std::vector<double> without_rows(std::span<const double> column,
                                 const std::vector<std::size_t>& rows);

}  // namespace viscard
