// What a solver that --prove starts may do, and that nothing of it is left behind.
#include "io/basics/atomic_file.h"
#include "io/cards/proof/solver.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace viscard {
namespace {

using test::ScratchFolder;

// A solver that is a script of the shell.
bool run_script(const std::string& script) {
  static const Solver kShell{
      .name = "sh", .code = "sh", .commands = [](const std::string& program) {
        return std::vector<std::vector<std::string>>{{"sh", "-c", program}};
      }};
  return run_files({kShell, script, "1"}, {}, [](const std::filesystem::path&) {});
}

bool wait_until(const std::function<bool()>& is_so) {
  for (int i = 0; i < 3000 && !is_so(); ++i) usleep(10'000);
  return is_so();
}

pid_t pid_in(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  return text.empty() || text.back() != '\n' ? 0 : static_cast<pid_t>(std::stol(text));
}

bool is_alive(pid_t pid) {
  std::error_code ignored;
  const std::filesystem::path stat = "/proc/" + std::to_string(pid) + "/stat";
  if (!std::filesystem::exists(stat, ignored)) return false;
  const std::string text = read_file(stat);
  return text.find(") Z") == std::string::npos;
}

bool has_folder_of(pid_t process) {
  const std::string begin = "viscard-folder-" + std::to_string(process) + "-";
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::temp_directory_path())) {
    if (entry.path().filename().string().starts_with(begin)) return true;
  }
  return false;
}

// A process of its own that proves; its solver writes its number into the file and waits.
pid_t proving_process(const std::filesystem::path& file, bool is_started_by_script = false) {
  const pid_t child = fork();
  if (child != 0) return child;
  // Those of the test program would be left alone.
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  try {
    run_script(is_started_by_script ? "sleep 600 & echo $! > " + file.string() + "; wait"
                                    : "echo $$ > " + file.string() + "; exec sleep 600");
  } catch (const std::exception&) {
  }
  _exit(0);
}

TEST_CASE("a solver whose log never ends is stopped", "[cards][prove]") {
  CHECK_THROWS_WITH(run_script("yes a warning of the solver"),
                    Catch::Contains("wrote more than 64 MiB"));
  CHECK_FALSE(has_folder_of(getpid()));
}

TEST_CASE("what a solver leaves running is ended with it", "[cards][prove]") {
  const ScratchFolder folder;
  const auto file = folder / "pid";
  CHECK(run_script("sleep 600 & echo $! > " + file.string()));
  const pid_t left = pid_in(file);
  REQUIRE(left > 0);
  CHECK(wait_until([&] { return !is_alive(left); }));
}

TEST_CASE("a signal ends the solver, the folder and then the program", "[cards][prove]") {
  const ScratchFolder folder;
  const auto file = folder / "pid";
  const int signal = GENERATE(SIGINT, SIGTERM);
  const pid_t child = proving_process(file);
  REQUIRE(wait_until([&] { return std::filesystem::exists(file) && pid_in(file) > 0; }));
  const pid_t solver = pid_in(file);
  CHECK(is_alive(solver));
  kill(child, signal);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK((WIFSIGNALED(status) && WTERMSIG(status) == signal));
  CHECK_FALSE(is_alive(solver));
  CHECK_FALSE(has_folder_of(child));
}

TEST_CASE("kill -9 of the program ends its solver, and the next proof removes its folder",
          "[cards][prove]") {
  const ScratchFolder folder;
  // Another proof that begins meanwhile would remove the folder first.
  const char* const usual = std::getenv("TMPDIR");
  const std::string before = usual == nullptr ? "" : usual;
  setenv("TMPDIR", folder.path().c_str(), 1);
  const auto file = folder / "pid";
  const pid_t child = proving_process(file, GENERATE(false, true));
  REQUIRE(wait_until([&] { return std::filesystem::exists(file) && pid_in(file) > 0; }));
  const pid_t solver = pid_in(file);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  CHECK(wait_until([&] { return !is_alive(solver); }));
  CHECK(has_folder_of(child));
  CHECK(run_script("true"));
  CHECK_FALSE(has_folder_of(child));
  before.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before.c_str(), 1);
}

TEST_CASE("a solver sees no more of the environment than it needs", "[cards][prove]") {
  const ScratchFolder folder;
  const auto file = folder / "environment";
  setenv("SECRET_TOKEN_OF_TEST", "12345", 1);
  CHECK(run_script("env > " + file.string()));
  unsetenv("SECRET_TOKEN_OF_TEST");
  const std::string seen = read_file(file);
  CHECK(seen.find("12345") == std::string::npos);
  CHECK(seen.find("PATH=") != std::string::npos);
  CHECK(seen.find("OMP_NUM_THREADS=1") != std::string::npos);
}

}  // namespace
}  // namespace viscard
