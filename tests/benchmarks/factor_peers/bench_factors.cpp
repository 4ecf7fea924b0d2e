// Whole answers of the pillar solver with our factorisation and with those of CHOLMOD and Eigen,
// side by side in one process. The solver is compiled once more for this: shadow/ holds a header in
// place of the product's, which chooses at run time.
//
// usage: bench_factors [ROUNDS [FILTER]]
#include "models/pillar/system/stiffness_factor.h"
#include "tests/benchmarks/factor_peers/answer_cases.h"
#include "tests/benchmarks/factor_peers/peer_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#ifndef VISCARD_FACTOR_IS_CHOSEN
#error "the solver was compiled with its own factorisation: the path in shadow/ is out of date"
#endif

using namespace viscard;
using namespace viscard::peers;

namespace {

struct Contender {
  const char* name;
  FactorKind kind;
};
const std::vector<Contender> kContenders = {
    {"ours", FactorKind::kOurs},
    {"CHOLMOD LDL' AMD", FactorKind::kCholmodAmd},
    {"CHOLMOD LDL' METIS", FactorKind::kCholmodMetis},
    {"CHOLMOD LL' supernodal", FactorKind::kCholmodSupernodal},
    {"CHOLMOD its choice", FactorKind::kCholmodAuto},
    {"Eigen LDL' AMD", FactorKind::kEigen}};

// Our own code must be this much faster than a library, in the mean of whole answers.
constexpr double kAim = 1.5;

struct Sample {
  double whole_s = 0.0;
  Spent spent;
};

// One sample: the mean over so many answers that it lasts 20 ms or more.
Sample sample_of(const AnswerCase& question, int repeats, Answer& answer) {
  spent() = Spent{};
  const double start_s = cpu_s();
  for (int i = 0; i < repeats; ++i) answer = question.run();
  Sample sample{(cpu_s() - start_s) / repeats, spent()};
  for (double* part : {&sample.spent.analyse, &sample.spent.factor, &sample.spent.solve}) {
    *part /= repeats;
  }
  for (int* count : {&sample.spent.analyses, &sample.spent.factors, &sample.spent.solves}) {
    *count /= repeats;
  }
  return sample;
}

Sample median_of(std::vector<Sample> samples) {
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end(),
                   [](const Sample& a, const Sample& b) { return a.whole_s < b.whole_s; });
  return *middle;
}

// Largest difference of two answers, over the error estimate of the first.
double difference(const Answer& ours, const Answer& theirs) {
  if (ours.value.size() != theirs.value.size()) return HUGE_VAL;
  double largest = 0.0;
  for (std::size_t i = 0; i < ours.value.size(); ++i) {
    const double off = std::abs(theirs.value[i] - ours.value[i]);
    if (off > 0.0) largest = std::max(largest, off / ours.error[i]);
  }
  return largest;
}

// Sums of the logarithms of ratios, for their geometric mean.
struct Mean {
  double logarithms = 0.0;
  int count = 0;
};

void print_row(const Contender& contender, const Sample& sample, double ours_s, double off) {
  const Spent& s = sample.spent;
  fmt::print(
      "  {:<23}{:>9.2f} ms {:>6.2f} x  order {:>7.2f} factor {:>7.2f} solve {:>7.2f}  "
      "({}, {}, {})  L {:>8}  differs by {:.1e}\n",
      contender.name, 1e3 * sample.whole_s, sample.whole_s / ours_s, 1e3 * s.analyse,
      1e3 * s.factor, 1e3 * s.solve, s.analyses, s.factors, s.solves, s.entries, off);
}

void compare(const AnswerCase& question, int rounds, std::map<std::string, Mean>& means) {
  Answer answer;
  choice() = kContenders.front().kind;
  const Sample first = sample_of(question, 1, answer);
  const int repeats = std::max(1, static_cast<int>(0.02 / first.whole_s));
  std::vector<std::vector<Sample>> samples(kContenders.size());
  std::vector<Answer> answers(kContenders.size());
  std::vector<std::string> failure(kContenders.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < kContenders.size(); ++i) {
      choice() = kContenders[i].kind;
      if (!failure[i].empty()) continue;
      try {
        samples[i].push_back(sample_of(question, repeats, answers[i]));
      } catch (const std::exception& error) {
        failure[i] = error.what();
      }
    }
  }
  const double ours_s = median_of(samples.front()).whole_s;
  fmt::print("{}: {} unknowns\n", question.name, first.spent.largest);
  for (std::size_t i = 0; i < kContenders.size(); ++i) {
    if (!failure[i].empty()) {
      fmt::print("  {:<23} fails: {}\n", kContenders[i].name, failure[i]);
    } else if (!samples[i].empty()) {
      const Sample median = median_of(samples[i]);
      print_row(kContenders[i], median, ours_s, difference(answers.front(), answers[i]));
      Mean& mean = means[kContenders[i].name];
      mean.logarithms += std::log(median.whole_s / ours_s);
      ++mean.count;
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  const std::string filter = argc > 2 ? argv[2] : "";
  fmt::print(
      "Whole answers in processor time, medians of {} rounds; in ms the share of ordering, "
      "factoring and solving, and\nhow often; "
      "entries of the largest L; the largest difference from\nour answer over its error "
      "estimate.\n",
      rounds);
  std::map<std::string, Mean> means;
  for (const AnswerCase& question : answer_cases()) {
    if (question.name.find(filter) != std::string::npos) compare(question, rounds, means);
  }
  fmt::print("Geometric means of whole answers over ours:\n");
  bool is_short = false;
  for (const Contender& contender : kContenders) {
    const Mean& mean = means[contender.name];
    if (mean.count > 0) {
      fmt::print("  {:<23}{:>6.2f} x  ({} answers)\n", contender.name,
                 std::exp(mean.logarithms / mean.count), mean.count);
      is_short = is_short || (contender.kind != FactorKind::kOurs && filter.empty() &&
                              mean.logarithms < mean.count * std::log(kAim));
    }
  }
  if (is_short) fmt::print("short of its aim: a library's mean is below {} times ours\n", kAim);
  return is_short ? 1 : 0;
}
