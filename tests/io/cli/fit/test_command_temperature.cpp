#include "io/materials/material_file.h"
#include "models/material/temperature_shift.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

// One term of 1 s at 20 C under WLF 8.86, 101.6 K; a millionth of ripple in place of noise.
std::string write_table(const ScratchFolder& folder) {
  const TemperatureShift wlf{.T_ref_C = 20.0, .C1 = 8.86, .C2_K = 101.6};
  std::string file = (folder / "segments.csv").string();
  std::ofstream table(file);
  table.precision(12);
  table << "temperature_C,time_s,modulus_Pa\n";
  for (const double T_C : {0.0, 10.0, 20.0, 30.0, 40.0, 50.0}) {
    for (int i = 0; i < 30; ++i) {
      const double t_s = std::pow(10.0, -1.5 + 3.0 * i / 29.0);
      const double x = t_s / std::exp(ln_shift_factor(wlf, T_C));
      const double ripple = 1e-6 * ((7 * i + static_cast<int>(T_C)) % 11 - 5);
      table << T_C << "," << t_s << ","
            << (1e6 + 8e5 * std::exp(-x) + 6e5 * std::exp(-x / 30.0) + 4e5 * std::exp(-x * 30.0)) *
                   (1.0 + ripple)
            << "\n";
    }
  }
  return file;
}

}  // namespace

TEST_CASE("a table of several temperatures becomes a material with its shift, and a card",
          "[cli][master]") {
  const ScratchFolder folder;
  const std::string table = write_table(folder);
  const std::string material = (folder / "m.json").string();
  const CommandOutcome ran = run_command({"fit", table, "--reference-temperature", "20 degC",
                                          "--out", material, "--density", "965 kg/m3", "--json"});
  INFO(ran.err);
  REQUIRE(ran.status == kDone);
  const auto shift = nlohmann::json::parse(ran.out)["shift"];
  CHECK(shift["better"] == "wlf");
  CHECK(shift["factors"].size() == 6);
  CHECK(shift["form"] == "wlf");
  CHECK(shift["free_factors"].size() == 6);
  CHECK(shift["free_residual_relative"].get<double>() <=
        shift["residual_relative"].get<double>() + 1e-9);
  CHECK(shift["left_out"].empty());
  CHECK(shift["wlf"]["C1"].get<double>() == Approx(8.86).epsilon(2e-3));  // ripple 1e-6 at 6 points
  const Material read = read_material(material).material;
  REQUIRE(read.shift);
  CHECK(read.shift->C2_K == Approx(101.6).epsilon(2e-3));
  CHECK(read.shift->C2_K_95.low < 101.6);
  CHECK(read.T_ref_C == 20.0);
  CHECK(json_from_material(read_material(material)) ==
        json_from_material(material_from_json(json_from_material(read), "again")));
  const CommandOutcome card = run_command({"card", material, "--for", "abaqus", "--accept-flags"});
  CHECK_THAT(card.out, Contains("*TRS, DEFINITION=WLF\n20, 8.8"));
}

TEST_CASE(
    "a reference temperature that was not measured is refused with a list of the measured ones",
    "[cli][master]") {
  const ScratchFolder folder;
  const CommandOutcome ran =
      run_command({"fit", write_table(folder), "--reference-temperature", "25 degC"});
  CHECK(ran.status == kFailed);
  CHECK_THAT(ran.err, Contains("there are 0 C, 10 C, 20 C"));
}

TEST_CASE("the text of a master curve shows the factors taken beside free ones", "[cli][master]") {
  const ScratchFolder folder;
  const std::string table = write_table(folder);
  const CommandOutcome ran = run_command({"fit", table});
  CHECK_THAT(ran.out, Contains("shift factors by the WLF law"));
  CHECK_THAT(ran.out, Contains("   free "));
  const CommandOutcome bad = run_command({"fit", table, "--vertical-shift", "maybe"});
  CHECK(bad.status == kBadWords);
  CHECK_THAT(bad.err, Contains("use auto, on or off"));
}

TEST_CASE("start shifts of the command are stated in its result, as object and as text",
          "[cli][master]") {
  const ScratchFolder folder;
  const std::string table = write_table(folder);
  const CommandOutcome plain =
      run_command({"fit", table, "--reference-temperature", "20 degC", "--json"});
  const CommandOutcome ran =
      run_command({"fit", table, "--reference-temperature", "20 degC", "--start-shift", "0=4",
                   "--start-shift=323.15 K=-3.5", "--json"});
  INFO(ran.err);
  REQUIRE(ran.status == kDone);
  const auto without = nlohmann::json::parse(plain.out)["shift"];
  const auto shift = nlohmann::json::parse(ran.out)["shift"];
  CHECK_FALSE(without.contains("start_shifts"));
  CHECK_FALSE(without.contains("started_from"));
  REQUIRE(shift["start_shifts"].size() == 2);
  CHECK(shift["start_shifts"][0]["temperature_C"] == 0.0);
  CHECK(shift["start_shifts"][0]["log10_a"] == 4.0);
  CHECK(shift["start_shifts"][1]["temperature_C"].get<double>() == Approx(50.0).margin(1e-9));
  CHECK(shift["started_from"] == "rows");  // these are decades off
  CHECK(shift["wlf"]["C1"].get<double>() ==
        Approx(without["wlf"]["C1"].get<double>()).epsilon(1e-9));
  const CommandOutcome text = run_command({"fit", table, "--start-shift", "0=5"});
  CHECK_THAT(text.out, Contains("the shifts that were given scatter clearly more"));
}

TEST_CASE("start shifts that cannot be meant are refused with how to write them", "[cli][master]") {
  const ScratchFolder folder;
  const std::string table = write_table(folder);
  struct Bad {
    std::vector<std::string> shifts;
    int status;
    const char* message;
  };
  for (const Bad& bad : std::vector<Bad>{
           {{"40"}, kBadWords, "--start-shift 40: write TEMPERATURE=DECADES"},
           {{"40=fast"}, kBadWords, "such as 40=-1.2 or \"313 K=-1.2\""},
           {{"=1"}, kBadWords, "write TEMPERATURE=DECADES"},
           {{"40=nan"}, kBadWords, "write TEMPERATURE=DECADES"},
           {{"40=-1000"}, kBadWords, "lies between -40 and 40 decades"},
           {{"40 m=1"}, kBadWords, "--start-shift 40 m=1: "},
           {{"45=1"}, kFailed, "no isotherm was measured at 45 C; there are 0 C, 10 C"},
           {{"40=1", "40=1"}, kFailed, "the isotherm at 40 C has a start value already, 1"},
           {{"20=1"}, kFailed, "20 C is the reference temperature, whose shift is 0"}}) {
    std::vector<std::string> words{"fit", table, "--reference-temperature", "20 degC"};
    for (const std::string& shift : bad.shifts) words.push_back("--start-shift=" + shift);
    const CommandOutcome ran = run_command(words);
    CAPTURE(bad.shifts.front(), ran.err);
    CHECK(ran.status == bad.status);
    CHECK_THAT(ran.err, Contains(bad.message));
  }
}

TEST_CASE("start shifts without a master curve are refused by name", "[cli][master]") {
  const std::string plain = VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv";
  const CommandOutcome one = run_command({"fit", plain, "--start-shift", "40=1"});
  CHECK(one.status == kFailed);
  CHECK_THAT(one.err, Contains("--start-shift is for tables of modulus_Pa"));
  const CommandOutcome tests =
      run_command({"fit", "relaxation=" + plain, "creep=" + plain, "--start-shift", "40=1"});
  CHECK(tests.status == kBadWords);
  CHECK_THAT(tests.err, Contains("--start-shift is for single tests"));
}

TEST_CASE("a table of several temperatures is shown with its isotherms, as they were measured",
          "[cli][master]") {
  const ScratchFolder folder;
  const std::string table = write_table(folder);
  const auto shown = run_command({"fit", table, "--show-table", "--json"});
  INFO(shown.err);
  REQUIRE(shown.status == kDone);
  const auto isotherms = nlohmann::json::parse(shown.out)["isotherms"];
  REQUIRE(isotherms.size() == 6);
  CHECK(isotherms[2]["temperature_C"].get<double>() == Approx(20.0).margin(1e-9));
  CHECK(isotherms[2]["argument"].size() == 30);
  CHECK(isotherms[2]["argument"][0].get<double>() == Approx(std::pow(10.0, -1.5)).epsilon(1e-9));
  CHECK(isotherms[2]["modulus_Pa"].size() == 30);
  CHECK(isotherms[2]["loss_modulus_Pa"].empty());
  CHECK_THAT(run_command({"fit", table, "--show-table"}).out,
             Contains("isotherms: 0 C, 10 C, 20 C, 30 C, 40 C, 50 C"));
  const std::string plain = VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv";
  const auto of_one = run_command({"fit", plain, "--show-table", "--json"});
  CHECK(nlohmann::json::parse(of_one.out)["isotherms"].empty());
}
