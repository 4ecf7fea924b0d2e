#pragma once

#include "fit/large_strain/hyperelastic_search.h"

#include <optional>
#include <vector>

namespace viscard {

// The law with each number of terms, from none to the largest, refined in all parameters together.
//   Start: law and spectrum in turns, the law by its own search with the spectrum held, the spectrum by
//   non-negative least squares on 4 times a decade with the law held. Neighbours are merged.
//   Then downwards: each term removed or merged with its neighbour, the best few refined.
// n_terms: exactly this number, otherwise up to most_terms.
std::vector<HyperelasticPoint> series_path(HyperelasticForm form, const LargeStrainRows& rows,
                                           std::optional<int> n_terms, int most_terms);

}  // namespace viscard
