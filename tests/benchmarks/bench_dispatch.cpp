// How far viscard-mpi reaches: what one answer costs rank 0, measured, and what that means for more ranks than
// there are, from the product's dispatcher against a model of latencies. Asserts nothing.
//   mpirun -n 3 bench_dispatch
#include "io/cli/mpi/mpi_ranks.h"
#include "io/flow/sweep/point_dispatcher.h"
#include "io/flow/sweep/run_study.h"
#include "tests/support/dispatch_model.h"

#include <fmt/format.h>
#include <time.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

namespace {

using namespace viscard;
using namespace viscard::test;

constexpr int kExchanges = 4000;  // with each other rank

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// As large as the answer of a pillar on a film.
StudyPoint usual_point(std::int64_t number) {
  StudyPoint point{.point = number, .values = {{"geometry.diameter", "40 um"}}};
  for (const char* name : {"electrode_voltage", "top_displacement", "base_stress_mean"}) {
    point.results.push_back({name, 0.123456789012345, "V", 1.2345e-6});
  }
  return point;
}

// Decoding, bookkeeping and storing of one answer, without messages.
double keeping_s(std::size_t at_once) {
  char folder[] = "/tmp/bench-dispatch-XXXXXX";
  if (mkdtemp(folder) == nullptr) return 0.0;
  const std::string study_file = std::string(folder) + "/study.toml";
  std::ofstream(std::string(folder) + "/scene.toml") << "tolerance = 1e-2\n";
  std::ofstream(study_file) << "scene = \"scene.toml\"\npoints = 100000\n[[parameter]]\n"
                               "key = \"geometry.diameter\"\nfrom = \"30 um\"\nto = \"50 um\"\n";
  const Study study = read_study(study_file);
  StudyStore store(std::string(folder) + "/study.sqlite", study);
  constexpr std::int64_t kPoints = 20000;
  std::vector<std::int64_t> open(kPoints);
  std::iota(open.begin(), open.end(), std::int64_t{0});
  PointDispatcher dispatcher(open, 60.0);
  std::vector<std::string> answers;
  for (std::int64_t i = 0; i < kPoints; ++i) answers.push_back(bytes_from_point(usual_point(i)));
  const double began_s = thread_cpu_s();
  std::vector<StudyPoint> kept;
  for (const std::string& answer : answers) {
    const auto point = dispatcher.ask(1, 0.0);
    if (point && dispatcher.take(1, *point, 0.0)) kept.push_back(point_from_bytes(answer));
    if (kept.size() == at_once) {
      store.add(kept);
      kept.clear();
    }
  }
  const double cost_s = (thread_cpu_s() - began_s) / kPoints;
  std::filesystem::remove_all(folder);
  return cost_s;
}

// Receiving an answer and sending a point, by rank 0.
double messages_s(MpiRanks& ranks) {
  const std::string answer = bytes_from_point(usual_point(1));
  const int n = kExchanges * (ranks.size() - 1);
  if (ranks.rank() != 0) {
    for (int i = 0; i < kExchanges; ++i) {
      ranks.send(0, RankTag::kAnswer, answer);
      while (!ranks.receive()) {
      }
    }
    return 0.0;
  }
  const double began_s = thread_cpu_s();
  double idle_s = 0.0;
  for (int i = 0; i < n;) {
    const double before_s = thread_cpu_s();
    const auto message = ranks.receive();
    if (!message) {
      idle_s += thread_cpu_s() - before_s;
      continue;
    }
    ranks.send(message->rank, RankTag::kPoint, std::to_string(i));
    ++i;
  }
  return (thread_cpu_s() - began_s - idle_s) / n;
}

void print_model(double service_s) {
  constexpr double kLatency_s = 20e-6;  // of a message in a cluster's network, with software
  fmt::print(
      "\nefficiency (time of all points over that of all ranks), {:.0f} us an answer, {:.0f} us a "
      "message,\n100 points for each rank, ln(time) scatters by 0.5\n\n{:>10}",
      1e6 * service_s, 1e6 * kLatency_s, "ranks");
  const std::vector<double> times_s{0.01, 0.1, 1.0, 10.0};
  for (const double time_s : times_s) fmt::print("{:>12}", fmt::format("{:g} s", time_s));
  fmt::print("\n");
  for (const int n_workers : {2, 64, 1000, 10000}) {
    fmt::print("{:>10}", n_workers);
    for (const double time_s : times_s) {
      DispatchModel model{.n_workers = n_workers, .n_points = 100 * std::int64_t{n_workers}};
      model.point_s = time_s;
      model.spread = 0.5;
      model.latency_s = kLatency_s;
      model.service_s = service_s;
      const DispatchTime found = simulated_dispatch(model);
      fmt::print("{:>12}", fmt::format("{:.1f} %{}", 100.0 * found.efficiency,
                                       found.busy > 0.9 ? " *" : "  "));
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
  fmt::print("* rank 0 is busy all the time; it serves {:.0f} answers a second\n", 1.0 / service_s);
}

}  // namespace

int main(int argc, char** argv) {
  MpiRanks ranks(argc, argv);
  if (ranks.size() < 2) {
    fmt::print("call it as: mpirun -n 3 bench_dispatch\n");
    return 2;
  }
  const double message_s = messages_s(ranks);
  if (ranks.rank() != 0) return 0;
  const double alone_s = keeping_s(1), together_s = keeping_s(64);
  fmt::print(
      "rank 0 for one answer: messages {:.1f} us, decoding and storing {:.1f} us "
      "({:.1f} us if each is written by itself)\n",
      1e6 * message_s, 1e6 * together_s, 1e6 * alone_s);
  print_model(message_s + together_s);
  return 0;
}
