#pragma once

#include <functional>
#include <vector>

namespace viscard::test {

// Halves h from `first` `levels` - 1 times and returns log2(error(h)/error(h/2)) for each halving.
std::vector<double> observed_orders(const std::function<double(double)>& error, double first,
                                    int levels);

}  // namespace viscard::test
