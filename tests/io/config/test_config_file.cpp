#include "io/basics/atomic_file.h"
#include "io/config/config_file.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <functional>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

const std::filesystem::path kDemo = std::filesystem::path(VISCARD_SOURCE_DIR) / "data" / "demo";

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

std::string rig_error(const std::string& text) {
  return error_of([&] { rig_from_toml(text, "rig.toml"); });
}

const char* const kMinimalRig =
    "[calibration]\nvolts_per_newton = \"0.7255 V/N\"\ncapacity = \"250 gf\"\n"
    "[frame]\nstiffness = \"rigid\"\n";

TEST_CASE("the demo's rig reads as its comments say", "[io][config]") {
  const RigConfig rig = read_rig(kDemo / "01_rig.toml");
  CHECK(rig.stage.driver == "grbl");
  CHECK(rig.stage.toward_specimen == -1);
  CHECK(rig.stage.travel_m == 10e-3);
  CHECK(rig.load_cell.volts_per_count == 20.0 / 16777216.0);
  CHECK(rig.calibration.volts_per_newton == 0.7255);
  CHECK(rig.calibration.capacity_N == Approx(0.25 * 9.80665).epsilon(1e-15));
  CHECK(rig.calibration.date == "2024-01-15");
  CHECK(rig.frame.stiffness_N_m == 10e3);
  CHECK(rig.frame.stiffness_relative_u == 0.02);
  CHECK(rig.safety.soft_fraction == 0.8);
}

TEST_CASE("a rig file without depth_relative_u gets that of an ordinary screw, a capture none",
          "[io][config]") {
  const std::string minimal = std::string("[stage]\nport = \"a\"\n") + kMinimalRig;
  const std::string stated = "[stage]\ndepth_relative_u = 0\n" + std::string(kMinimalRig);
  const auto in_file = [](const std::string& text) {
    return rig_of_text(text, "rig.toml", Plausible::kMeasured).stage.depth_relative_u;
  };
  CHECK(in_file(minimal) == kScrewDepth_u);
  CHECK(in_file(stated) == 0.0);
  CHECK(rig_from_toml(minimal, "captured").stage.depth_relative_u == 0.0);
}

TEST_CASE("a thermometer and a converter are read, stored and checked", "[io][config]") {
  const std::string thermometer =
      "[thermometer]\ndriver = \"scpi\"\nquery = \"READ?\"\nperiod = \"2 s\"\n"
      "drift_limit = \"0.5 K\"\n";
  const RigConfig rig = rig_from_toml(std::string(kMinimalRig) + thermometer, "rig.toml");
  CHECK(rig.thermometer.driver == "scpi");
  CHECK(rig.thermometer.query == "READ?");
  CHECK(rig.thermometer.period_s == 2.0);
  CHECK(rig.thermometer.drift_limit_K == 0.5);
  CHECK(rig_from_toml(toml_from_rig(rig), "rig.toml").thermometer.query == "READ?");
  CHECK(rig_from_toml(kMinimalRig, "rig.toml").thermometer.driver == "none");
  const std::string converter =
      "[load_cell]\ndriver = \"adc\"\nconverter = \"ads1232\"\ngain = 128\n"
      "reference = \"5 V\"\n";
  const RigConfig board = rig_from_toml(std::string(kMinimalRig) + converter, "rig.toml");
  CHECK(board.load_cell.volts_per_count == Approx(2.5 / 128.0 / 8388607.0).epsilon(1e-14));
  CHECK(rig_from_toml(toml_from_rig(board), "rig.toml").load_cell.volts_per_count ==
        board.load_cell.volts_per_count);
  CHECK_THAT(rig_error(std::string(kMinimalRig) + converter + "volts_per_count = \"1 uV\"\n"),
             Contains("Omit volts_per_count"));
  CHECK_THAT(rig_error(std::string(kMinimalRig) +
                       ("[load_cell]\ndriver = \"adc\"\n"
                        "converter = \"ads1232\"\ngain = 3\nreference = \"5 V\"\n")),
             Contains("load_cell.gain is 3"));
}

TEST_CASE("the demo's test and specimens read as their comments say", "[io][config]") {
  const TestPlan plan = read_test(kDemo / "02_test.toml");
  CHECK(plan.depth_m == 0.13e-3);
  CHECK(plan.ramp_s == 1.0);
  CHECK(plan.hold_s == 60.0);
  CHECK(plan.recovery_s == 20.0);
  CHECK(plan.unload_speed_m_s == 4e-3);
  const Specimen specimen = read_specimen(kDemo / "03_pdms_1to10.toml");
  CHECK(specimen.contact.punch_radius_m == 2.2e-3);
  CHECK(specimen.contact.layer_thickness_m == 11e-3);
  CHECK(specimen.contact.poisson_ratio == 0.495);
  CHECK(specimen.modulus_guess_Pa == 2e6);
  CHECK(specimen.rho_kg_m3 == 965.0);
  CHECK(read_specimen(kDemo / "04_pdms_1to13.toml").mixing_ratio == 13.0);
  CHECK(read_specimen(kDemo / "05_pdms_1to20.toml").mixing_ratio == 20.0);
}

TEST_CASE(
    "the demo's comment on depth holds: 0.13 mm is below 80 % of the cell, 0.25 mm above its "
    "rating",
    "[io][config]") {
  const RigConfig rig = read_rig(kDemo / "01_rig.toml");
  const TestPlan plan = read_test(kDemo / "02_test.toml");
  const EmulatedTruth truth = read_truth(kDemo / "03_pdms_1to10.truth.toml");
  const double N_per_m = force_per_modulus_and_depth_m(truth.contact) * truth.material.E0_Pa;
  CAPTURE(N_per_m);
  CHECK(N_per_m * plan.depth_m < 0.8 * rig.calibration.capacity_N);
  CHECK(N_per_m * plan.depth_m == Approx(1.8).margin(0.05));  // "about 1.8 N"
  CHECK(N_per_m * 0.25e-3 == Approx(3.5).margin(0.05));       // "3.5 N at 0.25 mm"
}

TEST_CASE("the demo's truths carry the seed's values", "[io][config]") {
  const EmulatedTruth truth = read_truth(kDemo / "04_pdms_1to13.truth.toml");
  CHECK(truth.material.E0_Pa == 1.65e6);
  CHECK(truth.material.nu == 0.495);  // of the contact
  REQUIRE(truth.material.terms.size() == 2);
  CHECK(truth.material.terms[0].g == 0.01251);
  CHECK(truth.material.terms[0].k == 0.01251);  // constant Poisson ratio
  CHECK(truth.material.terms[1].tau_s == 1.686);
  CHECK(truth.force_noise_N == Approx(2e-4 * 0.25 * 9.80665).epsilon(1e-14));
  CHECK(truth.drift_relative_per_s == 1e-6);
  CHECK(truth.steps_per_m == 3.2e6);
  CHECK(truth.acceleration_m_s2 == 0.2);
  CHECK(read_truth(kDemo / "03_pdms_1to10.truth.toml").material.E0_Pa == 1.88e6);
  CHECK(read_truth(kDemo / "05_pdms_1to20.truth.toml").material.terms[1].g == 0.01913);
}

TEST_CASE("configurations written as TOML read back the same", "[io][config]") {
  RigConfig rig = read_rig(kDemo / "01_rig.toml");
  rig.name = "a \"quoted\" name, a \\ and a\ttab, µ";
  rig.stage.baud = 250000;
  rig.load_cell.compression_is_positive = false;
  rig.calibration.volts_per_newton = 0.1 + 0.2;  // needs all 17 digits
  rig.frame.stiffness_N_m = 0.0;
  rig.clock_speed = 50.0;
  const std::string text = toml_from_rig(rig);
  const RigConfig again = rig_from_toml(text, "again");
  CHECK(toml_from_rig(again) == text);
  CHECK(again.name == rig.name);
  CHECK(again.stage.baud == 250000);
  CHECK_FALSE(again.load_cell.compression_is_positive);
  CHECK(again.calibration.volts_per_newton == 0.1 + 0.2);
  CHECK(again.frame.stiffness_N_m == 0.0);
  CHECK(again.clock_speed == 50.0);

  const Specimen specimen = read_specimen(kDemo / "05_pdms_1to20.toml");
  const Specimen specimen_again = specimen_from_toml(toml_from_specimen(specimen), "again");
  CHECK(specimen_again.contact.punch_radius_m == specimen.contact.punch_radius_m);
  CHECK(specimen_again.id == specimen.id);
  CHECK(specimen_again.temperature_C == specimen.temperature_C);

  TestPlan plan;
  plan.depth_m = 1.0 / 3.0 * 1e-3;
  CHECK(test_from_toml(toml_from_test(plan), "again").depth_m == plan.depth_m);
}

TEST_CASE("a rig whose calibration stands in another file is written so that it can be read",
          "[io][config]") {
  const std::string text = "[calibration]\nfile = \"cell.toml\"\n[frame]\nfile = \"frame.toml\"\n";
  const std::string written = toml_from_rig(rig_from_toml(text, "rig.toml"));
  CHECK_THAT(written, !Contains("capacity"));
  CHECK(toml_from_rig(rig_from_toml(written, "written")) == written);
}

TEST_CASE("keys missing from a rig file keep their defaults", "[io][config]") {
  const RigConfig rig = rig_from_toml(kMinimalRig, "rig.toml");
  CHECK(rig.stage.baud == 115200);
  CHECK(rig.load_cell.expected_rate_Hz == 80.0);
  CHECK(rig.load_cell.volts_per_count == 20.0 / 16777216.0);
  CHECK(rig.frame.stiffness_N_m == 0.0);
}

TEST_CASE("a misspelt key is refused with its line and the nearest key", "[io][config]") {
  const std::string error = rig_error(std::string(kMinimalRig) + "[stage]\nprot = \"/dev/x\"\n");
  CHECK(error.find("rig.toml:7: there is no key 'stage.prot'; did you mean 'port'?") == 0);
  CHECK(rig_error(std::string(kMinimalRig) + "[saftey]\n").find("did you mean 'safety'?") !=
        std::string::npos);
}

TEST_CASE("a value that does not fit is refused with line, key and what is expected",
          "[io][config]") {
  const std::string minimal = kMinimalRig;
  CHECK(rig_error(minimal + "[stage]\ntravel = \"10 kg\"\n") ==
        "rig.toml:7: stage.travel: 'kg' is not a unit of m; write it like \"40 um\"");
  CHECK(rig_error(minimal + "[stage]\ntravel = -1\n") ==
        "rig.toml:7: stage.travel: is -1; expected a positive number");
  CHECK(rig_error(minimal + "[stage]\ntravel = nan\n") ==
        "rig.toml:7: stage.travel: is nan; expected a positive number");
  CHECK(rig_error(minimal + "[stage]\ntravel = true\n").find("expected a positive number") !=
        std::string::npos);
  CHECK(rig_error(minimal + "[stage]\nbaud = 1.5\n").find("expected a whole number") !=
        std::string::npos);
  CHECK(rig_error(minimal + "[stage]\nport = 3\n").find("expected a text in quotes") !=
        std::string::npos);
  CHECK(rig_error(minimal + "[safety]\nsoft_fraction = 0.99\n").find("soft_fraction < hard") !=
        std::string::npos);
  CHECK(rig_error("stage = 1\n" + minimal).find("expected a section [stage]") != std::string::npos);
}

TEST_CASE("a missing key is refused with the expected value", "[io][config]") {
  CHECK(rig_error("[frame]\nstiffness = 1e4\n[calibration]\ncapacity = 2.45\n") ==
        "rig.toml:3: 'calibration.volts_per_newton' is missing; expected a finite number with a "
        "unit of V/N");
  CHECK(
      rig_error("[frame]\nstifness = 1e4\n[calibration]\ncapacity = 2.45\nvolts_per_newton = 0.7\n")
          .find("rig.toml:2: there is no key 'frame.stifness'; did you mean 'stiffness'?") == 0);
  CHECK(rig_error("[calibration]\ncapacity = 2.45\nvolts_per_newton = 0.7\n") ==
        "rig.toml: 'frame.stiffness' is missing; expected a positive number with a unit of N/m, or "
        "\"rigid\"");
}

TEST_CASE("a file that is not TOML is refused with its line", "[io][config]") {
  CHECK(rig_error("name = \"a\"\nname = \"b\"\n").find("rig.toml:2: not TOML: ") == 0);
  CHECK(rig_error("[stage\n") == "rig.toml:1: not TOML: the bracket of '[stage' is not closed");
}

TEST_CASE("a mistake in TOML is explained in the words of the file", "[io][config]") {
  const auto reason = [](const std::string& line) {
    const std::string error = rig_error("[stage]\n" + line + "\n");
    const std::string begin = "rig.toml:2: not TOML: ";
    return error.starts_with(begin) ? error.substr(begin.size()) : "elsewhere: " + error;
  };
  CHECK(reason("speed = 1 mm/s") == "'1 mm/s' needs quotes, as in speed = \"1 mm/s\"");
  CHECK(reason("port = /dev/ttyUSB0  # the stage") ==
        "'/dev/ttyUSB0' needs quotes, as in port = \"/dev/ttyUSB0\"");
  CHECK(reason("speed = 1,5") == "'1,5' has a decimal comma; write a point");
  CHECK(reason("speed = = 1") == "'=' stands twice behind 'speed'");
  CHECK(reason("speed =") == "the value of 'speed' is missing");
  CHECK(reason("speed = \"1 mm/s") == "a quote (\") is missing");
  CHECK(reason("speed : 1") == "expected key = value or [section], found 'speed : 1'");
  CHECK(reason("speed = 1\nspeed = 2")
            .find("elsewhere: rig.toml:3: not TOML: 'speed' is given "
                  "twice") == 0);
  CHECK(reason("a = [1, 2") == "the bracket of '[1, 2' is not closed");
}

TEST_CASE("values that contradict each other are refused with the file's name", "[io][config]") {
  const std::string error = error_of([] {
    specimen_from_toml(
        "id = \"a\"\nmodulus_guess = 1e6\n[contact]\npunch_diameter = 1e-3\n"
        "layer_thickness = \"half-space\"\npoisson_ratio = 0.6\n",
        "specimen.toml");
  });
  CHECK(error.find("specimen.toml: ") == 0);
  CHECK(error.find("0.6") != std::string::npos);
  CHECK(error_of([] {
          truth_from_toml(
              "[contact]\npunch_diameter = 1e-3\nlayer_thickness = \"half-space\"\n"
              "poisson_ratio = 0.4\n[material]\nE0 = 1e6\nterms = [{g = 0.6, tau = 1},"
              "{g = 0.5, tau = 2}]\n",
              "truth.toml");
        }).find("truth.toml: ") == 0);
}

// What is printed when a demo file with one line replaced is about to be used.
template <typename Config>
std::string use_error(Config (*read)(const std::filesystem::path&, Plausible),
                      const std::string& file, const std::string& old_text,
                      const std::string& new_text) {
  const test::ScratchFolder folder;
  std::string text = read_file(kDemo / file);
  const std::size_t at = text.find(old_text);
  REQUIRE(at != std::string::npos);
  write_file(folder.path() / file, text.replace(at, old_text.size(), new_text), true);
  return error_of([&] { read(folder.path() / file, Plausible::kMeasured); });
}

TEST_CASE("values that no bench can have are refused with line, bounds and an example",
          "[io][config]") {
  const auto specimen_error = [](const std::string& old_text, const std::string& new_text) {
    return use_error(read_specimen, "03_pdms_1to10.toml", old_text, new_text);
  };
  const auto test_error = [](const std::string& old_text, const std::string& new_text) {
    return use_error(read_test, "02_test.toml", old_text, new_text);
  };
  CHECK_THAT(specimen_error("modulus_guess = \"2 MPa\"", "modulus_guess = 2"),
             Contains(".toml:9: modulus_guess: is 2 Pa; plausible are 100 Pa to 1 TPa") &&
                 Contains("write \"2 MPa\"") && Contains("plausible = \"off\""));
  CHECK_THAT(specimen_error("temperature = \"23 degC\"", "temperature = \"-400 degC\""),
             Contains("temperature: is -400 degC") && Contains("23 degC"));
  CHECK_THAT(specimen_error("id = \"pdms-1to10\"", "id = \" \""),
             Contains(".toml:3: id is empty") && Contains("such as"));
  CHECK_THAT(test_error("hold = \"60 s\"", "hold = 1e30"),
             Contains("ramp.hold: is 1e+30 s; plausible are 0 to 30 days"));
  CHECK_THAT(test_error("limit = \"5 mm\"", "limit = \"1 km\""),
             Contains("approach.limit: is 1000 m; plausible are 0 to 1 m"));
  // What an old capture holds is still read.
  CHECK(specimen_from_toml("id = \"\"\nmodulus_guess = 2\n[contact]\npunch_diameter = 1e-3\n"
                           "layer_thickness = \"half-space\"\npoisson_ratio = 0.4\n",
                           "specimen.toml")
            .modulus_guess_Pa == 2.0);
}

TEST_CASE("a file that says plausible = off is read, written and read again as it is",
          "[io][config]") {
  const std::string text =
      "plausible = \"off\"\nid = \"gas\"\nmodulus_guess = 2\n[contact]\n"
      "punch_diameter = 1e-3\nlayer_thickness = \"half-space\"\npoisson_ratio = 0.4\n";
  const Specimen specimen = specimen_from_toml(text, "specimen.toml", Plausible::kMeasured);
  CHECK(specimen.modulus_guess_Pa == 2.0);
  CHECK(specimen.accepts_implausible);
  const Specimen again =
      specimen_from_toml(toml_from_specimen(specimen), "specimen.toml", Plausible::kMeasured);
  CHECK(again.accepts_implausible);
  CHECK_THAT(
      error_of([&] { specimen_from_toml("plausible = \"no\"\n" + text.substr(18), "s.toml"); }),
      Contains("s.toml:1: plausible: expected \"on\""));
  CHECK_FALSE(specimen_from_toml(text.substr(18), "s.toml").accepts_implausible);
}

TEST_CASE("the character 0, at which messages would be cut, is refused", "[io][config]") {
  for (const char* text : {R"(x = "a\u0000b")", R"("a\u0000b" = 1)", R"(x = [["a\U00000000"]])",
                           "[a]\nb = { c = \"\\u0000\" }"}) {
    CHECK(rig_error(text) == "rig.toml: a text or key has the character \\u0000; remove it");
  }
}

TEST_CASE("keys without end are refused before the library reads them", "[io][config]") {
  const std::string dots = [] {
    std::string text = "a";
    for (int i = 0; i < 40000; ++i) text += ".a";
    return text;
  }();
  CHECK_THAT(rig_error("x = 1\n[" + dots + "]\n"),
             Contains("rig.toml:2: a key is longer than 32 sections"));
  CHECK_THAT(rig_error(dots + " = 1\n"), Contains("rig.toml:1: a key is longer than 32 sections"));
  CHECK_THAT(rig_error("x = { " + dots + " = 1 }\n"), Contains("32 sections"));
  CHECK_THAT(rig_error("x = 1\n[\"a\" . 'b' . " + dots + "]\n"), Contains("32 sections"));
  CHECK_THAT(
      rig_error("x = 1\ny = " + std::string(3000, '[') + "1" + std::string(3000, ']') + "\n"),
      Contains("rig.toml:2: not TOML: lists or tables inside each other are nested deeper"));
  CHECK_THAT(rig_error(std::string(5000, 'k') + " = 1\n"), Contains("1000 characters"));
  CHECK_THAT(rig_error("\"" + std::string(5000, 'k') + "\" = 1\n"), Contains("1000 characters"));
  // Texts, comments and lists of numbers are no keys.
  std::string numbers = "x = [";
  for (int i = 0; i < 1000; ++i) numbers += "1.5, 2.5e-3,\n";
  for (const std::string& text : {numbers + "]", "x = \"" + dots + "\"", "x = '''\n" + dots + "'''",
                                  "# " + dots, "x = \"" + std::string(5000, 'k') + "\""}) {
    CHECK_THAT(rig_error(text), !Contains("the limit"));
  }
}

}  // namespace
}  // namespace viscard
