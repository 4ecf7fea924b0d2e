#include "io/basics/data_folder.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

namespace viscard {
namespace {

using test::ScratchFolder;

TEST_CASE("the data of an installed program are found beside its folder", "[io]") {
  const ScratchFolder scratch;
  fs::create_directories(scratch / "usr/bin");
  fs::create_directories(scratch / "usr/share/viscard/demo");
  CHECK(fs::equivalent(data_folder_beside(scratch / "usr/bin"), scratch / "usr/share/viscard"));
}

TEST_CASE("the data of a program in a build folder are found within it", "[io]") {
  const ScratchFolder scratch;
  fs::create_directories(scratch / "build/share/viscard/demo");
  CHECK(fs::equivalent(data_folder_beside(scratch / "build"), scratch / "build/share/viscard"));
  CHECK(fs::exists(data_folder() / "demo" / "01_rig.toml"));  // of this test itself
}

TEST_CASE("a program without its data reports where they were looked for", "[io]") {
  const ScratchFolder scratch;
  CHECK_THROWS_WITH(data_folder_beside(scratch / "bin"),
                    Catch::Contains((scratch / "share/viscard").string()) &&
                        Catch::Contains((scratch / "bin/share/viscard").string()) &&
                        Catch::Contains("install viscard again"));
}

TEST_CASE("the files of an example exist where the example is read", "[io]") {
  const ScratchFolder scratch;
  const fs::path before = fs::current_path();
  fs::current_path(scratch.path());
  const std::string example = "viscard predict data/materials/a.json --against data/demo/b.csv";
  const std::string folder = data_folder().string();
  CHECK(example_with_data(example) ==
        "viscard predict " + folder + "/materials/a.json --against " + folder + "/demo/b.csv");
  fs::create_directory("data");
  CHECK(example_with_data(example) == example);
  fs::current_path(before);
}

}  // namespace
}  // namespace viscard
