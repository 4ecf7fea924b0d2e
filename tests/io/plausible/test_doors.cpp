// The same wrong number at every door: tables, options, files, requests, scenes and sweeps.
#include "io/basics/atomic_file.h"
#include "io/serve/rig_api.h"
#include "io/serve/rig_server.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace viscard {
namespace {

using Json = nlohmann::ordered_json;
using test::run_command;
using test::ScratchFolder;

constexpr int kRows = 120;

// Rows of a relaxation from 1.5 to 1 MPa, with `line` for each time and modulus in MPa.
std::string table(const std::string& header,
                  const std::function<std::string(double t_s, double E_MPa)>& line) {
  std::ostringstream text;
  text.precision(10);
  text << header << "\n";
  for (int i = 0; i < kRows; ++i) {
    const double t_s = 0.02 * std::pow(5000.0, i / (kRows - 1.0));
    const double noise = 1.0 + 1e-3 * std::sin(12.9898 * i) * std::cos(78.233 * i);
    text << line(t_s, (1.0 + 0.5 * std::exp(-t_s / 3.0)) * noise) << "\n";
  }
  return text.str();
}

std::string row(std::initializer_list<double> cells) {
  std::ostringstream text;
  text.precision(10);
  const char* gap = "";
  for (const double cell : cells) {
    text << gap << cell;
    gap = ",";
  }
  return text.str();
}

std::string relaxation(const std::string& header, double factor) {
  return table(header, [=](double t_s, double E) { return row({t_s, factor * E}); });
}

std::string stress_and_strain(const std::string& header, double stress, double strain) {
  return table(header, [=](double t_s, double E) { return row({t_s, stress * E, strain}); });
}

std::string creep(const std::string& header, double factor) {
  return table(header, [=](double t_s, double E) { return row({t_s, factor / E}); });
}

// A flat punch on a layer, pressed for a second and held: force about 2 N for a depth of 0.13 mm.
std::string indentation(const std::string& header, double deepest) {
  std::ostringstream text;
  text.precision(10);
  text << header << "\n";
  for (int i = 0; i < 200; ++i) {
    const double t_s = i < 20 ? 0.05 * i : 1.0 + 0.2 * (i - 20);
    const double share = std::min(1.0, t_s);
    const double force_N = 1.9 * share * (1.0 + 0.2 * std::exp(-t_s / 2.0));
    text << row({t_s, force_N, deepest * share}) << "\n";
  }
  return text.str();
}

std::string dma(const std::string& header, double factor) {
  std::ostringstream text;
  text.precision(10);
  text << header << "\n";
  for (int i = 0; i < 60; ++i) {
    const double f_Hz = 0.01 * std::pow(1e4, i / 59.0), x = 6.2832 * f_Hz * 0.1;
    text << row({f_Hz, factor * (1.0 + 0.5 * x * x / (1.0 + x * x)),
                 factor * 0.5 * x / (1.0 + x * x)})
         << "\n";
  }
  return text.str();
}

// Neo-Hooke with G = 0.4 MPa.
std::string rubber(const std::string& header, double stress,
                   const std::function<double(double)>& x) {
  std::ostringstream text;
  text.precision(10);
  text << header << "\n";
  for (int i = 1; i <= 30; ++i) {
    const double stretch = 1.0 + 0.06 * i;
    text << row({x(stretch), stress * 0.4 * (stretch - 1.0 / (stretch * stretch))}) << "\n";
  }
  return text.str();
}

// A table that is fitted as it stands only if its numbers are plausible.
struct Case {
  const char* what;
  std::string text;
  std::vector<std::string> options;  // of viscard fit; "FILE" stands for the table
  const char* remedy;                // what the message advises to write
  double factor;                     // of the advised column, so that E0 is near `E0_MPa`
};

std::vector<Case> wrong_units() {
  const auto same = [](double stretch) { return stretch; };
  const auto percent = [](double stretch) { return 100.0 * (stretch - 1.0); };
  return {
      {"moduli in MPa", relaxation("time,E", 1.0), {"FILE"}, "modulus_Pa=1e6*E", 1.5e6},
      {"stresses in MPa",
       stress_and_strain("time,stress,strain", 0.01, 0.01),
       {"FILE"},
       "stress_Pa=1e6*stress",
       1.5e6},
      {"moduli of an oscillation in MPa",
       dma("frequency [Hz],storage,loss", 1.0),
       {"FILE"},
       "storage_modulus_Pa=1e6*storage",
       0.0},
      {"compliances in 1/MPa",
       creep("time,compliance", 1.0),
       {"FILE"},
       "compliance_1_Pa=1e-6*compliance",
       1.5e6},
      {"depths in mm",
       indentation("time,force,depth", 0.13),
       {"FILE", "--punch-diameter", "4.4 mm", "--layer-thickness", "11 mm"},
       "depth_m=1e-3*depth",
       0.0},
      {"strains in per cent",
       stress_and_strain("time (s),stress (MPa),strain", 0.01, 1.0),
       {"FILE"},
       "strain=0.01*strain",
       1.5e6},
      {"stresses of rubber in MPa",
       rubber("stretch,stress", 1.0, same),
       {"uniaxial=FILE"},
       "stress_Pa=1e6*stress",
       1.2e6},
      {"strains of rubber in per cent",
       rubber("nominal strain,nominal stress [MPa]", 1.0, percent),
       {"uniaxial=FILE"},
       "strain=0.01*nominal strain",
       1.2e6},
  };
}

std::vector<std::string> words_of(const Case& one, const std::string& file) {
  std::vector<std::string> words{"fit"};
  for (std::string word : one.options) {
    const std::size_t at = word.find("FILE");
    if (at != std::string::npos) word.replace(at, 4, file);
    words.push_back(word);
  }
  return words;
}

TEST_CASE("a table in another unit is refused, and the advised words read it", "[io][cli]") {
  const ScratchFolder folder;
  for (const Case& one : wrong_units()) {
    INFO(one.what);
    const std::string file = (folder / "table.csv").string();
    write_file(file, one.text, true);
    std::vector<std::string> words = words_of(one, file);
    const test::CommandOutcome refused = run_command(words);
    INFO(refused.err);
    CHECK(refused.status == 1);
    CHECK(refused.out == "");
    CHECK(refused.err.find(one.remedy) != std::string::npos);
    if (one.factor == 0.0) continue;
    words.insert(words.end(), {"--column", one.remedy, "--json"});
    const Json read = Json::parse(run_command(words).out);
    INFO(read.dump());
    const Json& fit = read.contains("laws") ? read["laws"][0] : read;
    CHECK(fit.at("E0_Pa").get<double>() == Approx(one.factor).epsilon(0.02));
  }
}

TEST_CASE("a table with a wrong unit is fitted with --plausible off, and the result states it",
          "[io][cli]") {
  const ScratchFolder folder;
  for (const Case& one : wrong_units()) {
    INFO(one.what);
    const std::string file = (folder / "table.csv").string();
    write_file(file, one.text, true);
    std::vector<std::string> words = words_of(one, file);
    words.insert(words.end(), {"--plausible", "off", "--json"});
    const test::CommandOutcome outcome = run_command(words);
    INFO(outcome.err);
    const Json fit = Json::parse(outcome.out);
    CHECK(fit.at("plausible") == "off");
    CHECK(fit.dump().find("plausible-off") != std::string::npos);
  }
}

TEST_CASE("a material that was fitted with --plausible off is read by later commands",
          "[io][cli]") {
  const ScratchFolder folder;
  const std::string file = (folder / "table.csv").string(), out = (folder / "m.json").string();
  write_file(file, relaxation("time,E", 1.0), false);
  REQUIRE(run_command({"fit", file, "--plausible", "off", "--out", out}).status == 0);
  const std::string text = read_file(out);
  CHECK(text.find("plausible-off") != std::string::npos);
  CHECK(run_command({"predict", out, "--to", "10 s"}).status == 0);
  CHECK(run_command({"card", out, "--for", "json"}).status == 0);
  // Without the flag its modulus is refused by each.
  Json bare = Json::parse(text);
  bare["flags"] = Json::array();
  const std::string other = (folder / "bare.json").string();
  write_file(other, bare.dump(), false);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"predict", other},
                                                {"card", other, "--for", "json"},
                                                {"validate", other}}) {
    const test::CommandOutcome refused = run_command(words);
    INFO(refused.err);
    CHECK(refused.status == 1);
    CHECK(refused.err.find("plausible are 100 Pa to 1 TPa") != std::string::npos);
  }
}

TEST_CASE("columns without unit are flagged for every kind of test", "[io][cli]") {
  const ScratchFolder folder;
  const auto same = [](double stretch) { return stretch; };
  const std::vector<std::pair<std::string, std::vector<std::string>>> tables{
      {relaxation("time,E", 1e6), {"FILE"}},
      {dma("frequency,storage,loss", 1e6), {"FILE"}},
      {creep("time,compliance", 1e-6), {"FILE"}},
      {rubber("stretch,stress", 1e6, same), {"uniaxial=FILE"}}};
  for (const auto& [text, options] : tables) {
    const std::string file = (folder / "table.csv").string();
    write_file(file, text, true);
    std::vector<std::string> words = words_of({"", "", options, "", 0.0}, file);
    words.emplace_back("--json");
    const test::CommandOutcome outcome = run_command(words);
    INFO(outcome.out << outcome.err);
    CHECK(outcome.out.find("unit-assumed") != std::string::npos);
  }
}

TEST_CASE("strains and depths beyond a linear law are flagged, or refused", "[io][cli]") {
  const ScratchFolder folder;
  const std::string file = (folder / "table.csv").string();
  const auto outcome_of = [&](const std::string& text, std::vector<std::string> options) {
    write_file(file, text, true);
    options.insert(options.begin(), {"fit", file});
    options.emplace_back("--json");
    return run_command(options);
  };
  const char* header = "time (s),stress (MPa),strain (%)";
  const auto flagged = [](const test::CommandOutcome& outcome, const char* flag) {
    return outcome.out.find(flag) != std::string::npos;
  };
  CHECK_FALSE(flagged(outcome_of(stress_and_strain(header, 0.05, 5.0), {}), "strain-beyond"));
  CHECK(flagged(outcome_of(stress_and_strain(header, 0.2, 20.0), {}), "strain-beyond-linear"));
  CHECK(flagged(outcome_of(stress_and_strain(header, 0.6, 60.0), {}), "strain-beyond-linear"));
  const std::vector<std::string> punch{"--punch-diameter", "4.4 mm", "--layer-thickness", "11 mm"};
  const char* depth = "time (s),force (N),depth (mm)";
  CHECK_FALSE(flagged(outcome_of(indentation(depth, 3.0), punch), "depth-beyond"));
  CHECK(flagged(outcome_of(indentation(depth, 5.0), punch), "depth-beyond-linear"));
  const test::CommandOutcome through = outcome_of(indentation(depth, 13.0), punch);
  CHECK(through.status == 1);
  CHECK(through.err.find("the layer is 11 mm thick") != std::string::npos);
}

TEST_CASE("an option that is not plausible is refused as a wrong word", "[io][cli]") {
  const ScratchFolder folder;
  const std::string table_file = (folder / "table.csv").string();
  const std::string material = (folder / "m.json").string(), law = (folder / "law.json").string();
  write_file(table_file, relaxation("time_s,modulus_Pa", 1e6), false);
  REQUIRE(run_command({"fit", table_file, "--out", material}).status == 0);
  const std::string stretches = (folder / "rubber.csv").string();
  write_file(stretches, rubber("stretch,nominal_stress_Pa", 1e6, [](double x) { return x; }),
             false);
  REQUIRE(
      run_command({"fit", "uniaxial=" + stretches, "--model", "neo-hooke", "--out", law}).status ==
      0);
  struct Wrong {
    std::vector<std::string> words;
    const char* advice;
  };
  const std::vector<Wrong> all{
      {{"fit", table_file, "--density", "1.1"}, "--density \"1.1 g/cm3\""},
      {{"fit", table_file, "--poisson-ratio", "0.7", "--punch-diameter", "4 mm"}, "-1 to 0.5"},
      {{"fit", table_file, "--punch-diameter", "4.4"}, "--punch-diameter \"4.4 mm\""},
      {{"fit", "uniaxial=" + stretches, "--youngs-modulus", "1.2"}, "\"1.2 MPa\""},
      {{"fit", "uniaxial=" + stretches, "--youngs-modulus", "E_inf=1.2"}, "\"E_inf=1.2 MPa\""},
      {{"predict", material, "--strain", "5"}, "--strain \"5 %\""},
      {{"predict", material, "--test", "creep", "--stress", "1e15"}, "--plausible off"},
      {{"predict", material, "--temperature", "5000"}, "-200"},
      {{"card", law, "--for", "abaqus", "--bulk-modulus", "2"}, "--bulk-modulus \"2 GPa\""},
      {{"card", law, "--for", "abaqus", "--bulk-modulus", "200 kPa"}, "2G/3"},
      {{"card", law, "--for", "lsdyna", "--density", "1.1"}, "--density \"1.1 g/cm3\""},
      {{"card", material, "--for", "abaqus", "--at-temperature", "2000"}, "1000"},
  };
  for (const Wrong& one : all) {
    const test::CommandOutcome outcome = run_command(one.words);
    INFO(one.words[1] << " " << one.words[2] << " " << one.words[3] << ": " << outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find(one.advice) != std::string::npos);
  }
  const test::CommandOutcome large =
      run_command({"predict", material, "--test", "relaxation", "--strain", "20 %", "--json"});
  CHECK(large.status == 0);
  CHECK(large.out.find("strain-beyond-linear") != std::string::npos);
  const test::CommandOutcome soft =
      run_command({"card", law, "--for", "abaqus", "--bulk-modulus", "2 MPa"});
  CHECK(soft.status == 0);
  CHECK(soft.err.find("times the shear modulus") != std::string::npos);
  CHECK(soft.out.find("warning: the bulk modulus") != std::string::npos);
}

// The scene of a pillar under a plate; `change` edits its text.
std::string scene(const std::string& from = "", const std::string& to = "") {
  std::string text =
      "tolerance = 1e-2\n[geometry]\ndiameter = \"40 um\"\nlength = \"120 um\"\n"
      "[materials]\npillar = { E = \"1.8 MPa\", nu = 0.33, rho = \"965 kg/m3\" }\n"
      "[analysis]\nkind = \"static\"\nload = { displacement = \"-1 um\", on = \"top\" }\n";
  if (!from.empty()) text.replace(text.find(from), from.size(), to);
  return text;
}

TEST_CASE("a scene is refused for what no scene has, and takes more than a bench", "[io][cli]") {
  const ScratchFolder folder;
  const std::string file = (folder / "scene.toml").string();
  const auto outcome_of = [&](const std::string& text,
                              const std::vector<std::string>& options = {}) {
    write_file(file, text, true);
    std::vector<std::string> words{"plan", file, "--json"};
    words.insert(words.end(), options.begin(), options.end());
    return run_command(words);
  };
  CHECK(outcome_of(scene()).status == 0);
  CHECK(outcome_of(scene("1.8 MPa", "1e15 Pa")).status == 0);
  std::string large = scene("\"40 um\"", "\"2 m\"");
  large.replace(large.find("\"120 um\""), 8, "\"6 m\"");
  CHECK(outcome_of(large).status == 0);  // the units are stated
  CHECK(outcome_of(scene("\"120 um\"", "2")).status == 1);
  struct Wrong {
    const char *from, *to, *advice;
  };
  for (const Wrong& one :
       {Wrong{"\"40 um\"", "40", "\"40 um\""}, Wrong{"\"1.8 MPa\"", "1.8", "\"1.8 MPa\""},
        Wrong{"965 kg/m3", "965 g/cm3", "plausible = \"off\""},
        Wrong{"0.33", "0.7", "-1 to 0.5"}}) {
    const test::CommandOutcome outcome = outcome_of(scene(one.from, one.to));
    INFO(outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find(one.advice) != std::string::npos);
    CHECK(outcome.err.find("scene.toml:") != std::string::npos);
  }
  const std::string soft = scene("\"1.8 MPa\"", "1.8");
  for (const test::CommandOutcome& accepted :
       {outcome_of(soft, {"--plausible", "off"}), outcome_of("plausible = \"off\"\n" + soft)}) {
    INFO(accepted.err);
    CHECK(accepted.status == 0);
    CHECK(Json::parse(accepted.out).at("plausible") == "off");
  }
}

TEST_CASE("a sweep with a value in a wrong unit ends before its first point", "[io][cli]") {
  const ScratchFolder folder;
  write_file(folder / "scene.toml", scene(), false);
  for (const char* value : {"44 kPa", "44 km", "44"}) {
    const std::string study = (folder / "study.toml").string();
    write_file(study,
               "scene = \"scene.toml\"\n[[parameter]]\nkey = \"geometry.diameter\"\n"
               "values = [\"36 um\", \"40 um\", \"" +
                   std::string(value) + "\"]\n",
               true);
    const std::string out = (folder / "points.sqlite").string();
    const test::CommandOutcome outcome = run_command({"sweep", study, "--out", out});
    INFO(outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("geometry.diameter") != std::string::npos);
    CHECK(outcome.err.find(value) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(out));
  }
}

TEST_CASE("the page refuses and accepts the same numbers as files", "[io][serve]") {
  const ScratchFolder folder;
  ServeOptions options;
  options.folder = folder.path();
  options.is_emulated = true;
  OneJob job;
  RigApi api(options, job);
  const Json good{{"id", "a"},
                  {"modulus_guess_Pa", 2e6},
                  {"punch_diameter_m", 4.4e-3},
                  {"layer_thickness_m", 11e-3},
                  {"poisson_ratio", 0.495}};
  REQUIRE_NOTHROW(api.add_specimen({{"specimen", good}}));
  const std::vector<std::pair<const char*, double>> wrong{{"modulus_guess_Pa", 2.0},
                                                          {"punch_diameter_m", 4.4},
                                                          {"rho_kg_m3", 1.1},
                                                          {"temperature_C", 5000.0}};
  for (const auto& [key, value] : wrong) {
    Json specimen = good;
    specimen[key] = value;
    INFO(key);
    const std::string text = test::error_text([&] { api.add_specimen({{"specimen", specimen}}); });
    INFO(text);
    CHECK(text.find("plausible are") != std::string::npos);
    const Json added = api.add_specimen({{"specimen", specimen}, {"plausible", "off"}});
    const std::string file = added.at("name").get<std::string>() + ".toml";
    CHECK(read_file(folder / file).find("plausible = \"off\"") == 0);
  }
  const Json deep{{"test", {{"depth_m", 0.13}}}};
  CHECK(test::error_text([&] { api.save_test(deep); }).find("plausible are") != std::string::npos);
  CHECK(test::error_text([&] {
          api.save_test({{"test", {{"depth_m", 0.13}}}, {"plausible", "maybe"}});
        }).find("use on") != std::string::npos);
}

}  // namespace
}  // namespace viscard
