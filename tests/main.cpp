#define CATCH_CONFIG_RUNNER
#include "models/maths/kept_memory.h"

#include <catch2/catch.hpp>

int main(int argc, char** argv) {
  viscard::keep_freed_memory();  // as the executable does, so that a study measures its times
  return Catch::Session().run(argc, argv);
}
