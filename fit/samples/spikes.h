#pragma once

#include "fit/samples/sample_passes.h"

#include <cstddef>
#include <span>
#include <vector>

namespace viscard {

// Indices of isolated spikes: samples that differ from the mean of their two neighbours by more
// than eight standard deviations of the noise at that value (reading_noise.h), and by more than twice the difference of the neighbours, so that a steep curve is not
// taken for a spike. Only for evenly sampled records of at least 200 samples; elsewhere neighbours
// give no estimate. A local form of Hampel's identifier (J. Am. Stat. Assoc. 69 (1974) 383).
std::vector<std::size_t> isolated_spikes(std::span<const double> time_s,
                                         std::span<const double> values);
// The same with the steps of the times, s, where they are known.
std::vector<std::size_t> isolated_spikes(const StepRange& steps_s, std::span<const double> values);

// True if isolated_spikes() can be applied to a record of `count` samples.
bool is_evenly_sampled(const StepRange& steps_s, std::size_t count);

// Rows, at most three in succession, whose depth jumps away and back while the force does not
// follow: a display that lost a reading, or wrote a zero.
std::vector<std::size_t> depth_jumps(std::span<const double> force_N,
                                     std::span<const double> depth_m);

// Outliers among the residuals of a fit to `values`: samples beyond 5.5 standard deviations of the noise
// at that value (noise_of_deviations), in groups of at most three with good samples on either side, so that neither a fast
// term at the start nor a misfit is taken for spikes. Returns none for records of fewer than 1000
// samples (a point far from the curve may be the only information there), if more than 3 % would be
// removed, or if all residuals are below 1e-6 of the largest value.
std::vector<std::size_t> outlying_samples(std::span<const double> residual,
                                          std::span<const double> values, double largest_value);

// The column without these rows (ascending indices).
std::vector<double> without_rows(std::span<const double> column,
                                 const std::vector<std::size_t>& rows);

}  // namespace viscard
