#include "io/basics/atomic_file.h"
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

TEST_CASE("a wrong command line gives one line and exit status 2", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"fit"}, "no file given; usage: viscard fit"},
      {{"fit", file, "--term", "3"}, "did you mean '--terms'"},
      {{"fit", file, "--terms", "-1"}, "outside 0 to 100"},
      {{"fit", file, "--terms", "two"}, "two"},
      {{"fit", file, "--kind", "relaxtion"}, "did you mean 'relaxation'"},
      {{"fit", file, "--noise", "pink"}, "auto or white"},
      {{"fit", file, "--punch-diameter", "4.4 kg"}, "--punch-diameter"},
      {{"fit", file, "--layer-thickness", "1 mm"}, "needs --punch-diameter"},
      {{"fit", file, "--column", "modulus=2"}, "modulus"},
      {{"fit", file, "--bootstrap", "5"}, "outside 20 to 100000"},
      {{"fit", file, "--model", "kww", "--fix", "E0=1.8e6"}, "--model fits a law without terms"},
      {{"fit", file, "--model", "kww", "--bootstrap", "50"}, "--bootstrap is for the terms"},
      {{"fit", file, "relaxation=" + file, "--terms", "1"}, "states no kind of test"},
      {{"fit", file, "--liquid", "--terms", "0"}, "at least one term"},
      {{"fit", file, file, "--out", folder.file("m.json")}, "one input file"}};
  for (const auto& [words, expected] : cases) {
    const CommandOutcome ran = run_command(words);
    CAPTURE(ran.err);
    CHECK(ran.status == kBadWords);
    CHECK(ran.out == "");
    CHECK_THAT(ran.err, Contains(expected));
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
  }
}

TEST_CASE("data that cannot be fitted give one line with the file and exit status 1", "[cli]") {
  const TableFolder folder;
  const std::vector<std::pair<std::string, std::string>> cases{
      {folder.file("missing.csv"), "missing.csv"},
      {folder.write("two.csv", "time_s,modulus_Pa\n0,1e6\n1,9e5\n"), "at least 4"},
      {folder.write("text.csv", "time_s,modulus_Pa\n0,1\n1,abc\n2,1\n3,1\n4,1\n"), "abc"},
      {folder.write("other.csv", "a,b\n0,1\n1,2\n2,3\n3,4\n"), "--column"}};
  for (const auto& [file, expected] : cases) {
    const CommandOutcome ran = run_command({"fit", file});
    CAPTURE(ran.err);
    CHECK(ran.status == kFailed);
    CHECK(ran.out == "");
    CHECK_THAT(ran.err, Contains(expected) && Contains(file));
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
  }
}

namespace {

// Ramp of 1 s and hold, 2e4 N/m, a trace of the last digits in place of noise.
std::string pressed_table(const std::function<double(double, double)>& force_of,
                          const std::function<bool(double)>& is_kept) {
  std::ostringstream text;
  text.precision(12);
  text << "time_s,force_N,depth_m\n";
  for (int i = 0; i <= 800; ++i) {
    const double t = 0.02 * i;
    if (!is_kept(t)) continue;
    const double depth = 1e-4 * std::min(1.0, t);
    const double force = 2.0e4 * depth * (0.9 + 0.1 * std::exp(-t / 2.0) + 1e-5 * ((7 * i) % 11));
    text << t << "," << force_of(t, force) << "," << depth << "\n";
  }
  return text.str();
}

}  // namespace

TEST_CASE("bad data get a clear refusal or a flagged answer", "[cli]") {
  const TableFolder folder;
  const auto all = [](double) { return true; };
  const auto as_is = [](double, double force) { return force; };
  SECTION("refusals") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"time_s,modulus_Pa\n0,nan\n1,nan\n2,nan\n3,nan\n4,nan\n", "no row has a number"},
        {pressed_table([](double, double) { return 0.5; }, all), "constant"},
        {pressed_table([](double, double force) { return -force; }, all), "--column force_N=-NAME"},
        {"time_s,force_N,depth_m\n0,0,0\n1,1,1e-4\n", "at least"}};
    for (const auto& [table, expected] : cases) {
      const CommandOutcome ran = run_command({"fit", folder.write("bad.csv", table)});
      CAPTURE(ran.err);
      CHECK(ran.status == kFailed);
      CHECK(ran.out == "");
      CHECK_THAT(ran.err, Contains(expected));
      CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
    }
  }
  SECTION("flagged") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {pressed_table(as_is, [](double t) { return t < 0.3 || t > 0.7; }), "gap-in-ramp"},
        {pressed_table([](double, double force) { return std::min(force, 1.85); }, all),
         "saturated"}};
    for (const auto& [table, flag] : cases) {
      const CommandOutcome ran = run_command({"fit", folder.write("bad.csv", table), "--json"});
      CHECK(ran.status == kFailed);
      CHECK_THAT(ran.err, Contains("not to be trusted"));
      const auto json = nlohmann::json::parse(ran.out);
      CHECK_FALSE(json["trustworthy"].get<bool>());
      CHECK_THAT(json["flags"].dump(), Contains(flag));
    }
  }
}

TEST_CASE("a series that misses its law by more than 5 % is a defect, and gets no card", "[cli]") {
  const TableFolder folder;
  std::ostringstream table;
  table << "omega [rad/s],storage_modulus_Pa,loss_modulus_Pa\n";
  for (int i = 0; i < 60; ++i) {  // the flow of one Maxwell element, with 2 % of noise
    const double omega = std::pow(10.0, -3.0 + 4.0 * i / 59.0), x = 0.05 * omega;
    const double E_Pa = 1e5 * x / (1.0 + x * x);
    table << omega << "," << E_Pa * x * (1.0 + 0.02 * std::sin(7.0 * i)) << ","
          << E_Pa * (1.0 + 0.02 * std::sin(11.0 * i)) << "\n";
  }
  const CommandOutcome ran =
      run_command({"fit", folder.write("newton.csv", table.str()), "--model", "kww", "--json"});
  CHECK(ran.status == kFailed);
  CHECK_THAT(ran.err, Contains("not to be trusted") && Contains("misses the law kww"));
  auto json = nlohmann::json::parse(ran.out);
  CHECK_FALSE(json["trustworthy"].get<bool>());
  CHECK_THAT(json["flags"].dump(), Contains("law-not-a-series") && Contains("\"liquid\""));
  CHECK_FALSE(json.contains("bic_liquid_minus_solid"));
  // A card of a material with this flag is refused.
  const std::string good = folder.write("E.csv", relaxation_table());
  REQUIRE(run_command({"fit", good, "--out", folder.file("m.json")}).status == kDone);
  auto material = nlohmann::json::parse(read_file(folder.file("m.json")));
  material["flags"] = {{{"name", "law-not-a-series"}, {"text", "it misses the law"}}};
  const CommandOutcome card =
      run_command({"card", folder.write("bad.json", material.dump()), "--for", "csv"});
  CHECK(card.status == kFailed);
  CHECK_THAT(card.err, Contains("not to be trusted (law-not-a-series"));
}

TEST_CASE("a file with the suffix of a capture that is not one is not read as a table", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("run.viscap", "SQLxte format 3\n0.1,0.2\n0.3,0.4\n");
  const CommandOutcome ran = run_command({"fit", file});
  CHECK(ran.status == kFailed);
  CHECK_THAT(ran.err, Contains(file) && Contains("not a capture") && !Contains("column"));
}

TEST_CASE("no unit is proposed for a number whose sign cannot be right", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--density", "-1"}, "--density is -1 kg/m3; it must be positive"},
      {{"--punch-diameter", "-1"}, "--punch-diameter is -1 m; it must be positive"},
      {{"--punch-diameter", "-1 mm"}, "--punch-diameter is -1 mm; it must be positive"},
      {{"--punch-diameter", "-1 mm", "--plausible", "off"},
       "--punch-diameter is -1 mm; it must be positive"},
      {{"--layer-thickness", "-2"}, "--layer-thickness is -2 m; it must be positive"},
      {{"--depth", "-1"}, "--depth is -1 m; it must not be negative"},
      {{"--youngs-modulus", "-1"}, "--youngs-modulus is -1 Pa; it must be positive"}};
  for (const auto& [words, text] : cases) {
    std::vector<std::string> line{"fit", file};
    line.insert(line.end(), words.begin(), words.end());
    const CommandOutcome ran = run_command(line);
    CAPTURE(line, ran.err);
    CHECK(ran.status == kBadWords);
    CHECK_THAT(ran.err, Contains(text) && !Contains("was meant") && !Contains("--plausible off"));
  }
}

TEST_CASE("a column of the other sign and of another unit is flipped by what is proposed",
          "[cli]") {
  const TableFolder folder;
  const std::string file =
      folder.write("E.csv", "time_s,modulus_Pa\n0.1,-2\n1,-1.5\n10,-1.2\n100,-1.1\n1000,-1.05\n");
  CHECK_THAT(run_command({"fit", file}).err,
             Contains("its largest value is -2 Pa; it must be positive. If the instrument has the "
                      "other sign, write --column 'modulus_Pa=-1e6*modulus_Pa'"));
  CHECK(run_command({"fit", file, "--column", "modulus_Pa=-1e6*modulus_Pa"}).status != kBadWords);
}

TEST_CASE("an impossible density or mixing ratio is refused before the fit", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--density", "-5 kg/m3"}, {"--ratio", "0"}, {"--ratio", "-10"}}) {
    std::vector<std::string> line{"fit", file, "--out", folder.file("m.json")};
    line.insert(line.end(), words.begin(), words.end());
    const CommandOutcome ran = run_command(line);
    CAPTURE(words, ran.err);
    CHECK(ran.status == kBadWords);
    CHECK_THAT(ran.err, Contains(words[0]) && Contains("must be positive"));
    CHECK(ran.out.empty());
    CHECK_FALSE(std::filesystem::exists(folder.file("m.json")));
  }
}

TEST_CASE("a stress without its strain is no modulus, and an extension needs the gauge length",
          "[cli]") {
  const TableFolder folder;
  std::ostringstream alone, extended;
  alone << "time_s,stress_kPa\n";
  extended << "time_s,stress_kPa,displacement_mm\n";
  for (int i = 1; i <= 100; ++i) {
    const double t = 0.5 * i, stress_kPa = 10.0 + 5.0 * std::exp(-t / 5.0);
    alone << t << "," << stress_kPa << "\n";
    extended << t << "," << stress_kPa << ",0.2\n";
  }
  const CommandOutcome refused = run_command({"fit", folder.write("alone.csv", alone.str())});
  CHECK(refused.status == 1);
  CHECK_THAT(refused.err,
             Contains("'stress_kPa' is a stress, and without its strain it is no modulus"));
  const std::string with_extension = folder.write("extended.csv", extended.str());
  CHECK_THAT(run_command({"fit", with_extension}).err, Contains("--gauge-length"));
  const CommandOutcome ran =
      run_command({"fit", with_extension, "--gauge-length", "20 mm", "--json"});
  REQUIRE(ran.status == 0);
  CHECK(nlohmann::json::parse(ran.out)["E0_Pa"].get<double>() == Approx(1.5e6).epsilon(1e-3));
}

TEST_CASE("a relaxation of a table of compliances is refused by what the table has", "[cli]") {
  const TableFolder folder;
  std::ostringstream creep;
  creep << "t (s),J (1/MPa)\n";
  for (int i = 1; i <= 60; ++i) creep << i << "," << 0.5 + 0.1 * (1.0 - std::exp(-i / 9.0)) << "\n";
  const auto ran =
      run_command({"fit", folder.write("creep.csv", creep.str()), "--kind", "relaxation"});
  CHECK(ran.status == 1);
  CHECK_THAT(ran.err, Contains("--kind creep") && !Contains("''"));
}

TEST_CASE("a unit that is none is named with the one that was meant", "[cli]") {
  const TableFolder folder;
  for (const char* const header : {"E (Mpa)", "modulus (mpa)"}) {
    std::ostringstream table;
    table << "t (s)," << header << "\n";
    for (int i = 1; i <= 60; ++i) table << i << "," << 1.6 + 0.2 * std::exp(-i / 9.0) << "\n";
    const std::string file = folder.write("E.csv", table.str());
    const auto ran = run_command({"fit", file});
    CAPTURE(header, ran.err);
    CHECK(ran.status == 1);
    CHECK_THAT(ran.err, Contains("is not a known unit") && Contains("If MPa was meant") &&
                            Contains("modulus_Pa=") && !Contains("compliance"));
    const std::string proposed = std::string("modulus_Pa=1e+06*") + header;
    CHECK_THAT(ran.err, Contains(proposed));
    const auto meant = run_command({"fit", file, "--column", proposed, "--json"});
    REQUIRE(meant.status == 0);
    CHECK(nlohmann::json::parse(meant.out)["E0_Pa"].get<double>() == Approx(1.8e6).epsilon(0.02));
  }
}

TEST_CASE("files of other kinds are refused by what they are", "[cli]") {
  const TableFolder folder;
  const std::string page =
      folder.write("rep.html", "<!DOCTYPE html>\n<html><p>1,5 and 2.5</p></html>\n");
  CHECK_THAT(run_command({"fit", page}).err, Contains("is an HTML page, not a table"));
  const std::string table = folder.write("E.csv", relaxation_table());
  CHECK_THAT(run_command({"card", "--check", table}).err,
             Contains("is a table of numbers, not a material card"));
  const std::string material = VISCARD_SOURCE_DIR "/data/materials/pdms_1to10_seed.json";
  CHECK_THAT(
      run_command({"report", material, "relaxation=" + table, "--out", folder.file("r.html")}).err,
      Contains("is a material, not a test") && !Contains("creep="));
}

TEST_CASE("the option --unverified beside a table that no capture was exported to is refused",
          "[cli]") {
  const TableFolder folder;
  const auto ran = run_command({"fit", folder.write("E.csv", relaxation_table()), "--unverified"});
  CHECK(ran.status != 0);
  CHECK_THAT(ran.err, Contains("--unverified is for captures"));
}

TEST_CASE("the row of the order that was fitted shows the constrained fit", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  const auto ran =
      run_command({"fit", file, "--terms", "2", "--fix", "tau_1=1", "--fix", "tau_2=30", "--json"});
  const auto json = nlohmann::json::parse(ran.out);
  for (const auto& row : json["orders"]) {
    if (!row["chosen"].get<bool>()) continue;
    CHECK(row["n_terms"] == 2);
    CHECK(row["rss"].get<double>() == Approx(json["rss"].get<double>()).epsilon(1e-9));
  }
}

TEST_CASE("a sweep of the strain amplitude is refused with its linear range", "[cli]") {
  const TableFolder folder;
  // G' = 10 kPa/(1 + (gamma/30 %)^1.5) is 5 % low at 4.2 %.
  const auto sweep = [](bool has_frequency, double from_percent, double to_percent) {
    std::ostringstream text;
    text << "Strain [%],Storage modulus G' [Pa],Loss modulus G'' [Pa]"
         << (has_frequency ? ",Frequency [Hz]" : "") << "\n";
    for (double strain = from_percent; strain <= to_percent; strain *= 1.2) {
      const double storage_Pa = 1e4 / (1.0 + std::pow(strain / 30.0, 1.5));
      text << strain << "," << storage_Pa << "," << 0.1 * storage_Pa << (has_frequency ? ",1" : "")
           << "\n";
    }
    return text.str();
  };
  for (const bool has_frequency : {false, true}) {
    const std::string file = folder.write("amplitude.csv", sweep(has_frequency, 0.01, 120.0));
    for (const auto& words :
         std::vector<std::vector<std::string>>{{"fit", file}, {"fit", file, "--kind", "dma"}}) {
      const CommandOutcome ran = run_command(words);
      CAPTURE(ran.err);
      CHECK(ran.status == kFailed);
      CHECK_THAT(ran.err,
                 Contains("a sweep of the strain amplitude at one frequency, from 0.01 to"));
      const std::size_t at = ran.err.find("linear up to a strain of ");
      REQUIRE(at != std::string::npos);
      const double end_percent = std::stod(ran.err.substr(at + 25));
      CHECK(end_percent > 4.2 / 1.2);
      CHECK(end_percent < 4.2 * 1.01);
    }
  }
  const CommandOutcome flat =
      run_command({"fit", folder.write("flat.csv", sweep(true, 0.01, 1.0))});
  CHECK_THAT(flat.err, Contains("linear up to the largest strain"));
}
