#include "io/basics/program.h"

namespace viscard {
namespace {

constexpr const char* kCommit =
#include <commit.inc>  // written by each build that finds another commit, commit.cmake
    ;

}  // namespace

std::string program_version() {
  return VISCARD_VERSION "+" + std::string(kCommit);
}

std::string program_with_version() {
  return "viscard " + program_version();
}

}  // namespace viscard
