// Holds of twenty minutes to ten hours on the emulated rig: a longer hold loses no reading, needs no
// more memory while it is captured, and its fit has the terms of a short one, with intervals that
// hold the truth.
#include "io/basics/atomic_file.h"
#include "tests/flow/flow_support.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

// PDMS 1:10 of the demo, data/demo/03_pdms_1to10.truth.toml.
constexpr double kE0OfTruth_Pa = 1.88e6;
constexpr double kSharesOfTruth[] = {0.008206, 0.01386}, kTimesOfTruth_s[] = {0.1945, 2.403};

// The demo's test with another hold.
std::string test_with_hold(int hold_s, const ScratchFolder& folder) {
  std::string text = read_file(demo_file("02_test.toml"));
  const std::string hold = "hold = \"60 s\"";
  const std::size_t at = text.find(hold);
  REQUIRE(at != std::string::npos);
  text.replace(at, hold.size(), fmt::format("hold = \"{} s\"", hold_s));
  const std::string file = folder / "test.toml";
  write_file(file, text, false);
  return file;
}

// The most memory that this process has had, in kB.
long most_memory_kB() {
  rusage usage{};
  REQUIRE(::getrusage(RUSAGE_SELF, &usage) == 0);
  return usage.ru_maxrss;
}

nlohmann::json result_of(const std::vector<std::string>& words) {
  const CommandRun run = run_words(words);
  INFO(run.err);
  REQUIRE(run.status == 0);
  return nlohmann::json::parse(run.out);
}

void check_holds(const nlohmann::json& interval, double truth) {
  CAPTURE(interval.dump(), truth);
  CHECK(interval[0].get<double>() <= truth);
  CHECK(truth <= interval[1].get<double>());
}

void check_hold(int hold_s) {
  CAPTURE(hold_s);
  const ScratchFolder folder;
  const std::string capture = folder / "run.viscap";
  const long before_kB = most_memory_kB();
  const auto run = result_of({"capture", "--emulate", "--speed", "500", "--truth",
                              demo_file("03_pdms_1to10.truth.toml"), "--specimen",
                              demo_file("03_pdms_1to10.toml"), "--test",
                              test_with_hold(hold_s, folder), "--out", capture, "--json"});
  const long captured_kB = most_memory_kB();
  CHECK(run["status"] == "finished");
  CHECK(run["doubts"].empty());
  CHECK(run["readings"]["missing"] == 0);
  CHECK(run["readings"]["unreadable"] == 0);
  CHECK(run["readings"]["received"].get<long>() >= 80L * hold_s);
  CHECK(run_words({"export", capture, "--verify"}).status == 0);

  const auto fit = result_of({"fit", capture, "--json"});
  const long n_samples = fit["n_samples"].get<long>();
  CHECK(n_samples >= 80L * hold_s);
  const auto& terms = fit["terms"];
  REQUIRE(terms.size() == 2);
  check_holds(fit["E0_interval_95"], kE0OfTruth_Pa);
  for (std::size_t i = 0; i < 2; ++i) {
    check_holds(terms[i]["interval_95"]["g"], kSharesOfTruth[i]);
    check_holds(terms[i]["interval_95"]["tau_s"], kTimesOfTruth_s[i]);
  }
#ifndef __SANITIZE_ADDRESS__
  // What is captured goes into the file; a fit holds all readings.
  CHECK(captured_kB - before_kB < 64'000);
  CHECK(most_memory_kB() - captured_kB < 100'000 + n_samples / 2);
#else
  CHECK(captured_kB >= before_kB);
#endif
}

}  // namespace

TEST_CASE("a hold of 1200 s has the terms of a short one, and intervals that hold the truth",
          "[flow][pty]") {
  check_hold(1200);
}

TEST_CASE("a hold of one hour has the terms of a short one, and intervals that hold the truth",
          "[flow][pty][slow]") {
  check_hold(3600);
}

TEST_CASE("a hold of ten hours has the terms of a short one, and intervals that hold the truth",
          "[flow][pty][slow]") {
  check_hold(36000);
}
