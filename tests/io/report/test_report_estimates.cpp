#include "io/report/report_estimates.h"
#include "io/report/report_figures.h"
#include "io/report/report_numbers.h"
#include "io/report/report_tables.h"
#include "tests/io/report/synthetic_report.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace viscard;

namespace {

SpecimenEstimates one_term() {
  SpecimenEstimates estimates;
  estimates.E0_Pa = {10.0, {9.0, 11.0}};
  estimates.E_inf_Pa = {6.0, {5.0, 7.0}};
  estimates.terms = {{{4.0, {3.0, 5.0}}, {0.4, {0.3, 0.5}}, {2.0, {1.5, 2.7}}}};
  estimates.covariance_parameters = {"E_inf_Pa", "E_1_Pa", "ln_tau_1", "contact_position_m"};
  estimates.covariance = Eigen::MatrixXd::Zero(4, 4);
  return estimates;
}

Material one_term_truth(double E0_Pa, double g, double tau_s) {
  Material material;
  material.E0_Pa = E0_Pa;
  material.nu = 0.3;
  material.terms = {{g, g, tau_s}};
  return material;
}

}  // namespace

TEST_CASE("the band of E(t) is the propagated covariance", "[io][report]") {
  SpecimenEstimates estimates = one_term();
  estimates.covariance.diagonal() << 0.04, 0.09, 0.01, 1e6;  // the last is a nuisance
  estimates.covariance(0, 1) = estimates.covariance(1, 0) = -0.03;
  const double t = 3.0, decay = std::exp(-1.5);
  const RelaxationBand band = relaxation_band(estimates, {t}, false);
  CHECK(band.value[0] == Approx(6.0 + 4.0 * decay).epsilon(1e-14));  // closed form, rounding
  const double d_ln_tau = 4.0 * decay * 1.5;
  const double variance = 0.04 + 0.09 * decay * decay - 0.06 * decay + 0.01 * d_ln_tau * d_ln_tau;
  CHECK(band.high[0] - band.value[0] ==
        Approx(1.959963984540054 * std::sqrt(variance)).epsilon(1e-12));
}

TEST_CASE("stiffnesses have the same band as moduli", "[io][report]") {
  SpecimenEstimates estimates = one_term();
  estimates.covariance.diagonal() << 0.04, 0.09, 0.01, 0.0;
  const RelaxationBand moduli = relaxation_band(estimates, {3.0}, false);
  estimates.is_stiffness = true;
  estimates.covariance_parameters = {"E_inf_N_m", "E_1_N_m", "ln_tau_1", "contact_position_m"};
  CHECK(relaxation_band(estimates, {3.0}, false).high[0] == moduli.high[0]);
}

TEST_CASE("a common factor of all moduli gives the relative band no width", "[io][report]") {
  SpecimenEstimates estimates = one_term();
  Eigen::VectorXd scale(4);
  scale << 6.0, 4.0, 0.0, 0.0;  // E_inf and E_1 move together
  estimates.covariance = 0.01 * scale * scale.transpose();
  const RelaxationBand absolute = relaxation_band(estimates, {0.0, 1.0, 10.0}, false);
  const RelaxationBand relative = relaxation_band(estimates, {0.0, 1.0, 10.0}, true);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(absolute.high[i] - absolute.value[i] ==
          Approx(1.959963984540054 * 0.1 * absolute.value[i]).epsilon(1e-12));
    CHECK(relative.high[i] - relative.value[i] == Approx(0.0).margin(1e-7));  // sqrt of rounding
  }
}

TEST_CASE("without a covariance there is a curve but no band", "[io][report]") {
  SpecimenEstimates estimates = one_term();
  estimates.covariance.resize(0, 0);
  const RelaxationBand band = relaxation_band(estimates, {1.0}, false);
  CHECK(band.value.size() == 1);
  CHECK(band.low.empty());
}

TEST_CASE("truth is inside, inside with the systematic part, or outside", "[io][report]") {
  SpecimenEstimates estimates = one_term();
  estimates.systematic_relative = 0.1;  // 1.96 x 10 % of 10 = 1.96, with the random 1: 2.2
  const auto verdict = [&](double E0_Pa) {
    return recovered_parameters(estimates, one_term_truth(E0_Pa, 0.4, 2.0)).front().recovery;
  };
  CHECK(verdict(10.9) == Recovery::kInside);
  CHECK(verdict(12.1) == Recovery::kInsideWithSystematic);
  CHECK(verdict(12.3) == Recovery::kOutside);
  CHECK(verdict(7.85) == Recovery::kInsideWithSystematic);
  // without its causes the systematic part is taken to scale moduli only
  const auto rows = recovered_parameters(estimates, one_term_truth(10.0, 0.51, 2.0));
  CHECK(rows[2].recovery == Recovery::kOutside);
}

TEST_CASE("terms pair by nearest relaxation time; those without a partner are not resolved",
          "[io][report]") {
  SpecimenEstimates estimates = one_term();
  Material truth = one_term_truth(10.0, 0.1, 0.01);
  truth.terms.push_back({0.4, 0.4, 1.9});
  auto rows = recovered_parameters(estimates, truth);
  REQUIRE(rows.size() == 6);
  CHECK(rows[2].recovery == Recovery::kNotResolved);  // g_1 at 0.01 s
  CHECK(rows[4].recovery == Recovery::kInside);       // g_2 with the fitted term at 2 s
  CHECK(rows[5].estimate.value == 2.0);
  truth.terms.clear();
  rows = recovered_parameters(estimates, truth);
  REQUIRE(rows.size() == 4);  // the fitted term has no truth
  CHECK(std::isnan(rows[2].truth));
}

TEST_CASE("numbers get the decimals their interval deserves", "[io][report]") {
  const Interval interval{1.8788, 1.8854};
  CHECK(number_text(1.88207, &interval) == "1.8821");
  CHECK(interval_text(interval) == "[1.8788, 1.8854]");
  const Interval wide{100.0, 900.0};
  CHECK(number_text(512.3, &wide) == "512");
  CHECK(interval_text({0.5, std::numeric_limits<double>::infinity()}) == "[0.5, unbounded]");
  CHECK(number_text(std::numeric_limits<double>::quiet_NaN()) == "–");
  CHECK(interval_html({0.0, 0.0}, 1.0) == "");
  CHECK(number_html(1.88e6, 1e-6) == "<data value=\"1880000\">1.88</data>");
}

TEST_CASE("numbers are written as a person would", "[io][report]") {
  CHECK(readable_number(0.0, 4) == "0");
  CHECK(readable_number(-0.25, 4) == "−0.25");
  CHECK(readable_number(183000.0, 2) == "180000");
  CHECK(readable_number(2.853e-9, 3) == "2.85×10⁻⁹");
  CHECK(readable_number(1e-9, 3) == "10⁻⁹");
  CHECK(readable_number(-5e20, 1) == "−5×10²⁰");
  CHECK(readable_number(std::numeric_limits<double>::quiet_NaN(), 4) == "–");
}

TEST_CASE("units take the prefix of the largest value", "[io][report]") {
  CHECK(shown_unit("Pa", {1.88e6, 3.0}).text == "MPa");
  CHECK(shown_unit("Pa", {1.88e6}).per_si == 1e-6);
  CHECK(shown_unit("N", {-2e-3}).text == "mN");
  CHECK(shown_unit("1/Pa", {5e-7}).text == "1/MPa");
  CHECK(shown_unit("1/Pa", {5e-7}).per_si == 1e6);
  CHECK(shown_unit("s", {1e5}).text == "s");
  CHECK(shown_unit("nN", {5.0}).text == "nN");
  CHECK(shown_unit("Pa", {std::numeric_limits<double>::quiet_NaN()}).text == "Pa");
}

TEST_CASE("specimens of very different moduli are shown each in its own unit", "[io][report]") {
  SpecimenEstimates rubber = one_term(), gel = one_term();
  rubber.label = "rubber";
  rubber.E0_Pa = {1.7e6, {1.6e6, 1.8e6}};
  rubber.E_inf_Pa = {1.0e6, {0.9e6, 1.1e6}};
  gel.label = "gel";
  gel.E0_Pa = {820.0, {590.0, 1050.0}};
  gel.E_inf_Pa = {26.0, {20.0, 32.0}};
  CHECK(have_own_units({rubber, gel}));
  CHECK_FALSE(have_own_units({rubber, rubber}));
  const std::string own = summary_table({rubber, gel}).html("");
  CHECK(own.find(">820</data> <span class=\"unit\">Pa</span>") != std::string::npos);
  CHECK(own.find("</data> <span class=\"unit\">MPa</span>") != std::string::npos);
  CHECK(own.find("(MPa)") == std::string::npos);
  const std::string common = summary_table({rubber, rubber}).html("");
  CHECK(common.find("(MPa)") != std::string::npos);
  CHECK(common.find("</data> <span") == std::string::npos);
}

TEST_CASE("depth is the stage's position below contact minus the frame's deflection",
          "[io][report]") {
  const ReportInput input = test::synthetic_report();
  const CapturedRun& run = *input.specimens[0].run;
  const RunSeries series = series_from_run(run, input.specimens[0].fit->contact_position_m);
  CHECK(series.flagged_s.size() == 1);  // the glitch
  REQUIRE(series.depth_m.size() == series.time_s.size());
  const auto at = [&](double time_s) {
    const std::size_t i = static_cast<std::size_t>(
        std::lower_bound(series.time_s.begin(), series.time_s.end(), time_s) -
        series.time_s.begin());
    return series.depth_m[i];
  };
  // hold: stage .31 mm below contact; force 1.79 N on 10 N/mm. Noise 5e-4 N is 0.05 um.
  const double force_N = (series.volts[4000] - series.volts[100]) / 0.7255;
  CHECK(at(series.time_s[4000]) == Approx(0.31e-3 - force_N / 10e3).margin(0.3e-6));
  CHECK(at(1.0) == Approx(-20e-6).margin(0.3e-6));  // the gap before the ramp
}

TEST_CASE("a cell whose reading falls in compression gives the same depth", "[io][report]") {
  CapturedRun run = *test::synthetic_report().specimens[0].run;
  const std::vector<double> depth_m = series_from_run(run, 1e-3).depth_m;
  for (LoadSample& sample : run.load_samples) {
    if (sample.counts) sample.counts = -*sample.counts;
    if (sample.volts) sample.volts = -*sample.volts;
  }
  run.rig.load_cell.compression_is_positive = false;
  const std::vector<double> turned_m = series_from_run(run, 1e-3).depth_m;
  REQUIRE(turned_m.size() == depth_m.size());
  CHECK(turned_m[4000] == Approx(depth_m[4000]).epsilon(1e-12));
}

TEST_CASE("a move that began later than recorded is shifted to its fitted start", "[io][report]") {
  CapturedRun run = *test::synthetic_report().specimens[0].run;
  const std::vector<double> depth_m = series_from_run(run, 1e-3).depth_m;
  const double unload_s = run.moves[1].move.start_time_s;
  run.moves[1].move.start_time_s -= 0.08;  // as if the command had been written then
  const std::vector<double> recorded_m = series_from_run(run, 1e-3).depth_m;
  const std::vector<double> fitted_m = series_from_run(run, 1e-3, {unload_s}).depth_m;
  double recorded_off_m = 0.0, fitted_off_m = 0.0;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    recorded_off_m = std::max(recorded_off_m, std::abs(recorded_m[i] - depth_m[i]));
    fitted_off_m = std::max(fitted_off_m, std::abs(fitted_m[i] - depth_m[i]));
  }
  CHECK(recorded_off_m > 100e-6);
  CHECK(fitted_off_m == 0.0);
}

TEST_CASE("without moves the depth comes from the stage's reports", "[io][report]") {
  CapturedRun run = *test::synthetic_report().specimens[0].run;
  const RunSeries by_moves = series_from_run(run, 1e-3);
  run.moves.clear();
  const RunSeries by_reports = series_from_run(run, 1e-3);
  REQUIRE(by_reports.depth_m.size() == by_moves.depth_m.size());
  CHECK(by_reports.depth_m[4000] ==
        Approx(by_moves.depth_m[4000]).margin(0.05e-6));  // other readings count as clear: noise
  CHECK(series_from_run(run, std::nullopt).depth_m.empty());
}

TEST_CASE("repeated specimens of a ratio share a colour and one legend entry", "[io][report]") {
  std::vector<SpecimenEstimates> estimates(4, one_term());
  for (std::size_t i = 0; i < 4; ++i) estimates[i].mixing_ratio = i < 3 ? 10.0 : 20.0;
  const std::vector<SpecimenStyle> styles = styles_of(estimates);
  CHECK(styles[0].label == "10 : 1 (3 specimens)");
  CHECK(styles[1].label.empty());
  CHECK(styles[3].label == "20 : 1 (1 specimen)");
  CHECK(styles[0].ink == styles[2].ink);
  CHECK(styles[0].ink != styles[3].ink);
  // Each ratio once: every specimen for itself.
  for (std::size_t i = 0; i < 4; ++i) {
    estimates[i].mixing_ratio = 10.0 + static_cast<double>(i);
    estimates[i].label = "specimen " + std::to_string(i);
  }
  CHECK(styles_of(estimates)[2].label == "specimen 2");
}

TEST_CASE("the spread between specimens is their standard deviation", "[io][report]") {
  std::vector<SpecimenEstimates> estimates(3, one_term());
  for (std::size_t i = 0; i < 3; ++i) {
    estimates[i].mixing_ratio = 10.0;
    estimates[i].E0_Pa.value = 9.0 + static_cast<double>(i);  // 9, 10, 11: mean 10, deviation 1
    estimates[i].sum_g = {0.4, {0.38, 0.42}};
  }
  const std::string html = spread_table(estimates).html("");
  CHECK(html.find("10 %") != std::string::npos);
  CHECK(html.find("5.1 %") != std::string::npos);  // half-width 1 over 1.96, of 10
  for (std::size_t i = 0; i < 3; ++i) estimates[i].mixing_ratio = 10.0 + static_cast<double>(i);
  CHECK(spread_table(estimates).is_empty());
}

TEST_CASE("touches on one specimen count once in the spread between specimens", "[io][report]") {
  std::vector<SpecimenEstimates> estimates(4);
  const char* ids[] = {"a", "a", "b", ""};
  const double E0_Pa[] = {0.9e6, 1.1e6, 1.1e6, 0.9e6};  // the mean of a is 1.0e6
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    estimates[i].specimen_id = ids[i];
    estimates[i].mixing_ratio = 10.0;
    estimates[i].E0_Pa = {E0_Pa[i], {0.99 * E0_Pa[i], 1.01 * E0_Pa[i]}};
    estimates[i].sum_g = {0.02, {0.019, 0.021}};
  }
  const std::string html = spread_table(estimates).html("");
  CHECK(html.find(">3<") != std::string::npos);
  CHECK(html.find(">10 %<") != std::string::npos);  // of 1.0, 1.1 and 0.9
}

TEST_CASE("the three levels of scatter are in one table, with the reason for each unknown value",
          "[io][report]") {
  Scatter scatter{.quantity = "ln_E0"};
  scatter.touch.note = "every specimen was touched once";
  scatter.specimen = {0.05, {0.03, 0.11}, 6, "includes the scatter between touches"};
  scatter.ratio = {0.0, {0.0, 0.2}, 1, ""};
  const std::string html = levels_table({scatter}).html("");
  CHECK(html.find("not identified: every specimen was touched once") != std::string::npos);
  CHECK(html.find("<data value=\"0.05\">") != std::string::npos);
  CHECK(html.find("includes the scatter between touches") != std::string::npos);
  CHECK(levels_table({}).is_empty());
}

TEST_CASE("every profile of a fit becomes a panel, in the parameter's own unit", "[io][report]") {
  FitResult fit;
  CHECK_FALSE(profile_plot(fit));
  fit.E_inf_Pa = 2e6;
  fit.profiles = {{"E_inf", {1.9e6, 2e6, 2.1e6}, {4.0, 0.0, 4.0}, {1.9e6, 2.1e6}},
                  {"ln_tau_1", {0.0, 0.5, 1.0}, {4.0, 0.0, 40.0}, {0.0, 1.0}}};
  const auto plot = profile_plot(fit);
  REQUIRE(plot);
  REQUIRE(plot->panels.size() == 2);
  CHECK(plot->panels[0].x.label == "E∞ (MPa)");
  CHECK(plot->panels[0].series[1].x[1] == Approx(2.0).epsilon(1e-12));
  CHECK(plot->panels[1].x.label == "τ1 (s)");
  CHECK(plot->panels[1].series[1].x.size() == 2);  // far above the picture: left out
  CHECK(plot->panels[1].series[1].x[1] == Approx(std::exp(0.5)).epsilon(1e-12));
}
