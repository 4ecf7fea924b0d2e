// Times fit_relaxation() on data in memory: all orders, their choice, covariance and intervals.
//   bench_fit FILE REPEATS [TERMS]
// FILE holds doubles: all times in s, then as many moduli. Prints one JSON object: median processor
// time of a fit (one thread), order, residual sum of squares, and the most memory held beyond the
// data and the program itself. A first fit of a few samples reads in the program's pages.
#include "fit/fit_relaxation.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

viscard::RelaxationData read_data(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw std::runtime_error("cannot read " + path);
  const auto count = static_cast<std::size_t>(file.tellg()) / (2 * sizeof(double));
  viscard::RelaxationData data;
  data.time_s.resize(count);
  data.value.resize(count);
  file.seekg(0);
  const auto bytes = static_cast<std::streamsize>(count * sizeof(double));
  file.read(reinterpret_cast<char*>(data.time_s.data()), bytes);
  file.read(reinterpret_cast<char*>(data.value.data()), bytes);
  return data;
}

// The most memory this process ever held (getrusage would count its parent's before exec).
double peak_B() {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line)) {
    if (line.starts_with("VmHWM:")) return 1024.0 * std::stod(line.substr(6));
  }
  return 0.0;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) throw std::runtime_error("usage: bench_fit FILE REPEATS [TERMS]");
  const viscard::RelaxationData data = read_data(argv[1]);
  viscard::FitOptions options;
  if (argc > 3) options.n_terms = std::atoi(argv[3]);
  const auto few_rows = static_cast<std::ptrdiff_t>(std::min<std::size_t>(500, data.time_s.size()));
  const viscard::RelaxationData few{{data.time_s.begin(), data.time_s.begin() + few_rows},
                                    {data.value.begin(), data.value.begin() + few_rows},
                                    {}};
  viscard::fit_relaxation(few, options);
  const double before_B = peak_B();
  std::vector<double> spent_s;
  viscard::FitResult fit;
  for (int i = 0; i < std::max(1, std::atoi(argv[2])); ++i) {
    const std::clock_t begin = std::clock();
    fit = viscard::fit_relaxation(data, options);
    spent_s.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  std::sort(spent_s.begin(), spent_s.end());
  std::printf("{\"seconds\": %.6g, \"n_terms\": %zu, \"rss\": %.12g, \"orders\": %zu, ",
              spent_s[spent_s.size() / 2], fit.terms.size(), fit.rss, fit.orders.size());
  std::printf("\"E_inf\": %.9g, \"data_B\": %.0f, \"extra_B\": %.0f}\n", fit.E_inf_Pa,
              16.0 * static_cast<double>(data.time_s.size()), peak_B() - before_B);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_fit: %s\n", error.what());
  return 1;
}
