#include "io/basics/atomic_file.h"
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

nlohmann::json json_of(const std::vector<std::string>& words) {
  const CommandOutcome ran = run_command(words);
  INFO(ran.err);
  REQUIRE(ran.status == kDone);
  return nlohmann::json::parse(ran.out);
}

std::string flags_of(const nlohmann::json& json) {
  std::string names;
  for (const auto& flag : json["flags"]) names += flag["name"].get<std::string>() + " ";
  return names;
}

// Two presses of 2 s ramp and 20 s hold, the first to half the depth, each after 5 s in the air.
// Elastic, 2e4 N/m, with a trace of the last digits in place of noise.
std::string two_presses() {
  std::ostringstream text;
  text.precision(12);
  text << "time_s,force_N,depth_m\n";
  for (int i = 0; i < 600; ++i) {
    const double t = 0.1 * i;
    const double in_press = std::fmod(t, 30.0);
    const double top = t < 30.0 ? 1e-4 : 2e-4;
    double depth = -2e-5;
    if (in_press > 5.0) depth += (top + 2e-5) * std::min(1.0, (in_press - 5.0) / 2.0);
    if (in_press > 27.0) depth -= (top + 2e-5) * std::min(1.0, (in_press - 27.0) / 2.0);
    text << t << "," << 2e4 * std::max(0.0, depth) + 1e-5 * ((7 * i) % 11) << "," << depth << "\n";
  }
  return text.str();
}

}  // namespace

TEST_CASE("a part of a table is chosen by time, by hold or by itself, and printed", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("two.csv", two_presses());
  const auto all = json_of({"fit", file, "--json"});
  CHECK(all["n_samples"] == 600);
  CHECK(all["n_contacts"] == 2);
  CHECK(all["K0_N_m"].get<double>() == Approx(2e4).epsilon(1e-3));
  const auto second = json_of({"fit", file, "--hold", "2", "--json"});
  CHECK(second["K0_N_m"].get<double>() == Approx(2e4).epsilon(1e-3));
  CHECK(second["fit_from_s"].get<double>() > 26.0);
  CHECK(second["fit_to_s"].get<double>() == Approx(57.0).margin(0.3));
  CHECK(second["left_out"]["not_chosen"].get<int>() + second["n_samples"].get<int>() == 600);
  CHECK(second["n_rows"] == 600);
  CHECK(flags_of(second) == "history-left-out ");  // it was unloaded between
  const auto part = json_of({"fit", file, "--from", "1 s", "--to", "25", "--json"});
  CHECK(part["n_samples"] == 241);
  CHECK(part["fit_to_s"].get<double>() == Approx(25.0));
  const CommandOutcome crop = run_command({"fit", file, "--crop", "auto"});
  CHECK_THAT(crop.out, Contains("chosen: ") && Contains("of 600"));
  CHECK_THAT(run_command({"fit", file, "--hold", "3"}).err, Contains("has 2 holds"));
  CHECK_THAT(run_command({"fit", file, "--from", "100"}).err,
             Contains("0 rows between --from and --to") && Contains("covers 0 to 59.9 s"));
  CHECK_THAT(run_command({"fit", file, "--from", "59.9"}).err,
             Contains("1 row between --from and --to, and a fit needs at least 4"));
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--hold", "0"},
                                                {"--crop", "all"},
                                                {"--from", "2", "--to", "1"},
                                                {"--hold", "1", "--crop", "auto"},
                                                {"--depth", "-1 mm"}}) {
    std::vector<std::string> line{"fit", file};
    line.insert(line.end(), words.begin(), words.end());
    CHECK(run_command(line).status == kBadWords);
  }
}

TEST_CASE("a part that begins under load is not trusted: what was before relaxes in it", "[cli]") {
  const TableFolder folder;
  std::ostringstream text;
  text << "time_s,force_N,depth_m\n";
  for (int i = 0; i < 1000; ++i) {  // two steps of load, each relaxing by a fifth in 40 s
    const double t = 0.1 * i;
    const double depth = 1e-4 * (std::min(1.0, t) + std::clamp(t - 50.0, 0.0, 1.0));
    double force = 1.6e4 * depth + 1e-5 * ((7 * i) % 11);
    for (const double at : {0.5, 50.5}) {
      if (t > at) force += 0.4 * std::exp(-(t - at) / 40.0);
    }
    text << t << "," << force << "," << depth << "\n";
  }
  const std::string file = folder.write("steps.csv", text.str());
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--hold", "2"}, {"--from", "30 s"}}) {
    std::vector<std::string> line{"fit", file, "--json"};
    line.insert(line.end(), words.begin(), words.end());
    const CommandOutcome ran = run_command(line);
    CHECK(ran.status != kDone);
    CHECK_THAT(ran.out, Contains("history-missing"));
  }
  const auto first = nlohmann::json::parse(run_command({"fit", file, "--hold", "1", "--json"}).out);
  CHECK_THAT(flags_of(first), !Contains("history"));
}

TEST_CASE("a record of force alone gives forces, or stiffnesses with --depth", "[cli]") {
  const TableFolder folder;
  std::string text = relaxation_table();
  text.replace(text.find("E_relax"), 7, "Force");
  text.replace(text.find("MPa"), 3, "mN");
  const std::string file = folder.write("F.csv", text);
  const auto forces = json_of({"fit", file, "--json"});
  CHECK(forces["F0_N"].get<double>() == Approx(1.8e-3).epsilon(1e-4));
  CHECK(forces["terms"][0].contains("force_N"));
  CHECK_THAT(run_command({"fit", file}).out, Contains("depth"));
  const auto stiffness = json_of({"fit", file, "--depth", "0.1 mm", "--json"});
  CHECK(stiffness["K0_N_m"].get<double>() == Approx(18.0).epsilon(1e-4));
  const auto modulus =
      json_of({"fit", file, "--depth", "0.1 mm", "--punch-diameter", "4 mm", "--json"});
  // F/h = 2 a E/(1 - nu^2) on a half-space, nu = 0.495.
  CHECK(modulus["E0_Pa"].get<double>() ==
        Approx(18.0 * (1.0 - 0.495 * 0.495) / 4e-3).epsilon(1e-4));
  CHECK(run_command({"fit", file, "--punch-diameter", "4 mm"}).status == kFailed);
  // A column of unknown meaning may be the depth, so nothing is assumed.
  const std::string three = folder.write("three.csv", "time_s,force_N,sep\n0,1,5\n1,2,4\n2,3,3\n");
  CHECK_THAT(run_command({"fit", three}).err,
             Contains("3 'sep' (5, 4, 3)") && !Contains("depth_m=-3"));
}

TEST_CASE("fit --crop auto of a force alone puts t = 0 into the rise before its largest value",
          "[cli]") {
  // A baseline of 5 s, a ramp, then the relaxation of E0 2 N after ramp and hold (exact).
  const TableFolder folder;
  const double ramp_s = GENERATE(0.1, 1.0);
  const auto force_N = [&](double since) {
    if (since <= 0.0) return 0.0;
    const double up = std::min(since, ramp_s);
    double sum = 1.2 * up;
    for (const auto& [modulus, tau] : {std::pair{0.5, 0.8}, {0.3, 8.0}}) {
      sum += modulus * tau * (std::exp(-(since - up) / tau) - std::exp(-since / tau));
    }
    return sum / ramp_s;
  };
  std::ostringstream text;
  text.precision(12);
  text << "time_s,force_N\n";
  for (int i = 0; i < 1200; ++i) {
    const double t = 0.05 * i;
    text << t << "," << force_N(t - 5.0) + 1e-4 * ((7 * i) % 11 - 5) << "\n";
  }
  const std::string file = folder.write("F.csv", text.str());
  const auto fit = json_of({"fit", file, "--crop", "auto", "--json"});
  CHECK_THAT(flags_of(fit), Contains("time-zero-chosen"));
  CHECK(fit["F0_interval_95"][0].get<double>() < 2.0);
  CHECK(fit["F0_interval_95"][1].get<double>() > 2.0);
  CHECK(fit["F0_N"].get<double>() == Approx(2.0).epsilon(0.1));
  CHECK(fit["first_sample_s"].get<double>() == Approx(0.5 * ramp_s).margin(0.03));
  CHECK(fit["F_inf_N"].get<double>() == Approx(1.2).epsilon(0.01));
  CHECK_THAT(run_command({"fit", file, "--crop", "auto"}).out,
             Contains("counts as a step at t = ") && Contains("half the rise changes E0"));
  // A time of the step that the user gives stays.
  const auto given = json_of({"fit", file, "--crop", "auto", "--time-zero", "5 s", "--json"});
  CHECK_THAT(flags_of(given), !Contains("time-zero-chosen"));
}

TEST_CASE("fit --crop auto of a force alone ends where the punch is lifted", "[cli]") {
  // A step at 2 s, and from 45 s a fall to 0 in `lift_s`, faster than any relaxation.
  const TableFolder folder;
  const double lift_s = GENERATE(0.01, 0.5, 3.0);
  std::ostringstream text;
  text.precision(12);
  text << "time_s,force_N\n";
  for (int i = 0; i < 1200; ++i) {
    const double t = 0.05 * i;
    const double held = t < 2.0 ? 0.0 : 1.2 + 0.8 * std::exp(-(t - 2.0) / 5.0);
    const double lifted = std::clamp((t - 45.0) / lift_s, 0.0, 1.0);
    text << t << "," << held * (1.0 - lifted) + 1e-4 * ((7 * i) % 11 - 5) << "\n";
  }
  const std::string file = folder.write("lifted.csv", text.str());
  const auto fit = json_of({"fit", file, "--crop", "auto", "--json"});
  CAPTURE(lift_s, fit["fit_to_s"].get<double>());
  CHECK(fit["F_inf_N"].get<double>() == Approx(1.2).epsilon(0.01));
  CHECK(fit["terms"][0]["tau_s"].get<double>() == Approx(5.0).epsilon(0.05));
  CHECK_THAT(run_command({"fit", file, "--crop", "auto"}).out, Contains(" to 45 s"));
}

TEST_CASE("a constant stress with a changing strain is a creep test", "[cli]") {
  const TableFolder folder;
  std::ostringstream text;
  text << "time (s),stress (Pa),strain\n";
  for (int i = 0; i <= 100; ++i) {
    const double t = std::pow(10.0, -2.0 + 4.0 * i / 100.0);
    text << t << ",10," << 1e-5 * (1.5 - 0.5 * std::exp(-t / 3.0)) + 1e-11 * ((7 * i) % 11) << "\n";
  }
  const auto json = json_of({"fit", folder.write("c.csv", text.str()), "--json"});
  CHECK(json["kind"] == "creep");
  CHECK(json["E0_Pa"].get<double>() == Approx(1e6).epsilon(0.01));
}

TEST_CASE(
    "a table that is not understood shows its columns, and proposes nothing that no header "
    "supports",
    "[cli]") {
  const TableFolder folder;
  std::string text = relaxation_table();
  text.replace(0, text.find('\n', text.find('\n') + 1) + 1, "a,b\n");
  const std::string file = folder.write("other.csv", text);
  const CommandOutcome ran = run_command({"fit", file});
  CHECK(ran.status == kFailed);
  CHECK_THAT(ran.err, Contains("1 'a' (0.01, ") && !Contains("modulus_Pa=2"));
  CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
  CHECK(run_command(
            {"fit", file, "--column", "time_s=1", "--column", "modulus_Pa=2", "--plausible", "off"})
            .status == kDone);
}

TEST_CASE("a file that never ends is refused in one line", "[cli]") {
  const CommandOutcome ran = run_command({"fit", "/dev/zero"});
  CHECK(ran.status == kFailed);
  CHECK_THAT(ran.err, Contains("did not end"));
  CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
  CHECK_THAT(run_command({"export", "/dev/zero"}).err, Contains("did not end"));
}

TEST_CASE("losses far beyond the storage moduli end in words", "[cli]") {
  const TableFolder folder;
  for (const char* row : {"{},1e6,1e300\n", "1,1,1e300\n", "{},1,1e-300\n", "{},1e-300,1\n"}) {
    std::string table = "frequency_Hz,storage_modulus_Pa,loss_modulus_Pa\n";
    for (int i = 1; i <= 60; ++i) table += fmt::format(fmt::runtime(row), i);
    const CommandOutcome ran =
        run_command({"fit", folder.write("c.csv", table), "--plausible", "off", "--json"});
    INFO(row << ran.out.substr(0, 200));
    CHECK((ran.status == kDone || ran.status == kFailed));
  }
}

TEST_CASE("a table is written under every name that a file may have", "[cli]") {
  const TableFolder folder;
  std::string text = "time_s,modulus_Pa\n";
  for (int i = 1; i < 20; ++i) text += fmt::format("{},{}\n", i, 1e6 + 1e6 / i);
  const std::string two_lines = folder.write("a\nb.csv", text);
  const std::string longest = folder.write(std::string(251, 'x') + ".csv", "");
  const CommandOutcome ran = run_command({"fit", two_lines, "--csv", longest, "--force"});
  INFO(ran.err);
  REQUIRE(ran.status == kDone);
  std::istringstream lines(read_file(longest));
  std::string head, second;
  std::getline(lines, head);
  std::getline(lines, second);
  CHECK(head.starts_with("# viscard fit"));
  CHECK(second.starts_with("time_s"));
}

TEST_CASE("options that a table cannot use are refused, not ignored", "[cli]") {
  const TableFolder folder;
  const std::string depth = folder.write("depth.csv", two_presses());
  CommandOutcome ran = run_command({"fit", depth, "--depth", "0.1 mm"});
  CHECK(ran.status == kFailed);
  CHECK_THAT(ran.err, Contains("--depth is for a record of force"));
  std::string creep = "time_s,compliance_1_Pa\n";
  for (int i = 0; i < 50; ++i) {
    creep += std::to_string(i) + "," + std::to_string(2.0 - std::exp(-0.1 * i)) + "\n";
  }
  const std::string creep_file = folder.write("creep.csv", creep);
  ran = run_command({"fit", creep_file, "--drift"});
  CHECK(ran.status == kFailed);
  CHECK_THAT(ran.err, Contains("--drift is for tables of relaxation"));
  std::string dma = "frequency_Hz,storage_modulus_Pa,loss_modulus_Pa\n";
  for (int i = 0; i < 30; ++i) {
    const double f = std::pow(10.0, 0.1 * i - 1.5), x = f * f;
    dma += fmt::format("{},{},{}\n", f, 1e6 + 2e5 * x / (1 + x), 2e5 * f / (1 + x) + 1e3);
  }
  const std::string dma_file = folder.write("dma.csv", dma);
  const std::string capture = folder.write("run.viscap", "");
  std::filesystem::remove(capture);
  REQUIRE(run_command({"capture", "--emulate", "--speed", "500", "--out", capture}).status ==
          kDone);
  const std::string uniaxial =
      std::string("uniaxial=") + (VISCARD_SOURCE_DIR "/data/reference/treloar_uniaxial.csv");
  struct Without {
    const std::string& file;
    const char *option, *value;
  };
  for (const auto& [file, option, value] : {Without{creep_file, "--gauge-length", "25 mm"},
                                            Without{creep_file, "--area", "12 mm2"},
                                            Without{creep_file, "--youngs-modulus", "1.5 MPa"},
                                            Without{creep_file, "--punch-diameter", "4 mm"},
                                            Without{creep_file, "--frame-stiffness", "10 N/mm"},
                                            Without{dma_file, "--time-zero", "0.1"},
                                            Without{dma_file, "--from", "0.1 s"},
                                            Without{dma_file, "--to", "10"},
                                            Without{dma_file, "--hold", "1"},
                                            Without{dma_file, "--crop", "auto"},
                                            Without{dma_file, "--vertical-shift", "on"},
                                            Without{depth, "--vertical-shift", "off"},
                                            Without{depth, "--area", "12 mm2"},
                                            Without{capture, "--area", "12 mm2"},
                                            Without{capture, "--sheet", "x"},
                                            Without{capture, "--skip", "2"},
                                            Without{capture, "--reference-temperature", "20 degC"},
                                            Without{capture, "--vertical-shift", "on"},
                                            Without{uniaxial, "--gauge-length", "25 mm"},
                                            Without{uniaxial, "--area", "12 mm2"}}) {
    INFO(file << " " << option);
    ran = run_command({"fit", file, option, value});
    CHECK(ran.status == kFailed);
    CHECK_THAT(ran.err, Contains(option));
    CHECK_THAT(ran.err, Contains("omit"));
  }
  for (const char* option : {"--from", "--to"}) {  // which a table of frequencies seems to take
    ran = run_command({"fit", dma_file, option, "1 Hz"});
    CHECK(ran.status == kBadWords);
    CHECK_THAT(ran.err, Contains(std::string(option) + " is for records in time"));
  }
  ran = run_command({"fit", creep_file, "--terms", "1", "--max-terms", "5"});
  CHECK(ran.status == kBadWords);
  CHECK_THAT(ran.err, Contains("--max-terms is for the choice of a number of terms"));
}

TEST_CASE("of several files together an option is refused if none of them uses it", "[cli]") {
  const TableFolder folder;
  const std::string relaxation = "relaxation=" + folder.write("r.csv", relaxation_table());
  std::string table = "time_s,compliance_1_Pa\n", loads = "time_s,force_N,strain\n";
  for (int i = 0; i < 80; ++i) {
    const double t = std::pow(10.0, -2.0 + 0.05 * i);
    table += fmt::format("{},{}\n", t, 1e-6 * (1.5 - 0.5 * std::exp(-t)) + 1e-11 * ((7 * i) % 11));
    loads += fmt::format("{},{},0.01\n", t, 0.1 * (1.0 + std::exp(-t)) + 1e-6 * ((7 * i) % 11));
  }
  const std::string creep = "creep=" + folder.write("c.csv", table);
  for (const auto& [option, value] :
       {std::pair{"--depth", "0.1 mm"}, std::pair{"--gauge-length", "25 mm"},
        std::pair{"--area", "12 mm2"}, std::pair{"--punch-diameter", "4 mm"},
        std::pair{"--frame-stiffness", "10 N/mm"}, std::pair{"--youngs-modulus", "1.5 MPa"},
        std::pair{"--vertical-shift", "on"}}) {
    const CommandOutcome ran = run_command({"fit", relaxation, creep, option, value});
    CHECK(ran.status == kFailed);
    CHECK_THAT(ran.err, Contains(std::string(option) + " is for") && Contains("omit it"));
  }
  // The loads become stresses by it.
  const CommandOutcome used =
      run_command({"fit", "relaxation=" + folder.write("l.csv", loads), creep, "--area", "12 mm2"});
  CHECK_THAT(used.err, !Contains("--area"));
}
