// Captures on the emulated rig through both ptys, fits them and compares with the truth, for many
// seeds: the numbers that the demo promises.
#include "io/cli/report/report_commands.h"
#include "io/config/config_file.h"
#include "io/materials/material_file.h"
#include "tests/flow/flow_support.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr const char* kStems[] = {"03_pdms_1to10", "04_pdms_1to13", "05_pdms_1to20"};

struct Recovery {
  std::vector<ScoreRow> rows;
  std::size_t n_terms = 0;
  double sum_g = 0.0;
  double sum_g_half_width = 0.0;
};

// Half-width of the 95 % interval of g_1 + g_2 from the covariance of (E_inf, E_1, E_2):
// sum g = 1 - E_inf/E_0, so its gradient is -1/E0 + E_inf/E0^2 for E_inf and E_inf/E0^2 for each
// E_i.
double half_width_of_sum_g(const Material& material) {
  const MaterialUncertainty& uncertainty = material.uncertainty.value();
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(uncertainty.covariance.rows());
  double sum_g = 0.0;
  for (const MaterialTerm& term : material.terms) sum_g += term.g;
  const double E_inf_over_E0_squared = (1.0 - sum_g) / material.E0_Pa;
  for (std::size_t i = 0; i < uncertainty.covariance_parameters.size(); ++i) {
    const std::string& name = uncertainty.covariance_parameters[i];
    const auto row = static_cast<Eigen::Index>(i);
    if (name == "E_inf_Pa") gradient[row] = E_inf_over_E0_squared - 1.0 / material.E0_Pa;
    if (name.starts_with("E_") && name != "E_inf_Pa") gradient[row] = E_inf_over_E0_squared;
  }
  return 1.96 * std::sqrt(gradient.dot(uncertainty.covariance * gradient));
}

Recovery recover(const ScratchFolder& folder, const std::string& stem, int seed) {
  const std::string capture = folder / (stem + "-" + std::to_string(seed) + ".viscap");
  const std::string fitted = folder / (stem + "-" + std::to_string(seed) + ".json");
  const CommandRun captured =
      run_words({"capture", "--emulate", "--truth", demo_file(stem + ".truth.toml"), "--seed",
                 std::to_string(seed), "--test", demo_file("02_test.toml"), "--specimen",
                 demo_file(stem + ".toml"), "--speed", "50", "--out", capture});
  INFO(captured.err);
  REQUIRE(captured.status == 0);
  const CommandRun fit = run_words({"fit", capture, "--out", fitted});
  INFO(fit.err);
  REQUIRE(fit.status == 0);
  const Material material = read_material(fitted).material;
  Recovery recovery;
  recovery.rows = score_rows(stem, read_truth(demo_file(stem + ".truth.toml")), material);
  recovery.n_terms = material.terms.size();
  for (const MaterialTerm& term : material.terms) recovery.sum_g += term.g;
  recovery.sum_g_half_width = half_width_of_sum_g(material);
  return recovery;
}

struct Tally {
  int n_intervals = 0;
  int n_inside = 0;
  double worst_E0_error = 0.0;
  double widest_sum_g = 0.0;
};

Tally study(int n_seeds) {
  const ScratchFolder folder;
  Tally tally;
  for (const char* stem : kStems) {
    for (int seed = 1; seed <= n_seeds; ++seed) {
      CAPTURE(stem, seed);
      const Recovery recovery = recover(folder, stem, seed);
      CHECK(recovery.n_terms == 2);
      for (const ScoreRow& row : recovery.rows) {
        ++tally.n_intervals;
        tally.n_inside += row.is_inside ? 1 : 0;
      }
      const double E0_error = std::abs(recovery.rows[0].estimate / recovery.rows[0].truth - 1.0);
      CHECK(E0_error < 0.01);
      CHECK(recovery.sum_g_half_width < 0.10 * recovery.sum_g);
      tally.worst_E0_error = std::max(tally.worst_E0_error, E0_error);
      tally.widest_sum_g = std::max(tally.widest_sum_g, recovery.sum_g_half_width / recovery.sum_g);
    }
  }
  std::cout << tally.n_inside << " of " << tally.n_intervals
            << " intervals hold the truth; largest error of E0 " << 100.0 * tally.worst_E0_error
            << " %, widest g_1 + g_2 +-" << 100.0 * tally.widest_sum_g << " %\n";
  return tally;
}

}  // namespace

TEST_CASE("the emulated rig's truth is recovered for all three ratios", "[flow][pty]") {
  const Tally tally = study(2);
  // 30 intervals of 95 %: fewer than 24 inside has a probability below 1e-3.
  CHECK(tally.n_inside >= 24);
}

TEST_CASE("600 intervals over 40 seeds and three ratios cover the truth at their stated rate",
          "[flow][pty][slow]") {
  const Tally tally = study(40);
  REQUIRE(tally.n_intervals == 600);
  CHECK(tally.n_inside >= 540);
  CHECK(tally.n_inside <= 594);
}
