// A liquid (E_inf = 0) from its data to a file, a prediction, and refusals of what needs a solid.
#include "io/materials/material_file.h"
#include "models/material/liquid.h"
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

// A melt of two modes, 30 kPa over 0.5 s and 10 kPa over 20 s: its viscosity is 215 kPa s.
std::string melt_table(double to_s = 200.0) {
  std::ostringstream text;
  text.precision(12);
  text << "time_s,modulus_Pa\n";
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i <= 300; ++i) {
    const double t = 0.01 * std::pow(to_s / 0.01, i / 300.0);
    text << t << "," << 3e4 * std::exp(-t / 0.5) + 1e4 * std::exp(-t / 20.0) + 20.0 * normal(random)
         << "\n";
  }
  return text.str();
}

}  // namespace

TEST_CASE("a fitted liquid is saved, read and predicted; a card or scene refuses it", "[cli]") {
  const TableFolder folder;
  const std::string table = folder.write("melt.csv", melt_table());
  const std::string out = folder.file("melt.json");
  const CommandOutcome fitted = run_command({"fit", table, "--out", out});
  CAPTURE(fitted.out, fitted.err);
  REQUIRE(fitted.status == kDone);
  const Material material = read_material(out).material;
  CHECK(is_liquid(material));
  CHECK(derived_moduli(material).E_inf_Pa == 0.0);

  const CommandOutcome predicted = run_command({"predict", out, "--test", "creep", "--json"});
  CAPTURE(predicted.err);
  CHECK(predicted.status == kDone);
  const CommandOutcome against = run_command({"predict", out, "--against", table, "--json"});
  CAPTURE(against.err);
  REQUIRE(against.status == kDone);
  const auto quantity = nlohmann::json::parse(against.out)["against"]["quantities"][0];
  CHECK(quantity["rms"].get<double>() == Approx(20.0).epsilon(0.2));

  const std::vector<std::vector<std::string>> refusals{
      {"card", out, "--for", "ansys"}, {"card", out, "--for", "abaqus"}, {"validate", out}};
  for (const auto& words : refusals) {
    const CommandOutcome refused = run_command(words);
    CAPTURE(words.front(), refused.out, refused.err);
    CHECK(refused.status == kFailed);
    CHECK_THAT(refused.err, Contains("melt.json: E_inf = 0: this is a liquid") &&
                                Contains("--solid") && Contains("viscard predict"));
    CHECK(std::count(refused.err.begin(), refused.err.end(), '\n') == 1);
  }
}

TEST_CASE("the fit of a liquid prints its viscosity with the interval", "[cli]") {
  const TableFolder folder;
  const std::string table = folder.write("melt.csv", melt_table());
  const CommandOutcome text = run_command({"fit", table});
  CHECK_THAT(text.out, Contains("  eta_0  ") && Contains(" Pa s  95 % "));
  const auto json = nlohmann::json::parse(run_command({"fit", table, "--json"}).out);
  CAPTURE(json.dump());
  CHECK(json["viscosity_Pa_s"].get<double>() == Approx(215e3).epsilon(0.02));
  const auto& ends = json["viscosity_interval_95"];
  CHECK(ends.front().get<double>() < 215e3);
  CHECK(ends.back().get<double>() > 215e3);
  CHECK(ends.back().get<double>() - ends.front().get<double>() < 0.1 * 215e3);

  const std::string solid = folder.write("solid.csv", relaxation_table());
  CHECK_FALSE(run_command({"fit", solid, "--json"}).out.find("viscosity") != std::string::npos);
}

TEST_CASE("no flag of a liquid speaks of its equilibrium modulus", "[cli]") {
  const TableFolder folder;
  const std::string table = folder.write("short.csv", melt_table(40.0));
  const CommandOutcome liquid = run_command({"fit", table, "--liquid"});
  CHECK_THAT(liquid.out, Contains("the slowest time is known roughly only"));
  CHECK_THAT(liquid.out, !Contains("the equilibrium modulus is an upper bound"));
  const CommandOutcome solid = run_command({"fit", table, "--solid"});
  CHECK_THAT(solid.out, Contains("the equilibrium modulus is an upper bound only"));
}
