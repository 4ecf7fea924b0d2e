#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace viscard {

// Samples at which the depth has moved by more than 2 % of its range since the last such sample.
std::vector<char> moved_samples(std::span<const double> depth_m);

// The first loading ends at the first sample with 98 % of the largest depth that is reached before
// the punch goes back by a fifth of the range. goes_back: true if it goes back that far.
struct FirstLoading {
  std::size_t loaded = 0;
  bool goes_back = false;
};
FirstLoading first_loading(std::span<const double> depth_m);

}  // namespace viscard
