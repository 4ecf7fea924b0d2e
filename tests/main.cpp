#define CATCH_CONFIG_RUNNER
#include "models/maths/kept_memory.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <thread>

namespace {

// A test that does not end is ended by the processor time that it took: on a busy machine a good test may
// take long. VISCARD_TEST_CPU_S is set by ctest. A limit of the system (RLIMIT_CPU) would make the clock of
// processor time, which tests read, as coarse as the scheduler's ticks.
void limit_processor_time() {
  const char* const limit = std::getenv("VISCARD_TEST_CPU_S");
  if (limit == nullptr) return;
  const auto most_s = static_cast<double>(std::strtoul(limit, nullptr, 10));
  std::thread([most_s] {
    while (true) {
      std::this_thread::sleep_for(std::chrono::seconds(1));
      timespec now{};
      ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
      if (static_cast<double>(now.tv_sec) < most_s) continue;
      std::fputs("the test took more processor time than VISCARD_TEST_CPU_S\n", stderr);
      std::_Exit(124);
    }
  }).detach();
}

// ctest gives the name of a test as an argument, where Catch2 reads signs at its begin as an option, a pattern
// or a tag. Refused while ctest's list is made, thus when the test is built.
bool has_names_for_arguments() {
  bool good = true;
  for (const Catch::TestCase& test : Catch::getRegistryHub().getTestCaseRegistry().getAllTests()) {
    if (test.name.find_first_of("-~*[\"@") != 0) continue;
    std::fprintf(stderr, "the name of a test begins with a sign that Catch2 reads: %s\n",
                 test.name.c_str());
    good = false;
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  if (!has_names_for_arguments()) return 2;
  limit_processor_time();
  viscard::keep_freed_memory();  // as the executable does, so that a study measures its times
  return Catch::Session().run(argc, argv);
}
