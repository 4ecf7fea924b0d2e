#include "models/uncertainty/uncertain_input.h"

namespace viscard {

Eigen::Index count_deviates(const std::vector<UncertainInput>& inputs) {
  return first_deviates(inputs).back();
}

std::vector<Eigen::Index> first_deviates(const std::vector<UncertainInput>& inputs) {
  std::vector<Eigen::Index> first{0};
  for (const UncertainInput& input : inputs) first.push_back(first.back() + input.n_deviates);
  return first;
}

}  // namespace viscard
