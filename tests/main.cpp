#define CATCH_CONFIG_RUNNER
#include "models/maths/kept_memory.h"

#include <catch2/catch.hpp>
#include <sys/resource.h>

#include <cstdlib>

namespace {

// A test that does not end is ended by the processor time that it took: on a busy machine a good test may
// take long. VISCARD_TEST_CPU_S is set by ctest.
void limit_processor_time() {
  const char* const limit = std::getenv("VISCARD_TEST_CPU_S");
  if (limit == nullptr) return;
  const rlim_t seconds = std::strtoul(limit, nullptr, 10);
  const rlimit both{seconds, seconds + 5};
  ::setrlimit(RLIMIT_CPU, &both);
}

}  // namespace

int main(int argc, char** argv) {
  limit_processor_time();
  viscard::keep_freed_memory();  // as the executable does, so that a study measures its times
  return Catch::Session().run(argc, argv);
}
