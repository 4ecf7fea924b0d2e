#include "io/basics/temporary_folder.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

namespace fs = std::filesystem;

// TMPDIR of this process for one test.
class TemporaryPlace {
 public:
  explicit TemporaryPlace(const fs::path& folder) {
    if (const char* const usual = std::getenv("TMPDIR")) before_ = usual;
    setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryPlace() { before_ ? setenv("TMPDIR", before_->c_str(), 1) : unsetenv("TMPDIR"); }
  TemporaryPlace(const TemporaryPlace&) = delete;
  TemporaryPlace& operator=(const TemporaryPlace&) = delete;

 private:
  std::optional<std::string> before_;
};

TEST_CASE(
    "the temporary folder of a killed process is removed by the next one, that of a living one is "
    "not",
    "[io][temporary]") {
  const test::ScratchFolder place;
  const TemporaryPlace of_test(place.path());
  fs::create_directory(place / "viscard-other");
  std::ofstream(place / "viscard-folder-file") << "somebody's";
  int ready[2];
  REQUIRE(pipe(ready) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const TemporaryFolder folder;
    std::ofstream(folder / "part") << "a part";
    const std::string name = folder.path().filename().string() + "\n";
    _exit(write(ready[1], name.data(), name.size()) > 0 ? (pause(), 1) : 1);
  }
  std::string name;
  for (char c = 0; read(ready[0], &c, 1) == 1 && c != '\n';) name += c;
  close(ready[0]);
  close(ready[1]);
  REQUIRE(fs::exists(place / name));
  { const TemporaryFolder beside_living; }
  CHECK(fs::exists(place / name / "part"));

  kill(child, SIGKILL);
  REQUIRE(waitpid(child, nullptr, 0) == child);
  CHECK(fs::exists(place / name));
  const TemporaryFolder next;
  CHECK_FALSE(fs::exists(place / name));
  CHECK(fs::exists(next.path()));
  CHECK(fs::exists(place / "viscard-other"));
  CHECK(fs::exists(place / "viscard-folder-file"));
}

TEST_CASE("a folder for temporary files that is not there is named with what to set",
          "[io][temporary]") {
  const test::ScratchFolder place;
  const TemporaryPlace of_test(place / "missing");
  CHECK_THROWS_WITH(TemporaryFolder(),
                    Catch::Contains("cannot make a folder for temporary files: ") &&
                        Catch::Contains("set TMPDIR"));
}

TEST_CASE(
    "a folder for temporary files that cannot be locked, because too many files are open, is "
    "not used",
    "[io][temporary]") {
  const test::ScratchFolder place;
  const TemporaryPlace of_test(place.path());
  rlimit usual{};
  REQUIRE(getrlimit(RLIMIT_NOFILE, &usual) == 0);
  rlimit none = usual;
  none.rlim_cur = 0;
  REQUIRE(setrlimit(RLIMIT_NOFILE, &none) == 0);
  std::exception_ptr failure;  // sanitizers need a pipe to look at it
  try {
    const TemporaryFolder unlocked;
  } catch (...) {
    failure = std::current_exception();
  }
  REQUIRE(setrlimit(RLIMIT_NOFILE, &usual) == 0);
  REQUIRE(failure);
  CHECK_THROWS_WITH(std::rethrow_exception(failure),
                    Catch::Contains("too many files are open; raise the limit (ulimit -n)"));
  CHECK(fs::is_empty(place.path()));
}

}  // namespace
}  // namespace viscard
