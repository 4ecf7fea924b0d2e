#include "fit/search/spectral_state.h"

#include <algorithm>
#include <numeric>

namespace viscard {

SpectralState sorted_by_time(SpectralState state, Eigen::Index n_common) {
  const Eigen::Index n_terms = state.n_terms();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(n_terms));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return state.ln_tau[a] < state.ln_tau[b]; });
  const SpectralState old = state;
  for (Eigen::Index i = 0; i < n_terms; ++i) {
    const Eigen::Index from = order[static_cast<std::size_t>(i)];
    state.ln_tau[i] = old.ln_tau[from];
    state.coefficients[n_common + i] = old.coefficients[n_common + from];
  }
  return state;
}

std::vector<bool> free_columns(const SpectralModel& model, Eigen::Index n_terms) {
  std::vector<bool> is_free;
  for (const CommonColumn& column : model.common()) {
    is_free.push_back(column.is_free || model.may_be_negative());
  }
  is_free.resize(is_free.size() + static_cast<std::size_t>(n_terms), model.may_be_negative());
  return is_free;
}

}  // namespace viscard
