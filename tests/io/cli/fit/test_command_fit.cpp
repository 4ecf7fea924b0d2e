#include "io/capture/capture_file.h"
#include "io/materials/material_file.h"
#include "tests/support/in_memory_run.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

class Folder : public ScratchFolder {
 public:
  std::string file(const std::string& name) const { return (*this / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
    return file(name);
  }
};

std::string relaxation_table() {
  std::ostringstream text;
  text.precision(12);
  text << "t,E_relax\ns, MPa\n";
  for (int i = 0; i <= 100; ++i) {
    const double t = std::pow(10.0, -2.0 + 4.0 * i / 100.0);
    // A remainder of the last digits in place of noise.
    text << t << "," << 1.6 + 0.2 * std::exp(-t / 3.0) + 1e-6 * ((7 * i) % 11) << "\n";
  }
  return text.str();
}

}  // namespace

TEST_CASE("a table with a row of units becomes JSON with the promised keys", "[cli]") {
  const Folder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  const auto ran = run_command({"fit", file, "--json"});
  CHECK(ran.err == "");
  REQUIRE(ran.status == kDone);
  const auto json = nlohmann::json::parse(ran.out);
  for (const char* key : {"E0_Pa", "E_inf_Pa", "E0_interval_95", "E_inf_interval_95", "terms",
                          "rss", "n_samples", "n_terms", "orders", "flags", "noise"}) {
    CHECK(json.contains(key));
  }
  CHECK(json["E0_Pa"].get<double>() == Approx(1.8e6).epsilon(1e-4));
  CHECK(json["n_samples"] == 101);
  REQUIRE(json["terms"].size() >= 1);
  for (const char* key :
       {"modulus_Pa", "g", "tau_s", "modulus_se_Pa", "ln_tau_se", "interval_95"}) {
    CHECK(json["terms"][0].contains(key));
  }
  for (const char* key : {"modulus_Pa", "g", "tau_s"}) {
    CHECK(json["terms"][0]["interval_95"].contains(key));
  }
  for (const char* key : {"n_terms", "rss", "aicc", "bic", "cv"})
    CHECK(json["orders"][0].contains(key));
  CHECK(json["noise"].contains("sigma"));
  CHECK(json["noise"].contains("inflation"));
}

TEST_CASE("a capture becomes a material file that names its raw data", "[cli]") {
  const Folder folder;
  CapturedRun captured = in_memory_run(demo_truth(13, 4), {});
  captured.specimen.id = "pdms-1to13";
  captured.specimen.rho_kg_m3 = 965.0;
  {
    CaptureWriter writer(folder.file("run.viscap"), captured);
    for (const LoadSample& sample : captured.load_samples) writer.append(sample);
    for (const CommandedMove& move : captured.moves) writer.append(move);
    writer.finish("finished");
  }
  const auto ran = run_command({"fit", folder.file("run.viscap"), "--out", folder.file("m.json")});
  CHECK(ran.err == "");
  REQUIRE(ran.status == kDone);
  CHECK_THAT(ran.out, Contains("E0") && Contains("MPa") && Contains("systematic"));
  const Material material = read_material(folder.file("m.json")).material;
  CHECK(material.name == "pdms-1to13");
  CHECK(material.E0_Pa == Approx(1.65e6).epsilon(0.01));
  CHECK(material.nu == 0.495);
  CHECK(material.rho_kg_m3 == 965.0);
  REQUIRE(material.terms.size() == 2);
  REQUIRE(material.uncertainty);
  CHECK(material.uncertainty->terms.size() == 2);
  CHECK(material.uncertainty->covariance.rows() == 5);
  REQUIRE(material.provenance.raw_files.size() == 1);
  CHECK(material.provenance.raw_files[0].sha256.size() == 64);
  CHECK(material.valid.t_max_s > 80.0);

  const auto again =
      run_command({"fit", folder.file("run.viscap"), "--out", folder.file("m.json")});
  CHECK(again.status == kFailed);
  CHECK_THAT(again.err, Contains("exists already") && Contains("--force"));
}

TEST_CASE("a column without header and a scaled one can be named", "[cli]") {
  const Folder folder;
  std::string text = relaxation_table();
  text = text.substr(text.find("MPa\n") + 4);
  const std::string file = folder.write("plain.csv", text);
  const auto ran =
      run_command({"fit", file, "--column", "time_s=1", "--column", "modulus_Pa=1e6*2", "--json"});
  CHECK(ran.err == "");
  REQUIRE(ran.status == kDone);
  CHECK(nlohmann::json::parse(ran.out)["E0_Pa"].get<double>() == Approx(1.8e6).epsilon(1e-4));
}

TEST_CASE("force and depth without geometry are called stiffness, and give no material", "[cli]") {
  const Folder folder;
  std::ostringstream text;
  text << "time_s,force_N,depth_m\n";
  for (int i = 0; i <= 400; ++i) {
    const double t = 0.05 * i;
    const double depth = 1e-4 * std::min(1.0, t);
    text << t << "," << 2.0e4 * depth * (1.0 + 1e-5 * ((7 * i) % 11)) << "," << depth << "\n";
  }
  const std::string file = folder.write("fd.csv", text.str());
  const auto plain = run_command({"fit", file, "--json"});
  REQUIRE(plain.status == kDone);
  const auto json = nlohmann::json::parse(plain.out);
  CHECK(json["K0_N_m"].get<double>() == Approx(2e4).epsilon(1e-3));
  CHECK_FALSE(json.contains("E0_Pa"));
  const auto refused = run_command({"fit", file, "--out", folder.file("m.json")});
  CHECK(refused.status == kFailed);
  CHECK(refused.out == "");  // refused before any work
  CHECK_THAT(refused.err, Contains("--punch-diameter"));
  const auto given = run_command({"fit", file, "--punch-diameter", "4.4 mm", "--layer-thickness",
                                  "11 mm", "--out", folder.file("m.json"), "--json"});
  CHECK(given.err == "");
  CHECK(given.status == kDone);
  CHECK(nlohmann::json::parse(given.out).contains("E0_Pa"));
}

TEST_CASE("wrong words give one line and exit status 2", "[cli]") {
  const Folder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"fit"}, "which file?"},
      {{"fit", file, "--term", "3"}, "did you mean '--terms'"},
      {{"fit", file, "--terms", "-1"}, "outside 0 to 100"},
      {{"fit", file, "--terms", "two"}, "two"},
      {{"fit", file, "--kind", "relaxtion"}, "did you mean 'relaxation'"},
      {{"fit", file, "--noise", "pink"}, "auto or white"},
      {{"fit", file, "--punch-diameter", "4.4 kg"}, "--punch-diameter"},
      {{"fit", file, "--layer-thickness", "1 mm"}, "need --punch-diameter"},
      {{"fit", file, "--column", "modulus=2"}, "modulus"},
      {{"fit", file, "--bootstrap", "5"}, "outside 20 to 100000"},
      {{"fit", file, "--liquid", "--terms", "0"}, "at least one term"},
      {{"fit", file, file, "--out", folder.file("m.json")}, "one input file"}};
  for (const auto& [words, expected] : cases) {
    const auto ran = run_command(words);
    CAPTURE(ran.err);
    CHECK(ran.status == kBadWords);
    CHECK(ran.out == "");
    CHECK_THAT(ran.err, Contains(expected));
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
  }
}

TEST_CASE("data that cannot be fitted give one line with the file and exit status 1", "[cli]") {
  const Folder folder;
  const std::vector<std::pair<std::string, std::string>> cases{
      {folder.file("missing.csv"), "missing.csv"},
      {folder.write("two.csv", "time_s,modulus_Pa\n0,1\n1,0.9\n"), "at least 4"},
      {folder.write("text.csv", "time_s,modulus_Pa\n0,1\n1,abc\n2,1\n3,1\n4,1\n"), "abc"},
      {folder.write("other.csv", "a,b\n0,1\n1,2\n2,3\n3,4\n"), "--column"}};
  for (const auto& [file, expected] : cases) {
    const auto ran = run_command({"fit", file});
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
  const Folder folder;
  const auto all = [](double) { return true; };
  const auto as_is = [](double, double force) { return force; };
  SECTION("refusals") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"time_s,modulus_Pa\n0,nan\n1,nan\n2,nan\n3,nan\n4,nan\n", "nan"},
        {pressed_table([](double, double) { return 0.5; }, all), "constant"},
        {pressed_table([](double, double force) { return -force; }, all), "--column force_N=-NAME"},
        {"time_s,force_N,depth_m\n0,0,0\n1,1,1e-4\n", "at least"}};
    for (const auto& [table, expected] : cases) {
      const auto ran = run_command({"fit", folder.write("bad.csv", table)});
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
      const auto ran = run_command({"fit", folder.write("bad.csv", table), "--json"});
      CHECK(ran.status == kFailed);
      CHECK_THAT(ran.err, Contains("not to be trusted"));
      const auto json = nlohmann::json::parse(ran.out);
      CHECK_FALSE(json["trustworthy"].get<bool>());
      CHECK_THAT(json["flags"].dump(), Contains(flag));
    }
  }
}

TEST_CASE("profiles and a bootstrap are part of the JSON when asked for", "[cli]") {
  const Folder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  const auto ran =
      run_command({"fit", file, "--profiles", "--bootstrap", "40", "--terms", "1", "--json"});
  CHECK(ran.err == "");
  REQUIRE(ran.status == kDone);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json["n_bootstrap"] == 40);
  REQUIRE(json["profiles"].size() == 2);
  CHECK(json["profiles"][1]["parameter"] == "ln_tau_1");
  CHECK(json["profiles"][1]["value"].size() == json["profiles"][1]["rise"].size());
}

TEST_CASE("several files are fitted together, in their order", "[cli]") {
  const Folder folder;
  const std::string a = folder.write("a.csv", relaxation_table());
  const std::string b = folder.write("b.csv", relaxation_table());
  const auto ran = run_command({"fit", b, a, "--json"});
  REQUIRE(ran.status == kDone);
  const auto json = nlohmann::json::parse(ran.out);
  REQUIRE(json["fits"].size() == 2);
  CHECK(json["fits"][0]["file"] == b);
  CHECK(json["fits"][0]["E0_Pa"] == json["fits"][1]["E0_Pa"]);
}

TEST_CASE("what is called a capture and is none is not taken for a table", "[cli]") {
  const Folder folder;
  const std::string file = folder.write("run.viscap", "SQLxte format 3\n0.1,0.2\n0.3,0.4\n");
  const auto ran = run_command({"fit", file});
  CHECK(ran.status == kFailed);
  CHECK_THAT(ran.err, Contains(file) && Contains("not a capture") && !Contains("column"));
}

TEST_CASE("a series is compared with a power law where asked, and only where it can be", "[cli]") {
  const Folder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  const auto ran = run_command({"fit", file, "--diagnose", "--json"});
  REQUIRE(ran.status == kDone);
  const auto fractional = nlohmann::json::parse(ran.out).at("fractional_zener");
  CHECK(fractional.at("alpha").get<double>() == Approx(1.0).margin(0.01));  // one term
  CHECK(fractional.at("tau_s").get<double>() == Approx(3.0).epsilon(0.02));
  const std::string creep =
      folder.write("J.csv", "time_s,compliance_1_Pa\n0.1,1e-6\n1,1.1e-6\n10,1.2e-6\n100,1.21e-6\n");
  const auto refused = run_command({"fit", creep, "--diagnose"});
  CHECK(refused.status == kFailed);
  CHECK_THAT(refused.err, Contains("--diagnose compares relaxation"));
}

TEST_CASE("a density or ratio that cannot be is refused before the fit", "[cli]") {
  const Folder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--density", "-5 kg/m3"}, {"--ratio", "0"}, {"--ratio", "-10"}}) {
    std::vector<std::string> line{"fit", file, "--out", folder.file("m.json")};
    line.insert(line.end(), words.begin(), words.end());
    const auto ran = run_command(line);
    CAPTURE(words, ran.err);
    CHECK(ran.status == kBadWords);
    CHECK_THAT(ran.err, Contains(words[0] + " must be positive"));
    CHECK(ran.out.empty());
    CHECK_FALSE(std::filesystem::exists(folder.file("m.json")));
  }
}
