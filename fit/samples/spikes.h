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

// Whether isolated_spikes() can say anything of such a record.
bool is_evenly_sampled(std::span<const double> time_s);

// A second look, at what a fit leaves: samples beyond 5.5 standard deviations (from the median of
// |residual|), in groups of at most three with good ones on either side, so that neither a fast
// term at the start nor a misfit is taken for spikes. None in records of fewer than 1000
// samples (a point far from a curve may be all that is known there), where more than 3 % would go,
// or where all is below 1e-6 of the largest value.
std::vector<std::size_t> outlying_samples(std::span<const double> residual, double largest_value);

// The column without these rows (ascending).
std::vector<double> without_rows(std::span<const double> column,
                                 const std::vector<std::size_t>& rows);

}  // namespace viscard
