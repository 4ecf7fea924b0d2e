// Tests of rubber at large strain: viscard fit uniaxial=a.csv planar=b.csv equibiaxial=c.csv.
#include "models/hyperelastic/finite_viscoelasticity.h"
#include "models/hyperelastic/foam_law.h"
#include "models/hyperelastic/mullins_damage.h"
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

std::string treloar(const std::string& name) {
  return std::string(VISCARD_SOURCE_DIR) + "/data/reference/treloar_" + name + ".csv";
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A Neo-Hooke rubber of 0.4 MPa: nominal strain in %, stress in kPa, both counted positive.
std::string compression_table() {
  std::ostringstream table;
  table << "strain [%],stress [kPa]\n";
  for (int i = 0; i <= 20; ++i) {
    const double s = 1.0 - 0.02 * i;
    table << 2 * i << "," << 400.0 * (1.0 / (s * s) - s) << "\n";
  }
  return table.str();
}

// A Neo-Hooke rubber with one term: loading to a stretch of 2 in 1 s, and a hold of 20 s.
std::string hold_table(bool with_times) {
  Course history;
  for (int i = 0; i <= 210; ++i) history.push_back({0.1 * i, std::min(2.0, 1.0 + 0.1 * i)});
  const HyperelasticLaw law{HyperelasticForm::kNeoHooke, Eigen::VectorXd::Constant(1, 2e5), {}};
  const auto stress_Pa = nominal_stress_Pa(law, {{0.25, 1.5}}, Deformation::kUniaxial, history);
  std::ostringstream table;
  table.precision(10);
  table << (with_times ? "time_s," : "") << "stretch,nominal_stress_Pa\n";
  for (std::size_t i = 0; i < stress_Pa.size(); ++i) {
    if (with_times) table << history[i].time_s << ",";
    const double noise_Pa = 200.0 * std::sin(12.9898 * static_cast<double>(i * i + 1));
    table << history[i].value << "," << stress_Pa[i] + noise_Pa << "\n";
  }
  return table.str();
}

}  // namespace

TEST_CASE("tables with times give terms of relaxation beside the law", "[cli]") {
  const TableFolder folder;
  const std::string word = "uniaxial=" + folder.write("hold.csv", hold_table(true));
  const std::string out = folder.file("rubber.json"), svg = folder.file("rubber.svg");
  const auto printed =
      run_command({"fit", word, "--model", "neo-hooke", "--json", "--out", out, "--svg", svg});
  INFO(printed.err);
  CHECK(printed.status == 0);
  const auto json = nlohmann::json::parse(printed.out);
  const auto& law = json["laws"][0];
  REQUIRE(law["terms"].size() == 1);
  CHECK(law["terms"][0]["g"].get<double>() == Approx(0.25).epsilon(0.02));
  CHECK(law["terms"][0]["tau_s"].get<double>() == Approx(1.5).epsilon(0.05));
  CHECK(law["E0_Pa"].get<double>() == Approx(1.2e6).epsilon(0.01));
  CHECK(law["E_inf_Pa"].get<double>() == Approx(0.9e6).epsilon(0.01));
  CHECK(law["series_covariance"].size() == 3);
  CHECK_THAT(text_of_file(svg),
             Contains("with 1 term") && Contains("time since the first reading"));
  CHECK(nlohmann::json::parse(text_of_file(out))["laws"][0]["terms"].size() == 1);

  const auto text = run_command({"fit", word, "--model", "neo-hooke"});
  CHECK_THAT(text.out, Contains("* neo-hooke + 1") && Contains("E_inf") && Contains("tau_1_s"));

  const auto card = run_command({"card", out, "--for", "abaqus"});
  CHECK(card.status == 0);
  CHECK_THAT(card.out, Contains("** 1 term of relaxation: Young's modulus at rest") &&
                           Contains("** terms: the law at once") &&
                           Contains("*HYPERELASTIC, NEO HOOKE, MODULI=INSTANTANEOUS") &&
                           Contains("*VISCOELASTIC, TIME=PRONY"));
  const std::string written_card = folder.write("card.inp", card.out);
  const auto same = run_command({"card", out, "--check", written_card});
  CHECK(same.status == 0);
  CHECK_THAT(same.out, Contains("neo-hooke for abaqus, units SI") &&
                           Contains("the card agrees with the law"));
  std::string wrong_card = card.out;
  wrong_card.erase(wrong_card.find(", MODULI=INSTANTANEOUS"), 22);
  const auto wrong = run_command({"card", out, "--check", folder.write("wrong.inp", wrong_card)});
  CHECK(wrong.status == 1);
  CHECK_THAT(wrong.out,
             Contains("mistake instantaneous-for-long-term") && Contains("the card is wrong"));
  // Without the law only the card's own mistakes are found.
  const auto alone = run_command({"card", "--check", written_card, "--json"});
  CHECK(alone.status == 0);
  CHECK(nlohmann::json::parse(alone.out)["difference"].is_null());
  CHECK(nlohmann::json::parse(alone.out)["basis"] == "instantaneous");
  // A card does not leave the terms out silently.
  const auto refused = run_command({"card", out, "--for", "calculix", "--units", "mm-t-s"});
  CHECK(refused.status != 0);
  CHECK_THAT(refused.err, Contains("no Prony series beside *HYPERELASTIC") &&
                              Contains("--elastic-only long-term"));
  const auto elastic = run_command({"card", out, "--for", "calculix", "--units", "mm-t-s",
                                    "--elastic-only", "long-term", "--json"});
  CHECK(elastic.status == 0);
  const auto written = nlohmann::json::parse(elastic.out);
  CHECK(written["terms"] == 0);
  CHECK(written["E_inf_Pa"] == law["E_inf_Pa"]);
  CHECK_THAT(
      written["card"].get<std::string>(),
      Contains("** elastic: 1 term of relaxation left out, the law after all relaxation kept"));
}

TEST_CASE("the fit with --terms 0 is that of the same table without times", "[cli][reduction]") {
  const TableFolder folder;
  const std::string timed = "uniaxial=" + folder.write("timed.csv", hold_table(true));
  const std::string plain = "uniaxial=" + folder.write("plain.csv", hold_table(false));
  const auto laws_of = [](const std::vector<std::string>& words) {
    return nlohmann::json::parse(run_command(words).out)["laws"].dump();
  };
  CHECK(laws_of({"fit", timed, "--terms", "0", "--json"}) == laws_of({"fit", plain, "--json"}));
  const auto asked = run_command({"fit", plain, "--terms", "1"});
  CHECK(asked.status == 1);
  CHECK_THAT(asked.err, Contains("the uniaxial test has no times") && Contains("column time_s"));
  const auto many = run_command({"fit", timed, "--terms", "21"});
  CHECK(many.status == 2);
  CHECK_THAT(many.err, Contains("--terms 21 is outside 0 to 20"));
  const auto both = run_command({"fit", timed, "--terms", "2", "--max-terms", "1"});
  CHECK(both.status == 2);
  CHECK_THAT(both.err, Contains("--max-terms is for the choice of a number of terms"));
}

TEST_CASE("a known modulus is that at once or E_inf", "[cli]") {
  const TableFolder folder;
  const std::string word = "uniaxial=" + folder.write("hold.csv", hold_table(true));
  const auto law_with = [&](const std::string& modulus) {
    const auto run = run_command({"fit", word, "--model", "mooney-rivlin", "--terms", "1",
                                  "--youngs-modulus", modulus, "--json"});
    return nlohmann::json::parse(run.out)["laws"][0];
  };
  CHECK(law_with("1.1 MPa")["E0_Pa"].get<double>() == Approx(1.1e6).epsilon(1e-6));
  CHECK(law_with("E0 = 1.1 MPa")["E0_Pa"].get<double>() == Approx(1.1e6).epsilon(1e-6));
  CHECK(law_with("E_inf=0.8 MPa")["E_inf_Pa"].get<double>() == Approx(0.8e6).epsilon(1e-6));
  const auto wrong = run_command({"fit", word, "--youngs-modulus", "E_1=1 MPa"});
  CHECK(wrong.status == 2);
  CHECK_THAT(wrong.err, Contains("'E_1' is neither E0 nor E_inf"));
}

TEST_CASE("three tests at large strain give laws, a file and a picture", "[cli]") {
  const TableFolder folder;
  const std::string out = folder.file("rubber.json"), svg = folder.file("rubber.svg");
  const std::vector<std::string> words{"fit", "uniaxial=" + treloar("uniaxial"),
                                       "planar=" + treloar("planar"),
                                       "equibiaxial=" + treloar("equibiaxial")};
  auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return run_command(more);
  };
  const auto text = with({"--out", out, "--svg", svg});
  CHECK(text.status == 0);
  CHECK_THAT(text.out, Contains("3 tests at large strain, 56 readings"));
  CHECK_THAT(text.out, Contains("* ogden-3"));
  CHECK_THAT(text_of_file(svg), Contains("<svg") && Contains("equibiaxial, measured"));

  const auto printed = with({"--json"});
  const auto json = nlohmann::json::parse(printed.out);
  CHECK(json["law"] == "ogden-3");
  CHECK(json["trustworthy"] == true);
  REQUIRE(json["laws"].size() == 8);
  CHECK(json["laws"][5]["rss_Pa2"].get<double>() == Approx(0.2048079328e12).epsilon(1e-6));
  CHECK(json["laws"][5]["parameters"][0]["name"] == "mu_1_Pa");
  CHECK(json["laws"][7]["stable_stretch"]["uniaxial"][0].is_null());
  CHECK(json["laws"][7]["stable_stretch"]["uniaxial"][1].get<double>() > 7.6);
  CHECK(json["tests"][1]["deformation"] == "planar");
  CHECK(json["laws"] == nlohmann::json::parse(text_of_file(out))["laws"]);

  CHECK_THAT(with({"--out", out}).err, Contains("exists"));

  const auto card = run_command({"card", out, "--for", "abaqus", "--units", "mm-t-s"});
  CHECK(card.status == 0);
  CHECK_THAT(card.out, Contains("*HYPERELASTIC, OGDEN, N=3") &&
                           Contains("** equibiaxial: stretches 1 to 4.45 measured") &&
                           Contains("sha256"));
  const auto other = run_command({"card", out, "--for", "sofa"});
  CHECK(other.status == 2);
  CHECK_THAT(other.err, Contains("has no card of rubber"));
}

TEST_CASE("compression that is counted positive, in percent, gives the modulus at rest", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("press.csv", compression_table());
  const auto run = run_command({"fit", "compression=" + file, "--model", "neo-hooke", "--json"});
  INFO(run.err);
  CHECK(run.status == 0);
  const auto json = nlohmann::json::parse(run.out);
  CHECK(json["laws"][0]["E0_Pa"].get<double>() == Approx(1.2e6).epsilon(1e-6));
  CHECK(json["tests"][0]["stretch"][0].get<double>() == Approx(0.6));
  CHECK(json["flags"][0]["name"] == "one-deformation");
}

TEST_CASE("a law that misses the data at large strain ends with status 1", "[cli]") {
  const auto run = run_command({"fit", "uniaxial=" + treloar("uniaxial"),
                                "equibiaxial=" + treloar("equibiaxial"), "--model", "neo-hooke"});
  CHECK(run.status == 1);
  CHECK_THAT(run.err, Contains("not to be trusted") && Contains("misses the stresses by"));
}

TEST_CASE("words that do not fit tests at large strain are refused", "[cli]") {
  const std::string uniaxial = "uniaxial=" + treloar("uniaxial");
  const auto refused = [&](std::vector<std::string> more, const std::string& reason) {
    more.insert(more.begin(), {"fit", uniaxial});
    const auto run = run_command(more);
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains(reason));
  };
  refused({"--drift"}, "--drift does not belong to tests at large strain");
  refused({"--model", "ogden3"}, "did you mean 'ogden-3'");
  refused({"--weight", "square"}, "use equal or relative");
  refused({"--youngs-modulus", "3 N"}, "--youngs-modulus 3 N");
  refused({"creep=b.csv"}, "is no test at large strain");
  refused({"planar="}, "names no file");
  const auto timeless = run_command({"fit", uniaxial, "--terms", "3"});
  CHECK(timeless.status == 1);
  CHECK_THAT(timeless.err, Contains("has no times") && Contains("add a column time_s"));
  CHECK(run_command({"fit", uniaxial, "uniaxial=" + treloar("uniaxial")}).status == 1);
  const auto cycle = run_command({"fit", treloar("uniaxial"), "--cycle", "1"});
  CHECK(cycle.status == 2);
  CHECK_THAT(cycle.err, Contains("--cycle is for tests at large strain"));
}

TEST_CASE("a table without stretch or stress is refused with its columns", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("a.csv", "time_s,force_N\n0,0\n1,2\n2,3\n3,5\n");
  const auto run = run_command({"fit", "planar=" + file});
  CHECK(run.status == 1);
  CHECK_THAT(run.err, Contains("no column of the stretch or the nominal strain") &&
                          Contains("'force_N'") && Contains("--column stretch="));
  // Without its kind it is no relaxation: nothing is proposed that would fit it as one.
  for (const char* header :
       {"stretch,stress_MPa", "strain,stress_MPa", "Streckung,Spannung [MPa]"}) {
    const auto curve = folder.write(
        "c.csv", std::string(header) + "\n1,0\n1.1,0.1\n1.2,0.19\n1.4,0.33\n1.7,0.5\n");
    const auto bare = run_command({"fit", curve});
    CHECK(bare.status == 1);
    CHECK_THAT(bare.err, Contains("uniaxial=" + curve) && !Contains("--column"));
  }
  const auto mixed = folder.write("b.csv", "strain,stress_Pa\n-0.2,1\n0.1,2\n0.3,3\n3,5\n");
  CHECK_THAT(run_command({"fit", "compression=" + mixed}).err, Contains("stretches below 1"));
}

TEST_CASE("of a record with cycles at large strain one loading is fitted", "[cli]") {
  const TableFolder folder;
  std::ostringstream table;
  table << "stretch,nominal_stress_Pa\n";
  for (int cycle = 0; cycle < 2; ++cycle) {
    for (int i = 0; i <= 40; ++i) {
      const double s = 1.0 + 0.05 * (i <= 20 ? i : 40 - i);
      table << s << "," << (cycle == 0 ? 2e5 : 1.6e5) * (s - 1.0 / (s * s)) << "\n";
    }
  }
  const std::string word = "uniaxial=" + folder.write("cycles.csv", table.str());
  const auto run = run_command({"fit", word, "--model", "neo-hooke"});
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("the loading of cycle 2 of 2 is fitted; 61 rows left out") &&
                          Contains("softens by 20 %") &&
                          Contains("fit the softening with --model neo-hooke+mullins-or"));
  const auto first = nlohmann::json::parse(
      run_command({"fit", word, "--model", "neo-hooke", "--cycle", "1", "--json"}).out);
  CHECK(first["laws"][0]["E0_Pa"].get<double>() == Approx(6e5).epsilon(1e-6));
  CHECK(first["tests"][0]["softening"].get<double>() == Approx(0.2));
  CHECK_THAT(run_command({"fit", word, "--cycle", "3"}).err, Contains("has 2 cycles of loading"));
  CHECK(run_command({"fit", word, "--cycle", "0"}).status == 2);
}

TEST_CASE("a record of cycles gives the damage of its first loading, which goes into a card",
          "[cli][mullins]") {
  const TableFolder folder;
  const HyperelasticLaw law{HyperelasticForm::kNeoHooke, Eigen::VectorXd::Constant(1, 0.3e6), {}};
  std::vector<double> stretch;
  for (const double top : {1.4, 1.8}) {
    for (int i = 0; i <= 80; ++i)
      stretch.push_back(1.0 + (top - 1.0) * (i <= 40 ? i : 80 - i) / 40);
  }
  const auto stress_Pa =
      nominal_stress_Pa(law, MullinsDamage{1.5, 2e4, 0.2}, Deformation::kUniaxial, stretch);
  std::ostringstream table;
  table.precision(12);
  table << "time_s,stretch,nominal_stress_Pa\n";
  for (std::size_t i = 0; i < stretch.size(); ++i)
    table << i << "," << stretch[i] << "," << stress_Pa[i] << "\n";
  const std::string word = "uniaxial=" + folder.write("cycles.csv", table.str());
  const std::string made = folder.file("rubber.json"), card = folder.file("rubber.inp");
  const auto run =
      run_command({"fit", word, "--model", "neo-hooke+mullins-or", "--out", made, "--json"});
  REQUIRE(run.status == 0);
  const auto json = nlohmann::json::parse(run.out);
  const auto& damage = json["laws"][0]["damage"];
  const double truth[] = {1.5, 2e4, 0.2};
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(damage["parameters"][k]["value"].get<double>() == Approx(truth[k]).epsilon(1e-4));
  CHECK(damage["covariance"].size() == 4);
  CHECK(damage["misfit_reloading"].get<double>() < 1e-6);
  CHECK_FALSE(damage["one_maximum"].get<bool>());
  CHECK(json["tests"][0]["cycle"] == 0);
  CHECK(json["tests"][0]["n_left_out"] == 0);
  CHECK(json["laws"][0]["terms"].empty());
  // The file makes a card, the card is checked against it, and comes back as a file.
  REQUIRE(
      run_command({"card", made, "--for", "abaqus", "--units", "mm-t-s", "--out", card}).status ==
      0);
  CHECK_THAT(text_of_file(card), Contains("*MULLINS EFFECT\n"));
  CHECK(run_command({"card", made, "--check", card}).status == 0);
  const std::string back = folder.file("back.json");
  REQUIRE(run_command({"card", card, "--import", back}).status == 0);
  CHECK_THAT(text_of_file(back), Contains("mullins-or"));
  // Other doors say what they cannot do with it.
  const auto calculix = run_command({"card", made, "--for", "calculix"});
  CHECK(calculix.status != 0);
  CHECK_THAT(calculix.err, Contains("calculix cannot take the damage mullins-or"));
  // All laws with it; text.
  const auto all = run_command({"fit", word, "--model", "mullins-or"});
  CHECK(all.status == 0);
  CHECK_THAT(all.out, Contains("neo-hooke+mullins-or") && Contains("damage by the first loading") &&
                          Contains("reloading"));
  const auto refused = [&](std::vector<std::string> more, const std::string& reason) {
    more.insert(more.begin(), {"fit", word});
    const auto wrong = run_command(more);
    CHECK(wrong.status == 2);
    CHECK_THAT(wrong.err, Contains(reason));
  };
  refused({"--model", "neo-hooke+mullins-or", "--cycle", "1"}, "needs the whole record");
  refused({"--model", "yeoh+mullins-or", "--terms", "2"}, "do not stand beside mullins-or");
  refused({"--model", "yeo+mullins-or"}, "did you mean 'yeoh'");
  const auto virgin =
      run_command({"fit", "uniaxial=" + treloar("uniaxial"), "--model", "yeoh+mullins-or"});
  CHECK(virgin.status == 1);
  CHECK_THAT(virgin.err, Contains("leave mullins-or out of --model"));
}

TEST_CASE("tests of a foam give its law, a file and cards", "[cli][foam]") {
  const TableFolder folder;
  FoamLaw law{Eigen::VectorXd::Constant(1, 5e4), Eigen::VectorXd::Constant(1, 8.0),
              Eigen::VectorXd::Constant(1, 0.2)};
  std::ostringstream sides, pressures, shear;
  for (std::ostringstream* table : {&sides, &pressures, &shear}) table->precision(12);
  sides << "strain,lateral_strain,nominal_stress_kPa\n";
  pressures << "volume_ratio,pressure_kPa\n";
  shear << "shear strain,shear stress (kPa)\n";
  for (int i = 0; i <= 40; ++i) {
    const double s = 1.0 - 0.0125 * i, v = 1.0 - 0.005 * i, gamma = 0.02 * i;
    const FoamState side = foam_state(law, FoamTest::kUniaxial, s);
    sides << s - 1.0 << "," << side.lateral_stretch() - 1.0 << "," << 1e-3 * side.nominal_stress_Pa
          << "\n";
    const FoamState body = foam_state(law, FoamTest::kVolumetric, v);
    pressures << v * v * v << "," << -1e-3 * body.nominal_stress_Pa / (v * v) << "\n";
    shear << gamma << "," << 1e-3 * foam_state(law, FoamTest::kShear, gamma).nominal_stress_Pa
          << "\n";
  }
  const std::string with_sides = "compression=" + folder.write("sides.csv", sides.str());
  const std::string volumetric = "volumetric=" + folder.write("pressures.csv", pressures.str());
  const std::string sheared = "shear=" + folder.write("shear.csv", shear.str());
  const std::string made = folder.file("foam.json"), card = folder.file("foam.inp");
  const auto run = run_command({"fit", with_sides, volumetric, sheared, "--model", "hyperfoam",
                                "--out", made, "--svg", folder.file("foam.svg"), "--json"});
  CAPTURE(run.err);
  REQUIRE(run.status == 0);
  const auto json = nlohmann::json::parse(run.out);
  CHECK(json["law"] == "hyperfoam-1");
  CHECK(json["laws"].size() == 3);
  const auto& chosen = json["laws"][0];
  CHECK(chosen["parameters"][0]["value"].get<double>() == Approx(5e4).epsilon(1e-5));
  CHECK(chosen["parameters"][1]["value"].get<double>() == Approx(8.0).epsilon(1e-5));
  CHECK(chosen["parameters"][2]["value"].get<double>() == Approx(0.2).epsilon(1e-5));
  CHECK(chosen["foam"]["K_Pa"].get<double>() == Approx(0.0666666667e6).epsilon(1e-5));
  CHECK(chosen["E0_Pa"].get<double>() == Approx(0.12e6).epsilon(1e-5));
  CHECK(json["tests"][1]["deformation"] == "volumetric");
  CHECK(json["tests"][2]["deformation"] == "shear");
  for (const char* target : {"abaqus", "calculix", "lsdyna", "openradioss"}) {
    CAPTURE(target);
    REQUIRE(run_command({"card", made, "--for", target, "--units", "mm-t-s", "--density",
                         "30 kg/m3", "--force", "--out", card})
                .status == 0);
    const auto check = run_command({"card", made, "--check", card, "--json"});
    CHECK(check.status == 0);
    CHECK(nlohmann::json::parse(check.out)["law"] == "hyperfoam-1");
  }
  CHECK_THAT(run_command({"card", made, "--for", "febio"}).err, Contains("no card of a foam"));
  CHECK_THAT(run_command({"card", made, "--for", "abaqus", "--bulk-modulus", "1 MPa"}).err,
             Contains("bulk modulus of a foam follows"));
  CHECK_THAT(run_command({"fit", with_sides, "--model", "hyperfoam-1"}).out,
             Contains("Poisson's ratio 0.2"));
  const auto refused = [&](std::vector<std::string> words, const std::string& reason) {
    words.insert(words.begin(), "fit");
    const auto wrong = run_command(words);
    CHECK(wrong.status != 0);
    CHECK_THAT(wrong.err, Contains(reason));
  };
  refused({sheared}, "is a test of a foam");
  refused({sheared, "--model", "yeoh"}, "add --model hyperfoam");
  refused({sheared, "--model", "hyperfoam-2"}, "do not show the Poisson ratio");
  refused({with_sides, "--model", "hyperfoam-4"}, "is no law of rubber");
  refused({with_sides, "--model", "yeoh", "--poisson-ratio", "0.3"},
          "--poisson-ratio is for foams");
  refused({with_sides, "--model", "hyperfoam", "--terms", "2"}, "--terms does not belong to foams");
  refused({with_sides, "--model", "hyperfoam", "--weight", "relative"},
          "--weight relative does not");
  CHECK(run_command({"fit", sheared, "--model", "hyperfoam-1", "--poisson-ratio", "0.2"}).status ==
        0);
  // Confined compression that is counted positive is the same.
  std::ostringstream confined, turned;
  confined << "stretch,nominal_stress_kPa\n";
  turned << "strain,nominal_stress_kPa\n";
  for (int i = 0; i <= 30; ++i) {
    const double s = 1.01 - 0.01 * i, t = 1.0 - 0.01 * i;
    confined << s << "," << 1e-3 * foam_state(law, FoamTest::kConfined, s).nominal_stress_Pa
             << "\n";
    turned << 1.0 - t << "," << -1e-3 * foam_state(law, FoamTest::kConfined, t).nominal_stress_Pa
           << "\n";
  }
  for (const auto& [name, text] :
       {std::pair{"c.csv", confined.str()}, std::pair{"t.csv", turned.str()}}) {
    const auto fit = run_command({"fit", sheared, "confined=" + folder.write(name, text), "--model",
                                  "hyperfoam-1", "--json"});
    REQUIRE(fit.status == 0);
    const auto found = nlohmann::json::parse(fit.out)["laws"][0]["parameters"];
    CHECK(found[2]["value"].get<double>() == Approx(0.2).epsilon(1e-3));
  }
  const auto true_stress =
      folder.write("true.csv", "stretch,true_stress_Pa\n1,0\n0.9,-5\n0.8,-9\n0.7,-15\n");
  refused({"compression=" + true_stress, "--model", "hyperfoam-1", "--poisson-ratio", "0"},
          "has the true stress alone");
}

TEST_CASE("a damaged file of a rubber is refused with its name and what is wrong", "[cli]") {
  const TableFolder folder;
  const std::string word = "uniaxial=" + folder.write("hold.csv", hold_table(true));
  const std::string out = folder.file("whole.json");
  REQUIRE(run_command({"fit", word, "--model", "neo-hooke", "--out", out}).status == 0);
  const auto whole = nlohmann::ordered_json::parse(text_of_file(out));
  const auto error_of = [&](auto&& damage) {
    nlohmann::ordered_json json = whole;
    damage(json, json["laws"][0]);
    const auto run =
        run_command({"card", folder.write("bad.json", json.dump()), "--for", "abaqus"});
    CHECK(run.status == 1);
    CHECK_THAT(run.err, Contains("bad.json"));
    return run.err;
  };
  CHECK_THAT(error_of([](auto& json, auto&) { json["law"] = "foo"; }),
             Contains("'laws' has no 'foo'"));
  CHECK_THAT(error_of([](auto&, auto& law) { law["parameters"].push_back(law["parameters"][0]); }),
             Contains("'parameters' must be 1 in number"));
  CHECK_THAT(error_of([](auto&, auto& law) { law["parameters"][0]["name"] = "mu"; }),
             Contains("parameter 1 must be C10_Pa"));
  CHECK_THAT(error_of([](auto&, auto& law) { law["terms"][0]["g"] = -0.1; }), Contains("g_1"));
  CHECK_THAT(error_of([](auto&, auto& law) { law["terms"][0]["g"] = 2.0; }),
             Contains("the sum of all g"));
  CHECK_THAT(error_of([](auto&, auto& law) { law["terms"][0]["tau_s"] = -1.0; }),
             Contains("tau_1"));
}
