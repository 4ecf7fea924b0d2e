#pragma once

#include <cstddef>
#include <functional>

namespace viscard {

// Calls work(i) for i = 0 ... n - 1 on all cores. All are carried out; then what the first of them,
// by number, threw is thrown.
void for_each_in_parallel(std::size_t n, const std::function<void(std::size_t)>& work);

}  // namespace viscard
