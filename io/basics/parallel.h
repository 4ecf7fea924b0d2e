#pragma once

#include <cstddef>
#include <functional>

namespace viscard {

// Calls work(i) for i = 0 ... n - 1 on all cores and waits for all of them. If some calls throw,
// the exception of the smallest i is rethrown once all have ended.
void for_each_in_parallel(std::size_t n, const std::function<void(std::size_t)>& work);

}  // namespace viscard
