#include "tests/support/convergence.h"

#include <cmath>

namespace viscard::test {

std::vector<double> observed_orders(const std::function<double(double)>& error, double first,
                                    int levels) {
  std::vector<double> orders;
  double coarse = error(first);
  for (int level = 1; level < levels; ++level) {
    first *= 0.5;
    const double fine = error(first);
    orders.push_back(std::log2(coarse / fine));
    coarse = fine;
  }
  return orders;
}

}  // namespace viscard::test
