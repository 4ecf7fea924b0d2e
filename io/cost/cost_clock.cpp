#include "io/cost/cost_clock.h"

#include <malloc.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

namespace viscard {
namespace {

double process_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double steady_s() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

// A line of /proc/self/status in bytes; 0 if it is not there.
double status_B(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kB = 0.0;
  while (status >> word) {
    if (word == key && status >> kB) return 1024.0 * kB;
  }
  return 0.0;
}

// The first "model name : ..." of /proc/cpuinfo; some architectures have none.
std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  std::string line;
  while (std::getline(info, line)) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "";
}

}  // namespace

CostClock process_clock() {
  return {.wall_s = steady_s, .cpu_s = process_cpu_s};
}

CostMachine this_machine() {
  CostMachine machine{.processor = processor_name(),
                      .cores = static_cast<int>(std::thread::hardware_concurrency())};
  double load = 0.0;
  if (getloadavg(&load, 1) == 1) machine.load = load;
  return machine;
}

double resident_B() {
  return status_B("VmRSS:");
}

double peak_resident_B() {
  return status_B("VmHWM:");
}

void forget_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // proc(5): resets the peak
}

}  // namespace viscard
