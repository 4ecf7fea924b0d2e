// Measures what the rig's part of viscard costs and loses: lines a second through a pseudo-terminal,
// long streams and holds (accelerated), processor share at the rig's own pace. Asserts nothing.
//   bench_rig [FILTER]
#include "io/capture/capture_file.h"
#include "rig/cells/hx711_load_cell.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/emulator/pty_port.h"
#include "rig/lines/serial_line.h"
#include "rig/open_devices.h"
#include "rig/run/run_session.h"
#include "rig/run_indentation.h"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <variant>

namespace {

using namespace viscard;

double resident_megabytes() {
  std::ifstream file("/proc/self/statm");
  long total = 0, resident = 0;
  file >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct StreamBench {
  long n_lines = 0;
  double per_second = 0.0;  // by the device's clock
  double speed = 1.0;       // of the host's clock
  bool is_paced = false;    // at that pace, or as fast as the pseudo-terminal takes them
};

// The device: lines of an amplifier with its clock, in bursts every fraction of a millisecond.
void send_lines(PtyPort& device, const StreamBench& bench) {
  const double began_s = monotonic_s();
  long sent = 0;
  while (sent < bench.n_lines || device.has_unsent()) {
    const double passed_s = (monotonic_s() - began_s) * bench.speed;
    const long due =
        bench.is_paced ? static_cast<long>(passed_s * bench.per_second) : bench.n_lines;
    const long until = std::min({due, bench.n_lines, sent + 2000});
    std::string text;
    for (; sent < until && !device.has_unsent(); ++sent) {
      const double micros = static_cast<double>(sent) * 1e6 / bench.per_second;
      text += std::to_string(static_cast<std::uint32_t>(static_cast<std::uint64_t>(micros)));
      text += "," + std::to_string(1000000 + sent % 7) + "\r\n";
    }
    device.write(text);
    std::this_thread::sleep_for(std::chrono::microseconds(device.has_unsent() ? 50 : 200));
  }
}

void stream(const char* name, const StreamBench& bench) {
  PtyPort device;
  const RigClock clock(bench.speed);
  SerialLine line(device.path(), 2000000, clock);
  LoadCellConfig config;
  config.line_format = "micros,counts";
  config.expected_rate_Hz = bench.per_second;
  long n_samples = 0;
  Hx711LoadCell cell(line, config, clock, [&](const RunRecord& record) {
    n_samples += std::holds_alternative<LoadSample>(record) ? 1 : 0;
  });
  const double began_s = monotonic_s(), cpu_s = thread_cpu_s();
  std::thread sender([&] { send_lines(device, bench); });
  double early_MB = 0.0, quiet_since_s = monotonic_s();
  const long expected = bench.n_lines - 7;  // the first may be cut, the format is learnt from six
  while (n_samples < expected && monotonic_s() - quiet_since_s < 5.0) {
    const long before = n_samples;
    wait_readable({&line}, clock, 0.01);
    cell.service();
    if (n_samples > before) quiet_since_s = monotonic_s();
    if (early_MB == 0.0 && n_samples > bench.n_lines / 10) early_MB = resident_megabytes();
  }
  const double took_s = monotonic_s() - began_s;
  sender.join();
  const StreamCounts& counts = cell.counts();
  std::printf(
      "%-42s %9ld lines in %5.1f s, %8.0f lines/s, %4.1f %% of a core; lost %ld, missing %lld, "
      "unreadable %lld; memory %.1f MB after a tenth, %.1f at the end\n",
      name, bench.n_lines, took_s, static_cast<double>(bench.n_lines) / took_s,
      100.0 * (thread_cpu_s() - cpu_s) / took_s, expected - n_samples,
      static_cast<long long>(counts.missing), static_cast<long long>(counts.unreadable), early_MB,
      resident_megabytes());
}

// A whole run with its capture file; the hold takes an hour of the emulated clock.
void hour_of_hold() {
  EmulatedRigOptions options;
  options.truth = demo_truth(10.0, 1);
  options.truth.surface_position_m = 0.1e-3;
  options.config = demo_rig();
  options.config.clock_speed = 300.0;
  const EmulatedRig emulated(options);
  const RigConfig rig = emulated.config();
  TestPlan plan;
  plan.hold_s = 3600.0;
  const RigClock clock = emulated.clock();
  const auto path = std::filesystem::temp_directory_path() /
                    ("viscard-bench-" + std::to_string(getpid()) + ".viscap");
  CapturedRun about;
  about.rig = rig;
  about.plan = plan;
  about.specimen = demo_specimen(10.0);
  double early_MB = 0.0;
  const double began_s = monotonic_s();
  RunOutcome outcome;
  std::size_t dropped = 0;
  {
    CaptureWriter writer(path, about);
    const RecordSink sink = [&](const RunRecord& record) { writer.append(record); };
    RigDevices devices = open_ports(rig, clock);
    add_drivers(devices, rig, clock, sink);
    RunControl control;
    control.clock = &clock;
    control.progress = [&](const RunProgress& now) {
      if (early_MB == 0.0 && now.phase == "hold" && now.time_s > 400.0)
        early_MB = resident_megabytes();
    };
    outcome = run_indentation(*devices.stage, *devices.load_cell, rig, plan, about.specimen, sink,
                              control);
    writer.finish(outcome.status == "finished" ? "finished" : "interrupted");
    dropped = writer.counts().dropped;
  }
  const double late_MB = resident_megabytes();
  const std::size_t in_file = read_capture(path).load_samples.size();
  std::filesystem::remove(path);
  std::printf(
      "%-42s %9lld readings in %5.1f s: %s; missing %lld, dropped %zu, in the file %zu; memory "
      "%.1f MB early, %.1f at the end\n",
      "hold of one hour at 80/s, captured", static_cast<long long>(outcome.stream.received),
      monotonic_s() - began_s, outcome.status.c_str(),
      static_cast<long long>(outcome.stream.missing), dropped, in_file, early_MB, late_MB);
}

// Both devices served as in a run, for some true seconds; the emulator's own thread is not counted.
void share_at_80() {
  EmulatedRigOptions options;
  options.truth = demo_truth(10.0, 1);
  options.config = demo_rig();
  options.is_on_wall_clock = true;
  const EmulatedRig emulated(options);
  const RigConfig rig = emulated.config();
  const RigClock clock;
  long n_samples = 0;
  const RecordSink sink = [&](const RunRecord& record) {
    n_samples += std::holds_alternative<LoadSample>(record) ? 1 : 0;
  };
  RigDevices devices = open_ports(rig, clock);
  add_drivers(devices, rig, clock, sink);
  RunControl control;
  control.clock = &clock;
  RunSession session(*devices.stage, *devices.load_cell, rig, sink, control);
  session.connect();
  n_samples = 0;
  const double began_s = monotonic_s(), cpu_s = thread_cpu_s();
  session.pump_until(clock.now_s() + 10.0);
  const double took_s = monotonic_s() - began_s;
  std::printf("%-42s %9ld readings in %5.1f s, %.2f %% of a core\n",
              "both devices at 80/s, at rest", n_samples, took_s,
              100.0 * (thread_cpu_s() - cpu_s) / took_s);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string wanted = argc > 1 ? argv[1] : "";
  const auto is_wanted = [&](const char* name) {
    return wanted.empty() || wanted == "rig" || std::string(name).find(wanted) != std::string::npos;
  };
  if (is_wanted("throughput")) {
    stream("throughput", {.n_lines = 1'000'000, .per_second = 80.0, .speed = 1e5});
  }
  if (is_wanted("ten minutes at 10 000/s")) {
    stream("ten minutes at 10 000 lines/s, 10 x faster",
           {.n_lines = 6'000'000, .per_second = 10'000.0, .speed = 10.0, .is_paced = true});
  }
  if (is_wanted("hour of hold")) hour_of_hold();
  if (is_wanted("share at 80/s")) share_at_80();
  return 0;
}
