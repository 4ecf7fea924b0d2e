// Several tests of one material together: viscard fit relaxation=a.csv creep=b.csv dma=c.csv.
#include "io/materials/material_file.h"
#include "models/material/prony_series.h"
#include "models/material/retardation_spectrum.h"
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

const PronySeries kTruth{1.0e6, {{0.6e6, 0.1}, {0.5e6, 10.0}}};

// Tables of one material, with noise of 1 %.
class Tables {
 public:
  Tables() {
    const RetardationSpectrum creep = retardation_from_relaxation(kTruth);
    std::ostringstream relaxation, compliance, oscillation, force;
    relaxation << "time_s,modulus_Pa\n";
    compliance << "time_s,compliance_1_Pa\n";
    oscillation << "frequency_Hz,storage_modulus_Pa,loss_modulus_Pa\n";
    force << "time_s,force_N\n";
    for (int i = 0; i < 80; ++i) {
      const double t_s = 0.1 * std::pow(1e4, i / 79.0), f_Hz = 0.003 * std::pow(1e4, i / 79.0);
      const double modulus_Pa = relaxation_modulus_Pa(kTruth, t_s);
      relaxation << t_s << "," << modulus_Pa * noisy() << "\n";
      force << t_s << "," << 2e-6 * modulus_Pa * noisy() << "\n";
      compliance << t_s << "," << creep_compliance_1_Pa(creep, t_s) * noisy() << "\n";
      const ComplexModulus at = complex_modulus_Pa(kTruth, 2.0 * std::numbers::pi * f_Hz);
      oscillation << f_Hz << "," << at.storage_Pa * noisy() << "," << at.loss_Pa * noisy() << "\n";
    }
    relaxation_ = folder.write("relaxation.csv", relaxation.str());
    creep_ = folder.write("creep.csv", compliance.str());
    dma_ = folder.write("dma.csv", oscillation.str());
    force_ = folder.write("force.csv", force.str());
  }

  TableFolder folder;
  std::string relaxation_, creep_, dma_, force_;

 private:
  double noisy() { return 1.0 + 0.01 * normal_(random_); }
  std::mt19937_64 random_{11};
  std::normal_distribution<double> normal_;
};

}  // namespace

TEST_CASE("three tests are fitted together, saved, predicted and written as a card", "[cli]") {
  const Tables tables;
  const std::string out = tables.folder.file("material.json");
  const std::vector<std::string> words{"fit", "relaxation=" + tables.relaxation_,
                                       "creep=" + tables.creep_, "oscillation=" + tables.dma_};
  auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return run_command(more);
  };
  const CommandOutcome text = with({"--out", out});
  CAPTURE(text.out, text.err);
  REQUIRE(text.status == kDone);
  CHECK_THAT(text.out, Contains("3 tests together, 240 samples") && Contains("creep") &&
                           Contains("% above the other tests"));

  const CommandOutcome json = with({"--json"});
  const auto fit = nlohmann::json::parse(json.out);
  CHECK(fit["kind"] == "several");
  CHECK(fit["E0_interval_95"][0].get<double>() < 2.1e6);
  CHECK(fit["E0_interval_95"][1].get<double>() > 2.1e6);
  CHECK(fit["E0_Pa"].get<double>() == Approx(2.1e6).epsilon(0.01));
  CHECK(fit["n_terms"] == 2);
  REQUIRE(fit["tests"].size() == 3);
  CHECK(fit["tests"][1]["name"] == "creep");
  CHECK(fit["tests"][1]["file"] == tables.creep_);
  CHECK(fit["tests"][1]["residuals"]["time_s"].size() == 80);
  CHECK(fit["tests"][2]["residuals"]["loss_fitted"].size() == 80);
  CHECK(fit["tests"][2]["kind"] == "dma");
  CHECK(fit["tests"][0]["difference"]["disagrees"] == false);
  CHECK(fit["tests"][0]["difference"]["p_value"].get<double>() > 1e-3);

  const Material material = read_material(out).material;
  CHECK(material.provenance.raw_files.size() == 3);
  CHECK(material.valid.t_max_s == Approx(1000.0));  // of relaxation and creep
  CHECK(material.valid.t_min_s == Approx(1.0 / (2.0 * std::numbers::pi * 30.0)));  // of the sweep
  const CommandOutcome predicted = run_command({"predict", out, "--test", "creep", "--json"});
  CAPTURE(predicted.err);
  CHECK(predicted.status == kDone);
  const CommandOutcome card =
      run_command({"card", out, "--for", "abaqus", "--out", tables.folder.file("card.inp")});
  CAPTURE(card.err);
  CHECK(card.status == kDone);
}

TEST_CASE("tests that disagree are reported, and their card is refused", "[cli]") {
  const Tables tables;
  std::ifstream in(tables.creep_);
  std::ostringstream stiffer;
  std::string line;
  for (std::getline(in, line), stiffer << line << "\n"; std::getline(in, line);) {
    const std::size_t comma = line.find(',');
    stiffer << line.substr(0, comma) << "," << std::stod(line.substr(comma + 1)) / 1.05 << "\n";
  }
  const std::string creep = tables.folder.write("stiffer.csv", stiffer.str());
  const std::string out = tables.folder.file("material.json");
  const CommandOutcome fitted = run_command({"fit", "relaxation=" + tables.relaxation_,
                                             "creep=" + creep, "dma=" + tables.dma_, "--out", out});
  CHECK(fitted.status == kFailed);
  CHECK_THAT(fitted.out, Contains("! tests-disagree: ") && Contains("the creep lies"));
  CHECK_THAT(fitted.err, Contains("not to be trusted"));
  const CommandOutcome card =
      run_command({"card", out, "--for", "abaqus", "--out", tables.folder.file("card.inp")});
  CHECK(card.status == kFailed);
}

TEST_CASE("a record of force among moduli gets its scale", "[cli]") {
  const Tables tables;
  const CommandOutcome fitted =
      run_command({"fit", "relaxation=" + tables.force_, "dma=" + tables.dma_, "--json"});
  CAPTURE(fitted.err);
  REQUIRE(fitted.status == kDone);
  const auto fit = nlohmann::json::parse(fitted.out);
  CHECK(fit["E0_Pa"].get<double>() == Approx(2.1e6).epsilon(0.01));
  CHECK(fit["tests"][0]["scale_interval_95"][0].get<double>() < 2e-6);
  CHECK(fit["tests"][0]["scale_interval_95"][1].get<double>() > 2e-6);
}

TEST_CASE("words of tests: refusals, and plain files with an equals sign", "[cli]") {
  const Tables tables;
  const auto refused = [](const std::vector<std::string>& words) {
    const CommandOutcome outcome = run_command(words);
    CAPTURE(outcome.out);
    CHECK(outcome.status != kDone);
    return outcome.err;
  };
  CHECK_THAT(refused({"fit", "relaxation=" + tables.relaxation_, "creep=" + tables.dma_}),
             Contains("was given as creep") && Contains("an oscillation"));
  CHECK_THAT(refused({"fit", "dma=" + tables.relaxation_, "creep=" + tables.creep_}),
             Contains("was given as an oscillation") && Contains("those of a relaxation"));
  CHECK_THAT(refused({"fit", "relaxing=" + tables.relaxation_, "creep=" + tables.creep_}),
             Contains("'relaxing' is no kind of test") && Contains("relaxation"));
  for (const char* word : {"uniaxal=", "biaxail="}) {
    CHECK_THAT(refused({"fit", word + tables.relaxation_}),
               Contains("did you mean") && Contains("uniaxial") && Contains("biaxial"));
  }
  CHECK_THAT(refused({"fit", tables.relaxation_, "creep=" + tables.creep_}),
             Contains("states no kind of test"));
  CHECK_THAT(refused({"fit", "creep=" + tables.creep_, "creep=" + tables.creep_}),
             Contains("given twice"));
  CHECK_THAT(refused({"fit", "creep=" + tables.creep_, "dma=" + tables.dma_, "--kind", "creep"}),
             Contains("--kind is for files that do not state"));
  CHECK_THAT(refused({"fit", "creep=" + tables.creep_, "dma=" + tables.dma_, "--profiles"}),
             Contains("--profiles is for single tests"));
  CHECK_THAT(refused({"fit", "creep=", "dma=" + tables.dma_}), Contains("names no file"));

  // A file whose own name has an equals sign; and one test that states its kind.
  const std::string strange = tables.folder.file("T=25.csv");
  std::filesystem::copy_file(tables.relaxation_, strange);
  CHECK(run_command({"fit", strange}).status == kDone);
  const CommandOutcome one = run_command({"fit", "creep=" + tables.creep_, "--json"});
  CAPTURE(one.err);
  CHECK(nlohmann::json::parse(one.out)["kind"] == "creep");
}

TEST_CASE("the page shows each of several tests with its residuals", "[cli][plots]") {
  const Tables tables;
  const std::string page = tables.folder.file("page.html");
  const CommandOutcome made =
      run_command({"report", "relaxation=" + tables.relaxation_, "creep=" + tables.creep_,
                   "dma=" + tables.dma_, "--out", page, "--json"});
  CAPTURE(made.out, made.err);
  REQUIRE(made.status == kDone);
  std::ifstream in(page);
  const std::string html((std::istreambuf_iterator<char>(in)), {});
  for (const char* part :
       {"<b>relaxation.</b>", "<b>creep.</b>", "<b>dma.</b>", "Difference (%)"}) {
    CHECK_THAT(html, Contains(part));
  }
  CHECK(nlohmann::json::parse(made.out)["specimens"][0]["files"].size() == 3);
}

TEST_CASE("one file that fails does not lose the others", "[cli]") {
  const Tables tables;
  const std::string bad = tables.folder.write("bad.csv", "time_s,modulus_Pa\n1,2e6\n");
  const CommandOutcome json =
      run_command({"fit", tables.relaxation_, bad, tables.creep_, "--json"});
  CHECK(json.status == kFailed);
  const auto fits = nlohmann::json::parse(json.out)["fits"];
  REQUIRE(fits.size() == 3);
  CHECK(fits[0]["kind"] == "relaxation");
  CHECK(fits[1]["file"] == bad);
  CHECK_THAT(fits[1]["error"]["message"].get<std::string>(), Contains("rows"));
  CHECK(fits[2]["kind"] == "creep");
  CHECK_THAT(json.err, Contains(bad));
  const CommandOutcome text = run_command({"fit", bad, tables.relaxation_});
  CHECK(text.status == kFailed);
  CHECK_THAT(text.out, Contains(tables.relaxation_ + ": relaxation"));
  CHECK_THAT(text.err, Contains(bad));
  // Without a single result the whole fails, as before.
  const CommandOutcome none = run_command({"fit", bad, bad, "--json"});
  CHECK(none.status == kFailed);
  CHECK(none.out.find("\"fits\"") == std::string::npos);
}

TEST_CASE("a record that was written in another way counts once among several tests", "[cli]") {
  const Tables tables;
  std::ifstream in(tables.relaxation_);
  std::string line, crlf, kilo = "Time (ms),Modulus (kPa)\n\n";
  std::getline(in, line);
  crlf = line + "\r\n";
  while (std::getline(in, line)) {
    crlf += line + "\r\n";
    const std::size_t comma = line.find(',');
    std::ostringstream row;
    row.precision(12);
    row << 1e3 * std::stod(line.substr(0, comma)) << ","
        << 1e-3 * std::stod(line.substr(comma + 1));
    kilo += row.str() + "\n";
  }
  for (const std::string& text : {crlf, kilo}) {
    const std::string copy = tables.folder.write("copy.csv", text);
    const auto both =
        run_command({"fit", "relaxation=" + tables.relaxation_, "relaxation=" + copy});
    CHECK(both.status == 1);
    CHECK_THAT(both.err, Contains("copy.csv holds the same record as") && Contains("counts once"));
    const auto joint = run_command({"fit", "--joint", tables.relaxation_, copy, tables.relaxation_,
                                    "--ratio", "10", "--ratio", "11", "--ratio", "12"});
    CHECK(joint.status == 1);
  }
}

TEST_CASE("fit writes its rows as a table and a picture, and several fits as one table", "[cli]") {
  const Tables tables;
  const std::string csv = tables.folder.file("rows.csv"), svg = tables.folder.file("fit.svg");
  const auto one = run_command({"fit", tables.dma_, "--csv", csv, "--svg", svg});
  CHECK(one.status == 0);
  std::ifstream in(csv);
  std::string line;
  std::getline(in, line);
  CHECK_THAT(line, Catch::StartsWith("# viscard fit"));
  std::getline(in, line);
  CHECK(line ==
        "frequency_Hz,storage_modulus_Pa,fitted_storage_modulus_Pa,residual_storage_modulus_Pa,"
        "sigma_storage_modulus_Pa,relative_weight_storage_modulus,loss_modulus_Pa,fitted_loss_"
        "modulus_Pa,"
        "residual_loss_modulus_Pa,sigma_loss_modulus_Pa,relative_weight_loss_modulus");
  int n_rows = 0;
  double largest_weight = 0.0;
  while (std::getline(in, line)) {
    double cell[6];
    std::istringstream row(line);
    for (double& value : cell) {
      std::string text;
      std::getline(row, text, ',');
      value = std::stod(text);
    }
    CHECK(cell[3] == Approx(cell[1] - cell[2]).margin(1e-6));
    CHECK(std::abs(cell[3]) < 5.0 * cell[4]);
    CHECK(cell[5] > 0.0);
    largest_weight = std::max(largest_weight, cell[5]);
    ++n_rows;
  }
  CHECK(largest_weight == 1.0);
  CHECK(n_rows == 80);
  std::stringstream picture;
  picture << std::ifstream(svg).rdbuf();
  CHECK_THAT(picture.str(), Contains("<svg") && Contains("frequency (Hz)"));
  CHECK(run_command({"fit", tables.dma_, "--csv", csv}).status == 1);  // exists
  const std::string wrong = tables.folder.write("wrong.csv", "a,b\n1,2\n3,4\n"),
                    summary = tables.folder.file("summary.csv");
  CHECK(run_command({"fit", tables.relaxation_, tables.creep_, wrong, "--csv", summary}).status ==
        1);
  std::ifstream rows(summary);
  std::getline(rows, line);
  std::getline(rows, line);
  CHECK_THAT(line, Catch::StartsWith("file,kind,unit,E0,E0_low,E0_high"));
  std::getline(rows, line);
  CHECK_THAT(line, Contains("relaxation.csv") && Contains(",relaxation,Pa,"));
  std::getline(rows, line);
  CHECK_THAT(line, Contains("creep.csv") && Contains(",creep,Pa,"));
  std::getline(rows, line);
  CHECK_THAT(line, Contains("wrong.csv") && Contains("no known column"));
  const auto two = run_command({"fit", tables.relaxation_, tables.creep_, "--svg", svg, "--force"});
  CHECK(two.status == 2);
  CHECK_THAT(two.err, Contains("--svg draws one fit"));
}

TEST_CASE("a table of stress and strain is creep if the strain moves while the stress rests",
          "[cli]") {
  const TableFolder folder;
  const RetardationSpectrum material{1e-6, {{0.5e-6, 5.0}}, 0.0};
  std::ostringstream recovery;
  recovery.precision(12);
  recovery << "Zeit [s];Spannung [kPa];Dehnung [%]\n";
  for (int i = 0; i <= 400; ++i) {
    const double t_s = 0.25 * i, back_s = t_s - 40.0;
    const bool is_loaded = i > 0 && back_s <= 0.0;
    double compliance_1_Pa = i > 0 ? creep_compliance_1_Pa(material, t_s) : 0.0;
    if (back_s > 0.0) compliance_1_Pa -= creep_compliance_1_Pa(material, back_s);
    recovery << t_s << ";" << (is_loaded ? 2.0 : 0.0) << ";" << 1e2 * 2e3 * compliance_1_Pa << "\n";
  }
  const auto fit = run_command({"fit", folder.write("recovery.csv", recovery.str()), "--json"});
  CHECK(fit.status == 0);
  const auto json = nlohmann::json::parse(fit.out);
  CHECK(json["kind"] == "creep");
  CHECK(json["n_samples"] == 401);
  CHECK(json["E0_interval_95"][0].get<double>() <= 1e6);
  CHECK(json["E0_interval_95"][1].get<double>() >= 1e6);
  CHECK(json["E_inf_Pa"].get<double>() == Approx(1.0 / 1.5e-6).epsilon(1e-3));
}
