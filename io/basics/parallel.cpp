#include "io/basics/parallel.h"

#include "io/basics/inputs.h"
#include "models/maths/usable_machine.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace viscard {

void for_each_in_parallel(std::size_t n, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> failures(n);
  const std::function<void()> run = recorded_as_here([&] {
    for (std::size_t i = next++; i < n; i = next++) {
      try {
        work(i);
      } catch (const StopsWork&) {
        failures[i] = std::current_exception();
        next = n;
      } catch (...) {
        failures[i] = std::current_exception();
      }
    }
  });
  {
    std::vector<std::jthread> threads;
    const std::size_t cores = std::min(usable_cores(), n);
    for (std::size_t i = 1; i < cores; ++i) threads.emplace_back(run);
    run();
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace viscard
