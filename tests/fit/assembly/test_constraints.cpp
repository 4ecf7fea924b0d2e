#include "fit/assembly/constraints.h"
#include "fit/fit_relaxation.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

// 1.6 + 0.12 exp(-t/0.8) + 0.08 exp(-t/40), noise 0.002.
RelaxationData two_terms() {
  std::mt19937_64 dice(9);
  std::normal_distribution<double> normal;
  RelaxationData data;
  for (int i = 0; i < 1500; ++i) {
    const double t_s = 0.02 * std::pow(10.0, 4.5 * i / 1499.0);
    data.time_s.push_back(t_s);
    data.value.push_back(1.6 + 0.12 * std::exp(-t_s / 0.8) + 0.08 * std::exp(-t_s / 40.0) +
                         0.002 * normal(dice));
  }
  return data;
}

FitResult fit_with(const std::vector<std::string>& texts) {
  FitOptions options{.n_terms = 2};
  for (const std::string& text : texts) options.constraints.push_back(constraint_from_text(text));
  return fit_relaxation(two_terms(), options);
}

}  // namespace

TEST_CASE("a fixed time keeps its value without error, and the other parameters are fitted",
          "[fit]") {
  const FitResult free = fit_with({});
  const FitResult fit = fit_with({"tau_1=0.81"});
  CHECK(fit.terms[0].tau_s == Approx(0.81).epsilon(1e-12));
  CHECK(fit.terms[0].ln_tau_se == 0.0);
  CHECK(fit.terms[1].tau_s != free.terms[1].tau_s);
  CHECK(fit.rss > free.rss);
  CHECK(fit.rss < 1.05 * free.rss);
  // A known time reduces the error of its modulus.
  CHECK(fit.terms[0].modulus_se_Pa < free.terms[0].modulus_se_Pa);
  REQUIRE_FALSE(fit.flags.empty());
  CHECK(fit.flags.front().name == "constrained");
}

TEST_CASE("a constraint that the free fit satisfies changes nothing", "[fit]") {
  const FitResult free = fit_with({});
  const FitResult fit = fit_with({"g_2=0:0.5", "tau_2=1:1000"});
  CHECK(fit.E0_Pa == Approx(free.E0_Pa).epsilon(1e-7));  // both at the optimum
  CHECK(fit.terms[0].tau_s == Approx(free.terms[0].tau_s).epsilon(1e-6));
  CHECK(fit.terms[1].g == Approx(free.terms[1].g).epsilon(1e-6));
}

TEST_CASE("shares, moduli and ends can be fixed or bounded", "[fit]") {
  CHECK(fit_with({"g_2=0.03"}).terms[1].g == Approx(0.03).epsilon(1e-10));
  CHECK(fit_with({"g_2=0:0.03"}).terms[1].g == Approx(0.03).epsilon(1e-6));  // ends on its bound
  CHECK(fit_with({"E0=1.81"}).E0_Pa == Approx(1.81).epsilon(1e-10));
  const FitResult fit = fit_with({"E_inf=1.59", "E_1=0.1:0.11"});
  CHECK(fit.E_inf_Pa == Approx(1.59).epsilon(1e-12));
  CHECK(fit.terms[0].modulus_Pa <= 0.11 * (1.0 + 1e-9));
  CHECK(fit.terms[0].modulus_Pa >= 0.1 * (1.0 - 1e-9));
}

TEST_CASE("invalid constraints are refused by name", "[fit]") {
  const auto text_of = [](const std::vector<std::string>& texts) {
    return error_text([&] { fit_with(texts); });
  };
  CHECK_THAT(text_of({"tau=1"}), Contains("'tau' is not a parameter"));
  CHECK_THAT(text_of({"tau_3=1"}), Contains("tau_3 belongs to a term that does not exist"));
  CHECK_THAT(text_of({"tau_1=2:1"}), Contains("must ascend"));
  CHECK_THAT(text_of({"tau_1=fast"}), Contains("'fast' is not a number"));
  CHECK_THAT(text_of({"g_1=.1", "E_inf=1"}), Contains("not both"));
  CHECK_THAT(text_of({"tau_1=1", "tau_1=2"}), Contains("tau_1 is constrained twice"));
  CHECK_THAT(text_of({"E0=0"}), Contains("E0 must be positive"));
  CHECK_THAT(text_of({"E0=-2:-1"}), Contains("E0 must be positive"));
  CHECK_THAT(text_of({"E_inf=-1"}), Contains("not be negative"));
  CHECK_THAT(text_of({"g_1=0.6", "g_2=0.5"}), Contains("sum to 1 or more"));
  CHECK_THAT(text_of({"g_1=1.5:2"}), Contains("below 1"));
  CHECK_THAT(text_of({"tau_1=1e-9"}), Contains("outside the times that the record can show"));
  CHECK_THAT(text_of({"tau_1=300"}), Contains("numbered by ascending time"));
}

TEST_CASE("constraints that the data contradict make the result untrustworthy", "[fit]") {
  const auto flag_of = [](const FitResult& fit, const std::string& name) {
    return std::any_of(fit.flags.begin(), fit.flags.end(),
                       [&](const MaterialFlag& flag) { return flag.name == name; });
  };
  for (const char* text : {"E0=0.9", "E0=3", "E_inf=0.5", "g_1=0.5", "E_2=1"}) {
    CAPTURE(text);
    const FitResult fit = fit_with({text});
    CHECK_FALSE(fit.is_trustworthy);
    CHECK(flag_of(fit, "contradicts-data"));
    CHECK(std::isfinite(fit.E0_Pa));
    CHECK(fit.E_inf_Pa >= 0.0);
    CHECK(fit.sum_g <= 1.0);
  }
  const FitResult near = fit_with({"E0=1.8"});  // the true value
  CHECK(near.is_trustworthy);
  CHECK_FALSE(flag_of(near, "contradicts-data"));
  CHECK_FALSE(flag_of(near, "constraints-strained"));
  // Seven standard errors off, but hardly visible in the residual.
  const FitResult beside = fit_with({"tau_1=0.9"});
  CHECK(beside.is_trustworthy);
  CHECK(flag_of(beside, "constraints-strained"));
}

TEST_CASE("terms that the data do not support leave E0 finite, or flag it as unknown", "[fit]") {
  const int n_terms = GENERATE(3, 4, 6, 100);
  const FitResult fit = fit_relaxation(two_terms(), {.n_terms = n_terms});
  CAPTURE(n_terms, fit.E0_Pa, fit.E0_se_Pa, fit.terms.size());
  CHECK((fit.E0_Pa == Approx(1.8).epsilon(0.2) || !fit.is_trustworthy));
  CHECK(fit.E0_Pa < 180.0);
  const bool is_said =
      std::any_of(fit.flags.begin(), fit.flags.end(),
                  [](const MaterialFlag& flag) { return flag.name == "fewer-terms"; });
  CHECK(is_said == (static_cast<int>(fit.terms.size()) < n_terms));
}

TEST_CASE("constraints come from the command line or a file", "[cli]") {
  const ScratchFolder folder;
  const std::string table = (folder / "t.csv").string();
  const RelaxationData data = two_terms();
  std::ofstream out(table);
  out << "time_s,modulus_Pa\n";
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    out << data.time_s[i] << "," << data.value[i] << "\n";
  }
  out.close();
  const std::string file = (folder / "c.txt").string();
  std::ofstream(file) << "# from the data sheet\ntau_1 = 0.82\n\ng_2 = 0:0.05\n";
  const CommandOutcome ran = run_command(
      {"fit", table, "--terms", "2", "--constraints", file, "--plausible", "off", "--json"});
  INFO(ran.err);
  REQUIRE(ran.status == kDone);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json["terms"][0]["tau_s"].get<double>() == Approx(0.82).epsilon(1e-10));
  CHECK(json["terms"][1]["g"].get<double>() <= 0.05 * (1.0 + 1e-9));
  const CommandOutcome words =
      run_command({"fit", table, "--terms", "2", "--fix", "tau_1=0.82", "--bound", "g_2=0:0.05",
                   "--plausible", "off", "--json"});
  auto of_words = nlohmann::json::parse(words.out), of_file = json;
  of_words.erase("input_files");  // the file of constraints is one of them
  of_file.erase("input_files");
  CHECK(of_words == of_file);
  CHECK(run_command({"fit", table, "--fix", "tau_1=0.9"}).status == kBadWords);
  CHECK(run_command({"fit", table, "--terms", "2", "--fix", "tau_1"}).status == kBadWords);
  const CommandOutcome below =
      run_command({"fit", table, "--terms", "2", "--fix", "E0=0.9", "--plausible", "off"});
  CHECK(below.status == kFailed);
  CHECK_THAT(below.err, Contains("contradict the data"));
  CHECK(run_command({"fit", table, "--terms", "2", "--fix", "E0=-1"}).status == kBadWords);
}
