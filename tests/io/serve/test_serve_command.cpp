// The words of viscard serve, and the program itself.
#include "io/capture/capture_file.h"
#include "tests/io/serve/served_rig.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

namespace viscard {
namespace {

using test::contains;
using test::Json;
using test::run_command;

TEST_CASE("serve refuses words that make no sense", "[serve][cli]") {
  const auto refusal = [](const std::vector<std::string>& words) {
    const auto outcome = run_command(words);
    CHECK(outcome.status == kBadWords);
    CHECK(outcome.out.empty());
    return outcome.err;
  };
  CHECK(contains(refusal({"serve"}), "no folder given"));
  CHECK(contains(refusal({"serve", "/tmp/x"}), "needs --rig FILE"));
  CHECK(
      contains(refusal({"serve", "/tmp/x", "--emulate", "--port", "70000"}), "outside 0 to 65535"));
  CHECK(contains(refusal({"serve", "/tmp/x", "--emulate", "--speed", "0"}), "above 0"));
  CHECK(contains(refusal({"serve", "/tmp/x", "--rig", "r.toml", "--speed", "2"}), "add --emulate"));
}

// viscard serve as a process; the first line of its stdout is its --json object.
class ServeProgram {
 public:
  explicit ServeProgram(const std::string& folder) {
    int out[2], err[2];
    REQUIRE(::pipe(out) == 0);
    REQUIRE(::pipe(err) == 0);
    process_ = ::fork();
    REQUIRE(process_ >= 0);
    if (process_ == 0) {
      ::dup2(out[1], STDOUT_FILENO);
      ::dup2(err[1], STDERR_FILENO);
      ::execl(VISCARD_PROGRAM, VISCARD_PROGRAM, "serve", folder.c_str(), "--emulate", "--speed",
              "20", "--json", static_cast<char*>(nullptr));
      _exit(99);
    }
    ::close(out[1]);
    ::close(err[1]);
    err_ = err[0];
    std::FILE* const stream = ::fdopen(out[0], "r");
    std::string text;
    while (text.empty() || text.back() != '}') {
      const int c = std::fgetc(stream);
      REQUIRE(c != EOF);
      text += static_cast<char>(c);
    }
    std::fclose(stream);
    about_ = Json::parse(text);
  }
  ~ServeProgram() {
    if (process_ > 0) ::kill(process_, SIGKILL), ::waitpid(process_, nullptr, 0);
    ::close(err_);
  }
  ServeProgram(const ServeProgram&) = delete;
  ServeProgram& operator=(const ServeProgram&) = delete;

  const Json& about() const { return about_; }
  void send(int number) { ::kill(process_, number); }
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(process_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string said() {
    std::string text;
    char buffer[1024];
    for (ssize_t n = 0; (n = ::read(err_, buffer, sizeof buffer)) > 0;) {
      text.append(buffer, static_cast<std::size_t>(n));
    }
    return text;
  }

 private:
  pid_t process_ = -1;
  int err_ = -1;
  Json about_;
};

TEST_CASE("Ctrl-C ends viscard serve; a run is stopped and its punch lifted, as capture does",
          "[serve][cli][pty]") {
  test::ScratchFolder scratch;
  ServeProgram program(scratch.path().string());
  const std::string address = program.about().at("address");
  httplib::Client client("127.0.0.1", program.about().at("port").get<int>());
  client.set_default_headers({{"X-Viscard-Token", address.substr(address.find('#') + 1)}});
  const auto order = [&](const char* path, const Json& body) {
    return Json::parse(client.Post(path, body.dump(), "application/json")->body);
  };
  SECTION("with a run") {
    const std::string name =
        order("/api/specimens", {{"specimen", test::ServedRig::specimen()}}).at("name");
    order("/api/run", {{"specimen", name}});
    for (int i = 0; i < 600; ++i) {
      const Json run = Json::parse(client.Get("/api/run")->body);
      if (run.at("force_N").get<double>() > 0.5) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    program.send(SIGINT);
    CHECK(program.wait() == kFailed);
    const std::string said = program.said();
    CHECK(contains(said, "the run was interrupted"));
    CHECK(contains(said, "above the contact"));
    CHECK(read_capture(scratch / (name + ".viscap")).status == "interrupted");
  }
  SECTION("without a run") {
    program.send(SIGINT);
    CHECK(program.wait() == kDone);
  }
}

}  // namespace
}  // namespace viscard
