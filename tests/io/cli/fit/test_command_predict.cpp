#include "fit/fit_relaxation.h"
#include "io/basics/atomic_file.h"
#include "io/basics/inputs.h"
#include "io/basics/sha256.h"
#include "io/flow/fit_file.h"
#include "io/flow/predict_file.h"
#include "io/materials/material_file.h"
#include "io/tables/csv_table.h"
#include "models/material/retardation_spectrum.h"
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <random>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

const std::string kData = VISCARD_SOURCE_DIR "/data/";

// The material fitted to the example of viscard fit.
std::string fitted_example(const TableFolder& folder) {
  std::string out = folder.file("material.json");
  const auto ran = run_command({"fit", kData + "demo/example_relaxation.csv", "--out", out});
  REQUIRE(ran.status == kDone);
  return out;
}

nlohmann::json predicted(std::vector<std::string> words) {
  words.insert(words.begin(), "predict");
  words.emplace_back("--json");
  const CommandOutcome ran = run_command(words);
  CAPTURE(ran.err);
  REQUIRE(ran.status == kDone);
  return nlohmann::json::parse(ran.out);
}

}  // namespace

TEST_CASE("the example of predict works as printed and finds the noise of the example", "[cli]") {
  const auto json = predicted({kData + "materials/pdms_1to10_seed.json", "--against",
                               kData + "demo/example_relaxation.csv"});
  CHECK(json["test"] == "relaxation");
  CHECK(json["has_band"] == false);
  const auto& found = json["against"]["quantities"][0];
  CHECK(found["quantity"] == "modulus_Pa");
  CHECK(found["n"] == 241);
  // The seed is the truth of that file, whose noise is 0.02 % of 1.88 MPa.
  CHECK(found["rms"].get<double>() == Approx(376.0).epsilon(0.1));
  CHECK(found["noise_sigma"].get<double>() == Approx(376.0).epsilon(0.25));
  CHECK(found["share_inside_band"].is_null());
  CHECK(json["notes"].dump().find("no band") != std::string::npos);
  const auto help = run_command({"predict", "--help"});
  // The files stand where this program finds its data.
  CHECK_THAT(help.out, Contains("viscard predict ") &&
                           Contains("materials/pdms_1to10_seed.json --against ") &&
                           Contains("demo/example_relaxation.csv"));
}

TEST_CASE("a fitted material predicts its own data to the noise, with a band", "[cli]") {
  const TableFolder folder;
  const std::string material = fitted_example(folder);
  const auto json = predicted({material, "--against", kData + "demo/example_relaxation.csv",
                               "--svg", folder.file("E.svg")});
  const auto& found = json["against"]["quantities"][0];
  CHECK(found["share_inside_band_and_noise"].get<double>() == Approx(0.95).margin(0.04));
  CHECK(found["share_inside_band"].get<double>() < 0.6);
  CHECK(found["rms_relative"].get<double>() < 3e-4);
  CHECK(std::abs(found["worst"].get<double>()) >= found["rms"].get<double>());
  CHECK(found["agrees"] == true);
  const auto& measured = json["against"]["measured"][0];
  CHECK(measured["quantity"] == "modulus_Pa");
  CHECK(measured["at"].size() == found["n"]);
  CHECK(measured["values"].size() == found["n"]);
  CHECK(json["curve"]["modulus_Pa_low_95"].size() == json["curve"]["time_s"].size());
  CHECK_THAT(read_file(folder.file("E.svg")), Contains("95 % band") && Contains("measured"));
}

TEST_CASE("a prediction that lies apart from a table disagrees, in words and as a key", "[cli]") {
  const TableFolder folder;
  const std::string material = fitted_example(folder);
  const PronySeries series = young_series(read_material(material).material);
  std::ostringstream text;
  text << "time_s,modulus_Pa\n";
  for (int i = 0; i < 40; ++i) {
    const double t_s = 0.1 * (i + 1);
    text << t_s << "," << 1.1 * relaxation_modulus_Pa(series, t_s) << "\n";
  }
  const std::string table = folder.write("other.csv", text.str());
  const auto found = predicted({material, "--against", table})["against"]["quantities"][0];
  CHECK(found["agrees"] == false);
  CHECK_THAT(run_command({"predict", material, "--against", table}).out,
             Contains(": they disagree"));
}

TEST_CASE("a predicted creep test is read by fit again and gives the same material", "[cli]") {
  const TableFolder folder;
  const std::string material = fitted_example(folder);
  const auto ran = run_command({"predict", material, "--test", "creep", "--csv",
                                folder.file("creep.csv"), "--from", "0.01 s"});
  REQUIRE(ran.status == kDone);
  CHECK_THAT(ran.out, Contains("window of the fit") && Contains("creep"));
  const auto fit = run_command({"fit", folder.file("creep.csv"), "--json"});
  CAPTURE(fit.err);
  const auto json = nlohmann::json::parse(fit.out);
  const Material truth = read_material(material).material;
  CHECK(json["kind"] == "creep");
  CHECK(json["E0_Pa"].get<double>() == Approx(truth.E0_Pa).epsilon(1e-4));
}

TEST_CASE("points beyond the window of the fit are marked", "[cli]") {
  const TableFolder folder;
  const std::string material = kData + "materials/pdms_1to10_seed.json";  // 0.1 s to 10 s
  const auto json = predicted({material, "--from", "0.01 s", "--to", "100 s", "--csv",
                               folder.file("E.csv"), "--svg", folder.file("E.svg")});
  const auto& curve = json["curve"];
  std::size_t n_outside = 0;
  for (std::size_t i = 0; i < curve["time_s"].size(); ++i) {
    const double t_s = curve["time_s"][i].get<double>();
    CHECK(curve["inside_window"][i].get<bool>() == (t_s >= 0.0999999 && t_s <= 10.00001));
    n_outside += curve["inside_window"][i].get<bool>() ? 0 : 1;
  }
  CHECK(json["n_outside_window"] == n_outside);
  CHECK(n_outside > 80);
  const CsvTable table = read_csv(folder.file("E.csv"));
  CHECK(table.columns.back().header == "inside_window");
  CHECK(table.columns.back().values.front() == 0.0);
  CHECK_THAT(read_file(folder.file("E.svg")), Contains("outside the window of the fit"));
  const auto dma = predicted({material, "--test", "oscillation", "--from", "1 mHz", "--to", "1"});
  CHECK(dma["curve"]["inside_window"].front() == false);  // 159 s
  CHECK(dma["curve"]["inside_window"].back() == true);    // 0.16 s
}

TEST_CASE("a history from a table is driven by strain or by stress, and compared", "[cli]") {
  const TableFolder folder;
  const std::string material = kData + "materials/pdms_1to10_seed.json";
  const PronySeries series = young_series(read_material(material).material);
  Course course;
  for (int i = 0; i <= 300; ++i) course.push_back({0.05 * i, 0.01 * std::sin(0.05 * i)});
  const std::vector<double> stress_Pa = response(series, course, false);
  std::ostringstream text;
  text.precision(17);
  text << "t (s),strain (%),stress (kPa)\n";
  for (std::size_t i = 0; i < course.size(); ++i) {
    text << course[i].time_s << "," << 100.0 * course[i].value << ","
         << 1e-3 * (stress_Pa[i] + (i == 200 ? 50.0 : 0.0)) << "\n";
  }
  const std::string table = folder.write("history.csv", text.str());
  const auto by_strain = predicted({material, "--history", table});
  CHECK(by_strain["test"] == "history");
  const auto& found = by_strain["against"]["quantities"][0];
  CHECK(found["quantity"] == "stress_Pa");
  CHECK(found["n"] == 301);
  CHECK(found["worst"].get<double>() == Approx(-50.0).epsilon(1e-6));
  CHECK(found["worst_at"].get<double>() == Approx(10.0));
  CHECK(found["rms"].get<double>() == Approx(50.0 / std::sqrt(301.0)).epsilon(1e-6));
  CHECK(predicted({material, "--against", table})["against"]["quantities"][0]["n"] == 301);
  // Driven by the stress, the strain comes back; stress between rows is not exactly linear.
  const auto by_stress = predicted({material, "--history", table, "--driven-by", "stress"});
  const auto& strain = by_stress["against"]["quantities"][0];
  CHECK(strain["quantity"] == "strain");
  CHECK(strain["rms_inside_window"].get<double>() < 1e-5);
  CHECK(by_stress["curve"]["strain"][60].get<double>() == Approx(course[60].value).epsilon(1e-3));
}

TEST_CASE("options that have no effect on a predicted test are refused by name", "[cli]") {
  const TableFolder folder;
  const std::string material = kData + "materials/pdms_1to10_seed.json";
  const std::string strains = folder.write("strain.csv", "time_s,strain\n0,0\n1,0.01\n2,0.01\n");
  using Words = std::vector<std::string>;
  const auto err_of = [&](const Words& test, const Words& option) {
    Words words{"predict", material};
    words.insert(words.end(), test.begin(), test.end());
    words.insert(words.end(), option.begin(), option.end());
    const CommandOutcome ran = run_command(words);
    INFO(ran.out);
    CHECK(ran.status != kDone);
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
    return ran.err;
  };
  const Words relaxation{}, creep{"--test", "creep"}, recovery{"--test", "recovery"},
      cycles{"--test", "cycles"}, sweep{"--test", "oscillation"}, history{"--history", strains};
  for (const auto& [test, option] :
       {std::pair{relaxation, Words{"--recovery", "3 s"}},
        std::pair{relaxation, Words{"--cycles", "3"}}, std::pair{creep, Words{"--period", "2 s"}},
        std::pair{creep, Words{"--driven-by", "stress"}},
        std::pair{creep, Words{"--column", "time_s=2"}},
        std::pair{creep, Words{"--time-zero", "1 s"}},
        std::pair{creep, Words{"--modulus-kind", "shear"}},
        std::pair{recovery, Words{"--period", "2 s"}}, std::pair{cycles, Words{"--ramp", "1 s"}},
        std::pair{cycles, Words{"--hold", "1 s"}}, std::pair{cycles, Words{"--recovery", "1 s"}},
        std::pair{cycles, Words{"--from", "1 s"}}, std::pair{sweep, Words{"--strain", "0.01"}},
        std::pair{sweep, Words{"--ramp", "1 s"}}, std::pair{sweep, Words{"--cycles", "3"}},
        std::pair{history, Words{"--strain", "0.01"}}, std::pair{history, Words{"--to", "3 s"}},
        std::pair{history, Words{"--points", "50"}}}) {
    CHECK_THAT(err_of(test, option), Contains(option.front() + " is for") && Contains("omit it"));
  }
  CHECK_THAT(err_of(creep, {"--hold", "3 s", "--to", "5 s"}),
             Contains("--to is for tests without"));
  CHECK_THAT(err_of(history, {"--driven-by", "stress"}), Contains("there is strain alone"));
  // The columns of the table decide which test it is.
  const std::string against = kData + "demo/example_relaxation.csv";
  CHECK_THAT(err_of({"--against", against}, {"--cycles", "3"}), Contains("--cycles is for"));
}

TEST_CASE("cycles have as many points as were requested, within a limit", "[cli]") {
  const std::string material = kData + "materials/pdms_1to10_seed.json";
  const auto json = predicted({material, "--test", "cycles", "--cycles", "1", "--points", "150"});
  CHECK(json["curve"]["time_s"].size() > 2 * 149);
  const CommandOutcome many = run_command(
      {"predict", material, "--test", "cycles", "--cycles", "10000", "--points", "1000"});
  CHECK(many.status == kBadWords);
  CHECK_THAT(many.err, Contains("--cycles 10000 with 1000 points"));
}

TEST_CASE("measured times between the corners of a test are predicted exactly", "[cli]") {
  const TableFolder folder;
  const std::string material = kData + "materials/pdms_1to10_seed.json";
  const PronySeries series = young_series(read_material(material).material);
  std::ostringstream text;
  text.precision(17);
  text << "time_s,stress_Pa\n-1,0\n";
  const RetardationSpectrum spectrum = retardation_from_relaxation(series);
  for (const double t_s : {0.37, 1.91, 7.3}) {
    text << t_s << "," << 0.02 * relaxation_modulus_Pa(series, t_s) << "\n";
  }
  const std::string table = folder.write("hold.csv", text.str());
  const auto json =
      predicted({material, "--test", "relaxation", "--strain", "0.02", "--against", table});
  const auto& found = json["against"]["quantities"][0];
  CHECK(found["n"] == 3);
  CHECK(found["rms_relative"].get<double>() < 1e-12);
}

TEST_CASE("contradictory words of predict are refused with status 2", "[cli]") {
  const std::string material = kData + "materials/pdms_1to10_seed.json";
  const auto refused = [&](std::vector<std::string> words, const std::string& reason) {
    words.insert(words.begin(), {"predict", material});
    const CommandOutcome ran = run_command(words);
    CAPTURE(ran.err);
    CHECK(ran.status == kBadWords);
    CHECK_THAT(ran.err, Contains(reason));
  };
  refused({"--test", "creeep"}, "did you mean 'creep'?");
  refused({"--test", "creep", "--strain", "0.1"}, "give --stress");
  refused({"--test", "relaxation", "--stress", "1 kPa"}, "--strain");
  refused({"--strain", "0.1", "--stress", "1 kPa"}, "exclude each other");
  refused({"--hold", "-1 s"}, "--hold must be positive");
  refused({"--test", "history"}, "--history TABLE");
  refused({"--test", "cycles", "--cycles", "0"}, "between 1 and 10000");
  refused({"--driven-by", "force"}, "strain or stress");
}

TEST_CASE("a table that does not fit the test is refused with the reason", "[cli]") {
  const TableFolder folder;
  const std::string material = kData + "materials/pdms_1to10_seed.json";
  const std::string table = folder.write("x.csv", "time_s,temperature_C\n1,2\n2,3\n");
  const auto refused = [&](std::vector<std::string> words, const std::string& reason) {
    words.insert(words.begin(), {"predict", material});
    const CommandOutcome ran = run_command(words);
    CAPTURE(ran.err);
    CHECK(ran.status == kFailed);
    CHECK(ran.out.empty());
    CHECK_THAT(ran.err, Contains(reason));
  };
  refused({"--against", table}, "do not say which test");
  refused({"--test", "creep", "--against", table}, "compliance_1_Pa");
  refused({"--history", table}, "strain or stress_Pa");
  refused({"--temperature", "40 degC"}, "no temperature shift");
  const std::string back = folder.write("y.csv", "time_s,strain\n1,0.1\n0.5,0.2\n");
  refused({"--history", back}, "backwards");
}

TEST_CASE("a material that is not to be trusted gives status 1 unless its flags are accepted",
          "[cli]") {
  const TableFolder folder;
  auto json = nlohmann::json::parse(read_file(fitted_example(folder)));
  json["flags"] = {{{"name", "misfit"}, {"text", "the residual is large"}}};
  const std::string material = folder.write("bad.json", json.dump());
  const CommandOutcome ran = run_command({"predict", material, "--json"});
  CHECK(ran.status == kFailed);
  CHECK_THAT(ran.err, Contains("not to be trusted: misfit: the residual is large"));
  CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 2);  // and that it was edited
  const auto found = nlohmann::json::parse(ran.out);
  CHECK_FALSE(found["trustworthy"].get<bool>());
  CHECK(found["flags"][0]["name"] == "misfit");
  const CommandOutcome accepted = run_command({"predict", material, "--accept-flags"});
  CHECK(accepted.status == kDone);
  CHECK(std::count(accepted.err.begin(), accepted.err.end(), '\n') == 1);
  CHECK(predicted({folder.file("material.json")})["trustworthy"] == true);
}

TEST_CASE("a strain may be a percentage, and a large one gives a warning", "[cli]") {
  const std::string material = kData + "materials/pdms_1to10_seed.json";
  const auto stress_of = [&](const char* strain) {
    return predicted({material, "--strain", strain})["curve"]["stress_Pa"];
  };
  CHECK(stress_of("1 %") == stress_of("0.01"));
  CHECK(stress_of("1%") == stress_of("0.01"));
  CHECK_THAT(run_command({"predict", material, "--strain", "500 %"}).out, Contains("500 %, but"));
  CHECK_THAT(run_command({"predict", material, "--strain", "0.5"}).out, !Contains("small strains"));
  const CommandOutcome wrong = run_command({"predict", material, "--strain", "1 kPa"});
  CHECK(wrong.status == kBadWords);
  CHECK_THAT(wrong.err, Contains("--strain"));
}

TEST_CASE("bands of predicted creep cover the truth", "[cli]") {
  // Two terms, noise 0.1 % of E0, 30 records of 400 samples; creep between 0.1 s and 100 s.
  const PronySeries truth{1.0e6, {{0.3e6, 0.5}, {0.2e6, 8.0}}};
  const RetardationSpectrum spectrum = retardation_from_relaxation(truth);
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(0.0, 1500.0);
  int n_inside = 0, n_all = 0;
  for (int record = 0; record < 30; ++record) {
    RelaxationData data;
    for (int i = 0; i < 400; ++i) {
      data.time_s.push_back(0.05 * std::pow(100.0 / 0.05, i / 399.0));
      data.value.push_back(relaxation_modulus_Pa(truth, data.time_s.back()) + normal(random));
    }
    Material material = material_from_fit(fit_relaxation(data, {}), 0.495, 0.0);
    material.valid = {0.05, 100.0, 0.0};
    PredictionRequest request{.test = PredictedTest::kCreep, .from = 0.1, .to = 100.0, .points = 7};
    const TestPrediction found = predict_test(material, request);
    for (std::size_t i = 0; i < found.at.size(); ++i) {
      const double exact = creep_compliance_1_Pa(spectrum, found.at[i]);
      const BandedCurve& curve = found.curves[0].curve;
      n_inside += curve.low_95[i] <= exact && exact <= curve.high_95[i] ? 1 : 0;
      ++n_all;
    }
  }
  CAPTURE(n_inside, n_all);
  // 95 % of 210 correlated values; 88 % is three standard errors of about 60 independent ones less.
  CHECK(n_inside >= 0.88 * n_all);
}

TEST_CASE("a table of a damaged capture is not compared unless it is accepted", "[cli]") {
  const TableFolder folder;
  const std::string material = fitted_example(folder);
  const std::string table = folder.write(
      "damaged.csv",
      "# load-cell samples of a capture, written by viscard 0.1.0\n"
      "# damage: unverified: the capture is damaged and was read with --unverified: moves\n"
      "time_s,modulus_Pa,strain\n0.1,1.87e6,0\n1,1.86e6,0.01\n10,1.85e6,0.01\n");
  for (const char* option : {"--against", "--history"}) {
    CAPTURE(option);
    const CommandOutcome refused = run_command({"predict", material, option, table});
    CHECK(refused.status == kFailed);
    CHECK_THAT(refused.err,
               Contains("was exported from a damaged capture") && Contains("add --unverified"));
    const nlohmann::json json = predicted({material, option, table, "--unverified"});
    REQUIRE(json["flags"].size() >= 1);
    const auto is_about_table = [&](const nlohmann::json& flag) {
      return flag["name"] == "unverified" && flag["text"].get<std::string>().starts_with(table);
    };
    CHECK(std::count_if(json["flags"].begin(), json["flags"].end(), is_about_table) == 1);
    CHECK_THAT(json["notes"].dump(), Contains("unverified"));
  }
}

TEST_CASE("a material states the sum of the contents that were fitted", "[cli]") {
  const TableFolder folder;
  const std::string first = read_file(kData + "demo/example_relaxation.csv");
  const std::string table = folder.write("x.csv", first);
  const InputRecorder recorder;
  const FittedFile fitted = fit_file(table, {});
  rewrite_file(table, first + "200,1.8\n");  // while the bootstrap runs, say
  const Material material = material_from_fitted(fitted, {});
  REQUIRE(material.provenance.raw_files.size() == 1);
  CHECK(material.provenance.raw_files[0].sha256 == sha256_of_text(first));
}

TEST_CASE("examples and remedies of refused options are those of the quantity", "[cli]") {
  const std::string seed = kData + "materials/pdms_1to10_seed.json";
  const auto err = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"predict", seed});
    const CommandOutcome ran = run_command(words);
    CHECK(ran.status != kDone);
    return ran.err;
  };
  for (const char* strain : {"1 pct", "1 mm", "x"}) {
    CAPTURE(strain);
    CHECK_THAT(err({"--test", "relaxation", "--strain", strain}),
               Contains("write it like \"1 %\"") && !Contains("0.495"));
  }
  const auto range =
      run_command({"predict", seed, "--test", "oscillation", "--from", "10Hz", "--to", "1Hz"});
  CHECK(range.status == kBadWords);
  CHECK_THAT(range.err, Contains("--from 10Hz --to 1Hz"));
}

TEST_CASE("a strain that follows from the load passes the rule of one that is stated", "[cli]") {
  const std::string seed = kData + "materials/pdms_1to10_seed.json";
  for (const char* test : {"creep", "recovery"}) {
    CAPTURE(test);
    const auto ran = run_command({"predict", seed, "--test", test, "--stress", "1 GPa"});
    CHECK(ran.status != kDone);
    CHECK_THAT(ran.err, Contains("its largest strain is") && Contains("--plausible off"));
    CHECK(run_command({"predict", seed, "--test", test, "--stress", "10 kPa"}).status == kDone);
  }
}
