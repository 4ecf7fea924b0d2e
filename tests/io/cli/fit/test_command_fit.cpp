#include "io/capture/capture_file.h"
#include "io/materials/material_file.h"
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/in_memory_run.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <random>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

TEST_CASE("a table with a row of units becomes JSON with the promised keys", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  const CommandOutcome ran = run_command({"fit", file, "--json"});
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
  const TableFolder folder;
  CapturedRun captured = in_memory_run(demo_truth(13, 4), {});
  captured.specimen.id = "pdms-1to13";
  captured.specimen.rho_kg_m3 = 965.0;
  {
    CaptureWriter writer(folder.file("run.viscap"), captured);
    for (const LoadSample& sample : captured.load_samples) writer.append(sample);
    for (const CommandedMove& move : captured.moves) writer.append(move);
    writer.finish("finished");
  }
  const CommandOutcome ran =
      run_command({"fit", folder.file("run.viscap"), "--out", folder.file("m.json")});
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

  const CommandOutcome again =
      run_command({"fit", folder.file("run.viscap"), "--out", folder.file("m.json")});
  CHECK(again.status == kFailed);
  CHECK_THAT(again.err, Contains("exists already") && Contains("--force"));
}

TEST_CASE("a column without header and a scaled one can be named", "[cli]") {
  const TableFolder folder;
  std::string text = relaxation_table();
  text = text.substr(text.find("MPa\n") + 4);
  const std::string file = folder.write("plain.csv", text);
  const CommandOutcome ran =
      run_command({"fit", file, "--column", "time_s=1", "--column", "modulus_Pa=1e6*2", "--json"});
  CHECK(ran.err == "");
  REQUIRE(ran.status == kDone);
  CHECK(nlohmann::json::parse(ran.out)["E0_Pa"].get<double>() == Approx(1.8e6).epsilon(1e-4));
}

TEST_CASE("force and depth without geometry are called stiffness, and give no material", "[cli]") {
  const TableFolder folder;
  std::ostringstream text;
  text << "time_s,force_N,depth_m\n";
  for (int i = 0; i <= 400; ++i) {
    const double t = 0.05 * i;
    const double depth = 1e-4 * std::min(1.0, t);
    text << t << "," << 2.0e4 * depth * (1.0 + 1e-5 * ((7 * i) % 11)) << "," << depth << "\n";
  }
  const std::string file = folder.write("fd.csv", text.str());
  const CommandOutcome plain = run_command({"fit", file, "--json"});
  REQUIRE(plain.status == kDone);
  const auto json = nlohmann::json::parse(plain.out);
  CHECK(json["K0_N_m"].get<double>() == Approx(2e4).epsilon(1e-3));
  CHECK_FALSE(json.contains("E0_Pa"));
  const CommandOutcome refused = run_command({"fit", file, "--out", folder.file("m.json")});
  CHECK(refused.status == kFailed);
  CHECK(refused.out == "");  // refused before any work
  CHECK_THAT(refused.err, Contains("--punch-diameter"));
  const CommandOutcome given =
      run_command({"fit", file, "--punch-diameter", "4.4 mm", "--layer-thickness", "11 mm", "--out",
                   folder.file("m.json"), "--json"});
  CHECK(given.err == "");
  CHECK(given.status == kDone);
  CHECK(nlohmann::json::parse(given.out).contains("E0_Pa"));
}

TEST_CASE("profiles and a bootstrap are part of the JSON when asked for", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  const CommandOutcome ran =
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
  const TableFolder folder;
  const std::string a = folder.write("a.csv", relaxation_table());
  const std::string b = folder.write("b.csv", relaxation_table());
  const CommandOutcome ran = run_command({"fit", b, a, "--json"});
  REQUIRE(ran.status == kDone);
  const auto json = nlohmann::json::parse(ran.out);
  REQUIRE(json["fits"].size() == 2);
  CHECK(json["fits"][0]["file"] == b);
  CHECK(json["fits"][0]["E0_Pa"] == json["fits"][1]["E0_Pa"]);
}

TEST_CASE("fit --diagnose compares tables with laws of few parameters, and refuses captures",
          "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("E.csv", relaxation_table());
  const CommandOutcome ran = run_command({"fit", file, "--diagnose", "--json"});
  REQUIRE(ran.status == kDone);
  const auto fractional = nlohmann::json::parse(ran.out).at("fractional_zener");
  CHECK(fractional.at("alpha").get<double>() == Approx(1.0).margin(0.01));  // one term
  CHECK(fractional.at("tau_s").get<double>() == Approx(3.0).epsilon(0.02));
  const std::string creep =
      folder.write("J.csv", "time_s,compliance_1_Pa\n0.1,1e-6\n1,1.1e-6\n10,1.2e-6\n100,1.21e-6\n");
  const auto laws = nlohmann::json::parse(run_command({"fit", creep, "--diagnose", "--json"}).out);
  REQUIRE(laws.at("laws").size() == 5);
  for (const auto& law : laws["laws"]) {
    for (const char* key : {"name", "n_parameters", "rss", "bic", "bic_difference", "at_bound",
                            "parameters", "series"}) {
      CHECK(law.contains(key));
    }
  }
  CHECK_FALSE(laws.contains("fractional_zener"));
  CHECK_THAT(run_command({"fit", creep, "--diagnose"}).out,
             Contains("BIC minus that of series") && Contains("springpot"));
  const CapturedRun captured = in_memory_run(demo_truth(13, 4), {});
  {
    CaptureWriter writer(folder.file("run.viscap"), captured);
    for (const LoadSample& sample : captured.load_samples) writer.append(sample);
    for (const CommandedMove& move : captured.moves) writer.append(move);
    writer.finish("finished");
  }
  const CommandOutcome refused = run_command({"fit", folder.file("run.viscap"), "--diagnose"});
  CHECK(refused.status == kFailed);
  CHECK_THAT(refused.err, Contains("--diagnose compares laws") && Contains("viscard export"));
}

TEST_CASE("the material of a law is valid where its series was compared with the law", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write(
      "E.csv", "time_s,modulus_Pa\n0,2e6\n0.1,1.9e6\n1,1.8e6\n10,1.75e6\n100,1.7e6\n1000,1.69e6\n");
  REQUIRE(run_command({"fit", file, "--model", "fractional-zener", "--out", folder.file("m.json")})
              .status == kDone);
  const Material material = read_material(folder.file("m.json")).material;
  CHECK(material.valid.t_min_s == Approx(0.1));
  CHECK(material.valid.t_max_s == Approx(1000.0));
}

TEST_CASE("fit --model answers with a law, and its card states the error of its series", "[cli]") {
  const TableFolder folder;
  std::ostringstream text;
  text.precision(12);
  text << "time_s,modulus_Pa\n";
  for (int i = 0; i <= 200; ++i) {
    const double t = std::pow(10.0, -2.0 + 5.0 * i / 200.0);
    text << t << "," << 1e6 + 2e6 * std::exp(-std::pow(t / 3.0, 0.45)) + ((7 * i) % 11) - 5.0
         << "\n";
  }
  const std::string file = folder.write("E.csv", text.str());
  const CommandOutcome ran =
      run_command({"fit", file, "--model", "kww", "--json", "--out", folder.file("m.json")});
  CHECK(ran.err == "");
  REQUIRE(ran.status == kDone);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json["model"] == "kww");
  CHECK(json["laws"][0]["name"] == "kww");
  CHECK(json["laws"][0]["parameters"]["beta"]["value"].get<double>() == Approx(0.45).epsilon(1e-3));
  CHECK(json["laws"][0]["parameters"]["beta"]["interval_95"].size() == 2);
  CHECK(json["laws"][0]["series"]["largest_error"].get<double>() < 1e-3);
  CHECK(json["n_terms"] == json["terms"].size());
  const CommandOutcome card = run_command({"card", folder.file("m.json"), "--for", "csv"});
  REQUIRE(card.status == kDone);
  CHECK_THAT(card.out, Contains("the law kww") && Contains("% from 0.01 s to 1000 s"));
  const CommandOutcome misspelt = run_command({"fit", file, "--model", "springpots"});
  CHECK(misspelt.status == kBadWords);
  CHECK_THAT(misspelt.err, Contains("did you mean 'springpot'?"));
  const CommandOutcome terms = run_command({"fit", file, "--model", "kww", "--terms", "2"});
  CHECK(terms.status == kBadWords);
  CHECK_THAT(terms.err, Contains("a law has no terms"));
  CHECK(run_command({"fit", file, "--model", "kww", "--joint", "--ratio", "10"}).status ==
        kBadWords);
}

TEST_CASE("rows that are not fitted are counted by reason in text and JSON", "[cli]") {
  const TableFolder folder;
  std::string text = relaxation_table();
  text += "-2,1.8\n-1,1.8\n";
  const std::string file = folder.write("E.csv", text);
  const CommandOutcome ran = run_command({"fit", file, "--json"});
  REQUIRE(ran.status == kDone);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json["n_rows"] == 103);
  CHECK(json["n_samples"] == 101);
  CHECK(json["n_left_out"] == 2);
  CHECK(json["left_out"] == nlohmann::json{{"before_zero", 2}});
  CHECK_THAT(run_command({"fit", file}).out,
             Contains("2 of 103 rows left out: 2 rows before t = 0"));
}

TEST_CASE("an oscillation states E' at its highest frequency beside E0", "[cli]") {
  const TableFolder folder;
  std::ostringstream table;
  table << "frequency_Hz,storage_modulus_Pa,loss_modulus_Pa\n";
  for (int i = 0; i <= 30; ++i) {  // 1 MPa and 0.5 MPa at 0.01 s, to 10 Hz
    const double f = std::pow(10.0, -1.0 + i / 15.0), x = 0.02 * 3.141592653589793 * f;
    const double off = 1.0 + 1e-3 * ((7 * i) % 11 - 5);
    table << f << "," << 1e6 + 5e5 * off * x * x / (1.0 + x * x) << ","
          << 5e5 * off * x / (1.0 + x * x) << "\n";
  }
  const std::string file = folder.write("sweep.csv", table.str());
  const auto json = nlohmann::json::parse(run_command({"fit", file, "--json"}).out);
  CHECK(json["highest_frequency_Hz"].get<double>() == Approx(10.0));
  CHECK(json["E_storage_highest_Pa"].get<double>() == Approx(1.1415e6).epsilon(0.002));
  CHECK(json["E_storage_highest_interval_95"].size() == 2);
  CHECK_FALSE(json.contains("first_sample_s"));
  CHECK_THAT(run_command({"fit", file}).out,
             Contains("E'(f_n)") && Contains("at the highest frequency, f_n = 10 Hz"));
}

TEST_CASE("a drift is fitted by itself, on request or never, and a misfit gets no card", "[cli]") {
  const TableFolder folder;
  std::ostringstream table;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  table << "time_s,modulus_Pa\n";
  for (int i = 1; i <= 1500; ++i) {  // up by 5 % of E_inf in 300 s
    const double t = 0.2 * i;
    table << t << ","
          << 1e6 * (1.0 + 0.3 * std::exp(-t / 5.0) + 0.05 * t / 300.0 + 2e-3 * normal(random))
          << "\n";
  }
  const std::string file = folder.write("E.csv", table.str());
  const CommandOutcome ran = run_command({"fit", file, "--json"});
  REQUIRE(ran.status == kDone);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json["drift"]["per_s"].get<double>() == Approx(0.05e6 / 300.0).epsilon(0.05));
  CHECK(json["drift"]["unit"] == "Pa/s");
  CHECK(json["lack_of_fit"]["significant"] == false);
  CHECK(json["E_inf_Pa"].get<double>() == Approx(1e6).epsilon(0.003));
  CHECK(json["first_sample_s"] == 0.2);
  CHECK(json["E_first_sample_Pa"].get<double>() < json["E0_Pa"].get<double>());
  CHECK(json.contains("E_first_sample_interval_95"));
  CHECK_THAT(run_command({"fit", file, "--drift"}).out,
             Contains("drift") && Contains("at the first sample"));

  const CommandOutcome plain =
      run_command({"fit", file, "--no-drift", "--out", folder.file("m.json")});
  CHECK(plain.status == kFailed);
  CHECK_THAT(plain.err, Contains("not to be trusted"));
  const CommandOutcome card = run_command(
      {"card", folder.file("m.json"), "--for", "abaqus", "--out", folder.file("m.inp")});
  CHECK(card.status == kFailed);
  CHECK_THAT(card.err, Contains("misfit"));
  CHECK(run_command({"fit", file, "--drift", "--no-drift"}).status == kBadWords);
}
