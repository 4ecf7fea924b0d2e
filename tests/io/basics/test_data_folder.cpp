#include "io/basics/data_folder.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

namespace viscard {
namespace {

using test::ScratchFolder;

TEST_CASE("the data of an installed program are found beside its folder", "[io][data_folder]") {
  const ScratchFolder scratch;
  fs::create_directories(scratch / "usr/bin");
  fs::create_directories(scratch / "usr/share/viscard/demo");
  CHECK(fs::equivalent(data_folder_beside(scratch / "usr/bin"), scratch / "usr/share/viscard"));
}

TEST_CASE("the data of a program in a build folder are found within it", "[io][data_folder]") {
  const ScratchFolder scratch;
  fs::create_directories(scratch / "build/share/viscard/demo");
  CHECK(fs::equivalent(data_folder_beside(scratch / "build"), scratch / "build/share/viscard"));
  CHECK(fs::exists(data_folder() / "demo" / "01_rig.toml"));  // of this test itself
}

TEST_CASE("a program without its data reports where they were looked for", "[io][data_folder]") {
  const ScratchFolder scratch;
  CHECK_THROWS_WITH(data_folder_beside(scratch / "bin"),
                    Catch::Contains((scratch / "share/viscard").string()) &&
                        Catch::Contains((scratch / "bin/share/viscard").string()) &&
                        Catch::Contains("install viscard again"));
}

}  // namespace
}  // namespace viscard
