// A cost study on a machine that others use: rows are ranked by processor time, the study ends
// within its budget, and rows that do not fit are predicted. The clock of these tests is counted,
// not read, so that they give the same numbers on any machine.
#include "io/cost/cost_model.h"
#include "io/cost/study_cost.h"
#include "io/cost/study_trials.h"
#include "io/scenes/scene_file.h"
#include "models/maths/may_stop.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

using namespace viscard;

namespace {

struct Hours {
  double wall_s = 0.0, cpu_s = 0.0;
  CostClock clock() {
    return {.wall_s = [this] { return wall_s; }, .cpu_s = [this] { return cpu_s; }};
  }
};

constexpr double kPerUnknown_s = 1e-6;
constexpr double kPower = 1.5;
double law_s(double unknowns) {
  return kPerUnknown_s * std::pow(unknowns, kPower);
}

SceneAnswer answer_with(double error, double unknowns) {
  SceneAnswer answer;
  answer.results = {{"top_displacement", 1.0 + error, "m"}};
  answer.unknowns = static_cast<int>(unknowns);
  return answer;
}

// A row that costs what the law says, times `busy` of wall time.
CostTrial trial_of_law(Hours& hours, const std::string& name, const std::string& kind,
                       double unknowns, double error, double busy = 1.0) {
  return {.discretisation = name,
          .effects = "all on",
          .mesh = {},
          .run =
              [&hours, unknowns, error, busy] {
                hours.cpu_s += law_s(unknowns);
                hours.wall_s += busy * law_s(unknowns);
                return answer_with(error, unknowns);
              },
          .kind = kind,
          .size = 3.0 * unknowns};
}

// References of 3000 to 27000 unknowns, 4.4 s the finest; linear elements up to 1e6.
CostTrials trials_of_law(Hours& hours, double busy) {
  CostTrials trials;
  for (int p = 3; p <= 9; ++p) {
    trials.references.push_back(trial_of_law(hours, "reference p" + std::to_string(p), "reference",
                                             333.0 * p * p, std::pow(10.0, -p), busy));
  }
  for (const int p : {2, 3, 4, 5}) {
    trials.rows.push_back(trial_of_law(hours, "graded p" + std::to_string(p), "graded p",
                                       100.0 * p * p, std::pow(10.0, -p), busy));
  }
  for (const double n : {1e3, 1e4, 1e5, 1e6}) {
    trials.rows.push_back(trial_of_law(hours, "h1 " + std::to_string(n), "h1", n, 10.0 / n, busy));
  }
  return trials;
}

double longest_row_s(const CostStudy& study) {
  double longest = 0.0;
  for (const CostRow& row : study.rows) longest = std::max(longest, row.wall_s);
  return longest;
}

}  // namespace

TEST_CASE("a row that waited for the processor ranks as high as its work deserves", "[io][scene]") {
  Hours hours;
  CostTrials trials = trials_of_law(hours, 1.0);
  // Other programs took the processor while the best row ran: 1000 times its own time.
  trials.rows[2] = trial_of_law(hours, "graded p4", "graded p", 1600.0, 1e-4, 1000.0);
  const CostStudy study = study_of(trials, {.budget_s = 1e4, .clock = hours.clock()});
  const auto row = std::find_if(study.rows.begin(), study.rows.end(), [](const CostRow& one) {
    return one.discretisation == "graded p4";
  });
  REQUIRE(row != study.rows.end());
  CHECK(row->is_on_front);
  CHECK(row->cpu_s == Approx(law_s(1600.0)).epsilon(1e-9));
  CHECK(row->wall_s == Approx(1000.0 * law_s(1600.0)).epsilon(1e-9));
  // Graded p4 is the cheapest for 1e-3: p3 has twice the error that it may have.
  CHECK(study.rows[static_cast<std::size_t>(study.advice[2].row)].discretisation == "graded p4");
}

TEST_CASE("a mesh without an answer does not end a cost study", "[io][scene]") {
  Hours hours;
  const auto fails = [](CostTrial& trial) {
    trial.run = []() -> SceneAnswer { throw std::runtime_error("no equilibrium"); };
  };
  const CostTrials whole = trials_of_law(hours, 1.0);
  CostTrials trials = whole;
  fails(trials.rows[1]);
  fails(trials.references.front());
  fails(trials.references.back());
  const CostStudy study = study_of(trials, {.budget_s = 1e6, .clock = hours.clock()});
  CHECK(study.rows.size() == trials.rows.size() - 1);
  CHECK(study.predicted.empty());
  REQUIRE(study.failed.size() == 3);
  CHECK(study.failed.back().discretisation == trials.rows[1].discretisation);
  CHECK(study.failed.back().reason == "no equilibrium");
  CHECK(study.reference == trials.references[trials.references.size() - 2].discretisation);
  // Between the reference of degree 8 and the first that has an answer.
  CHECK(study.reference_error == Approx(1e-4).epsilon(1e-2));
  CHECK(study.why_alone.empty());
  trials = whole;
  for (CostTrial& trial : trials.references) fails(trial);
  CHECK_THROWS_WITH(study_of(trials, {.budget_s = 1e6, .clock = hours.clock()}),
                    Catch::Contains("no equilibrium"));
}

TEST_CASE("a cost study ends within its budget plus one row", "[io][scene]") {
  const double budget_s = GENERATE(0.1, 1.0, 5.0, 20.0, 60.0);
  const double busy = GENERATE(1.0, 10.0);
  CAPTURE(budget_s, busy);
  Hours hours;
  const CostTrials trials = trials_of_law(hours, busy);
  const CostStudy study =
      study_of(trials, {.budget_s = budget_s, .repeats = 3, .clock = hours.clock()});
  CHECK(study.wall_s == Approx(hours.wall_s));
  const double coarsest_s = busy * law_s(333.0 * 9.0);  // the reference that always runs
  const double shown_s = 0.3;                           // three rows of less than 0.1 s each
  CHECK(hours.wall_s <= budget_s + std::max(longest_row_s(study), coarsest_s) + shown_s);
  CHECK(study.rows.size() + study.predicted.size() == trials.rows.size());
  CHECK(std::any_of(study.rows.begin(), study.rows.end(),
                    [](const CostRow& row) { return row.discretisation.rfind("h1", 0) == 0; }));
}

// A row that was predicted to take a tenth of a second, and would take hours.
TEST_CASE("a row that is not done when the budget is over is ended", "[io][scene]") {
  Hours hours;
  CostTrials trials = trials_of_law(hours, 1.0);
  trials.rows[3].run = [&hours]() -> SceneAnswer {
    for (int step = 0; step < 10000; ++step) {
      hours.wall_s += 1.0;
      hours.cpu_s += 1.0;
      may_stop();
    }
    return answer_with(1e-6, 2500.0);
  };
  CostOptions options{.budget_s = 100.0, .clock = hours.clock()};
  const bool of_processor = GENERATE(false, true);
  if (of_processor) options = {.budget_s = 1e4, .cpu_budget_s = 100.0, .clock = hours.clock()};
  const CostStudy study = study_of(trials, options);
  CHECK(hours.wall_s <= (of_processor ? 1000.0 : 110.0));
  CHECK(study.failed.empty());
  CHECK(std::any_of(study.predicted.begin(), study.predicted.end(), [&](const PredictedRow& row) {
    return row.discretisation == trials.rows[3].discretisation;
  }));
}

TEST_CASE("rows that are left out are predicted from those that ran", "[io][scene]") {
  Hours hours;
  const CostStudy study =
      study_of(trials_of_law(hours, 1.0), {.budget_s = 20.0, .clock = hours.clock()});
  REQUIRE_FALSE(study.predicted.empty());
  for (const PredictedRow& row : study.predicted) {
    CAPTURE(row.discretisation, row.unknowns);
    CHECK(row.unknowns == Approx(std::stod(row.discretisation.substr(3))).epsilon(1e-6));
    CHECK(row.cpu_s == Approx(law_s(row.unknowns)).epsilon(1e-6));
  }
  const auto law = std::find_if(study.laws.begin(), study.laws.end(),
                                [](const CostLaw& one) { return one.kind == "h1"; });
  REQUIRE(law != study.laws.end());
  CHECK(law->fixed_s == 0.0);
  CHECK(law->exponent == Approx(kPower).epsilon(1e-6));
  CHECK(law->seconds == Approx(kPerUnknown_s).epsilon(1e-4));
}

// A contact in time takes 4 s on every mesh.
TEST_CASE("a part that no mesh changes is learned, and leaves time for a second reference",
          "[io][scene]") {
  constexpr double kFixed_s = 4.0;
  Hours hours;
  const auto with_fixed = [&](CostTrial& trial) {
    trial.run = [&hours, run = trial.run] {
      hours.cpu_s += kFixed_s;
      hours.wall_s += kFixed_s;
      return run();
    };
  };
  CostTrials trials;
  for (int p = 3; p <= 9; ++p) {
    trials.references.push_back(trial_of_law(hours, "reference p" + std::to_string(p), "reference",
                                             20.0 * std::pow(p - 2, 2.5), std::pow(10.0, -p)));
  }
  for (int p = 3; p <= 7; ++p) {
    trials.rows.push_back(trial_of_law(hours, "graded p" + std::to_string(p), "graded p",
                                       20.0 * std::pow(p - 2, 2.5), std::pow(10.0, -p)));
  }
  for (CostTrial& trial : trials.references) with_fixed(trial);
  for (CostTrial& trial : trials.rows) with_fixed(trial);
  const CostStudy study = study_of(trials, {.budget_s = 30.0, .clock = hours.clock()});
  CHECK(study.why_alone.empty());
  CHECK(study.reference_error < 1e-4);
  CHECK(study.wall_s <= 30.0);
  REQUIRE(study.rows.size() >= 2);
  REQUIRE_FALSE(study.predicted.empty());
  for (const PredictedRow& row : study.predicted) {
    CHECK(row.cpu_s == Approx(kFixed_s + law_s(row.unknowns)).epsilon(1e-3));
  }
  REQUIRE(study.laws.size() == 1);
  CHECK(study.laws[0].fixed_s == Approx(kFixed_s).epsilon(1e-3));
  CHECK(study.laws[0].exponent == Approx(1.5));
}

TEST_CASE(
    "a reference that stands alone because finer ones failed says so, not that time was short",
    "[io][scene]") {
  Hours hours;
  CostTrials trials = trials_of_law(hours, 1.0);
  for (std::size_t i = 1; i < trials.references.size(); ++i) {
    trials.references[i].run = []() -> SceneAnswer { throw std::runtime_error("no equilibrium"); };
  }
  const CostStudy study = study_of(trials, {.budget_s = 1e6, .clock = hours.clock()});
  CHECK(std::isinf(study.reference_error));
  CHECK(study.why_alone == "no second one has an answer (no equilibrium)");
}

TEST_CASE("without time for a second reference no row is recommended", "[io][scene]") {
  Hours hours;
  const CostStudy study =
      study_of(trials_of_law(hours, 1.0), {.budget_s = 1e-3, .clock = hours.clock()});
  CHECK(std::isinf(study.reference_error));
  CHECK(study.why_alone == "the budget allowed no second one");
  for (const CostAdvice& advice : study.advice) CHECK(advice.row == -1);
}

// The unknowns of every row that a study without time leaves out, against the rows themselves.
TEST_CASE("unknowns of rows that are left out are predicted to within a few per cent",
          "[io][scene]") {
  const std::string name = GENERATE(as<std::string>{}, "pillar_sensor.toml", "array_voltages.toml");
  CAPTURE(name);
  const Scene scene = read_scene(std::string(VISCARD_SOURCE_DIR "/data/scenes/") + name).scene;
  // A clock by which no row is long: on a busy computer, or with sanitizers, the first one would be ended.
  std::atomic<int> readings{0};
  const auto late = [&readings] { return readings++ == 0 ? 0.0 : 1e-3; };
  const CostStudy study =
      study_cost(scene, {.budget_s = 1e-9, .repeats = 1, .clock = {.wall_s = late, .cpu_s = late}});
  const CostTrials trials = trials_of(scene);
  int compared = 0;
  for (const PredictedRow& row : study.predicted) {
    const auto trial =
        std::find_if(trials.rows.begin(), trials.rows.end(), [&](const CostTrial& t) {
          return t.discretisation == row.discretisation && t.effects == row.effects;
        });
    REQUIRE(trial != trials.rows.end());
    if (trial->mesh.uniform_m > 0.0 && trial->mesh.uniform_m < 2e-6) continue;  // seconds each
    CAPTURE(row.discretisation, row.effects);
    CHECK(row.unknowns == Approx(trial->run().unknowns).epsilon(0.25));
    ++compared;
  }
  CHECK(compared >= 8);
}
