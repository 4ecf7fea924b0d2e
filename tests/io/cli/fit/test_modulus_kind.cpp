// Shear is not tension: the kind of modulus from header and option to material, card and prediction.
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

constexpr double kG0_Pa = 0.5e6, kNu = 0.495;

// 0.3 MPa + 0.2 MPa exp(-t/3 s) times `factor`, over 0.01 to 100 s; the last digits vary.
std::string modulus_table(const std::string& header, double factor = 1.0) {
  std::ostringstream text;
  text.precision(12);
  text << header << "\n";
  for (int i = 0; i <= 100; ++i) {
    const double t = std::pow(10.0, -2.0 + 4.0 * i / 100.0);
    text << t << "," << factor * (0.3 + 0.2 * std::exp(-t / 3.0)) + 1e-7 * ((7 * i) % 11) << "\n";
  }
  return text.str();
}

nlohmann::json fitted(const std::string& file, std::vector<std::string> more = {}) {
  std::vector<std::string> words{"fit", file, "--json"};
  words.insert(words.end(), more.begin(), more.end());
  const CommandOutcome ran = run_command(words);
  CAPTURE(ran.err, ran.out);
  REQUIRE(ran.status == kDone);
  return nlohmann::json::parse(ran.out);
}

bool has_flag(const nlohmann::json& fit, const std::string& name) {
  for (const auto& flag : fit.at("flags")) {
    if (flag["name"] == name) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a shear modulus becomes Young's modulus by its header, with G0 beside it", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("g.csv", modulus_table("Time (s),G(t) (MPa)"));
  const auto fit = fitted(file);
  CHECK(fit["modulus_kind"] == "shear");
  CHECK(fit["nu"] == kNu);
  CHECK(fit["nu_stated"] == false);
  CHECK(fit["G0_Pa"].get<double>() == Approx(kG0_Pa).epsilon(1e-3));
  CHECK(fit["E0_Pa"].get<double>() == Approx(2.0 * (1.0 + kNu) * kG0_Pa).epsilon(1e-3));
  CHECK(fit["E0_Pa"].get<double>() / fit["G0_Pa"].get<double>() ==
        Approx(2.0 * (1.0 + kNu)).epsilon(1e-12));
  CHECK(has_flag(fit, "measured-as-shear"));
  // Sums of squares are in the unit of the column: those of the same numbers of tension.
  const auto tension = fitted(file, {"--modulus-kind", "tension"});
  CHECK(tension["E0_Pa"].get<double>() == Approx(kG0_Pa).epsilon(1e-3));
  CHECK(fit["rss"].get<double>() == Approx(tension["rss"].get<double>()).epsilon(1e-6));
  CHECK(fit["noise"]["sigma"].get<double>() ==
        Approx(tension["noise"]["sigma"].get<double>()).epsilon(1e-6));
  const auto other = fitted(file, {"--poisson-ratio", "0.3"});
  CHECK(other["E0_Pa"].get<double>() == Approx(2.6 * kG0_Pa).epsilon(1e-3));
  CHECK(other["nu_stated"] == true);
  const CommandOutcome text = run_command({"fit", file});
  CHECK_THAT(text.out, Contains("moduli of shear (the header 'G(t) (MPa)')") && Contains("G0") &&
                           Contains("E = 2 (1 + nu) G with nu = 0.495 (assumed"));
}

TEST_CASE("where nothing tells the kind of modulus the answer asks for it", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("m.csv", modulus_table("Time (s),Modulus (MPa)"));
  const auto fit = fitted(file);
  CHECK(has_flag(fit, "modulus-kind-assumed"));
  CHECK(fit["modulus_kind"] == "tension");
  CHECK_FALSE(fit.contains("G0_Pa"));
  for (const char* kind : {"tension", "shear"}) {
    CHECK_FALSE(has_flag(fitted(file, {"--modulus-kind", kind}), "modulus-kind-assumed"));
  }
  CHECK_FALSE(has_flag(fitted(folder.write("o.csv", modulus_table("time_s,modulus_MPa"))),
                       "modulus-kind-assumed"));
}

TEST_CASE("other kinds of modulus follow their formulas", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("m.csv", modulus_table("Time (s),Modulus (MPa)"));
  const auto E0 = [&](const std::string& kind) {
    return fitted(file, {"--modulus-kind", kind, "--poisson-ratio", "0.4"})["E0_Pa"].get<double>();
  };
  CHECK(E0("plane-strain") == Approx((1.0 - 0.16) * kG0_Pa).epsilon(1e-3));
  CHECK(E0("indentation") == Approx((1.0 - 0.16) * kG0_Pa).epsilon(1e-3));
  CHECK(E0("bulk") == Approx(3.0 * 0.2 * kG0_Pa).epsilon(1e-3));
  const CommandOutcome bulk = run_command({"fit", file, "--modulus-kind", "bulk"});
  CHECK(bulk.status == kFailed);
  CHECK_THAT(bulk.err, Contains("--poisson-ratio"));
  CHECK(run_command({"fit", file, "--modulus-kind", "sheer"}).status == kBadWords);
}

TEST_CASE("material, card and prediction of a test in shear have Young's modulus", "[cli]") {
  const TableFolder folder;
  const std::string file = folder.write("g.csv", modulus_table("Time (s),G(t) (MPa)"));
  const std::string material = folder.file("m.json");
  REQUIRE(run_command({"fit", file, "--out", material}).status == kDone);
  const CommandOutcome card = run_command({"card", material, "--for", "json", "--units", "SI"});
  CAPTURE(card.err);
  REQUIRE(card.status == kDone);
  CHECK_THAT(card.out, Contains("measured-as-shear") || Contains("1495"));
  // Compared as it was measured, the prediction agrees; as if of tension, it is three times too large.
  const auto rms = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"predict", material, "--against", file, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const CommandOutcome ran = run_command(words);
    CAPTURE(ran.err);
    REQUIRE(ran.status == kDone);
    return nlohmann::json::parse(ran.out)["against"]["quantities"][0]["rms_relative"].get<double>();
  };
  CHECK(rms({}) < 1e-3);
  CHECK(rms({"--modulus-kind", "tension"}) > 1.5);
}

TEST_CASE("tests in shear and in tension of one material tell its Poisson ratio", "[cli]") {
  const TableFolder folder;
  const double nu = 0.35;
  const std::string shear = folder.write("g.csv", modulus_table("Time (s),G(t) (MPa)"));
  const std::string tension =
      folder.write("e.csv", modulus_table("Time (s),E(t) (MPa)", 2.0 * (1.0 + nu)));
  const std::string material = folder.file("m.json");
  const CommandOutcome ran = run_command(
      {"fit", "relaxation=" + shear, "relaxation=" + tension, "--json", "--out", material});
  CAPTURE(ran.err);
  REQUIRE(ran.status == kDone);
  const auto fit = nlohmann::json::parse(ran.out);
  CHECK(fit["nu"].get<double>() == Approx(nu).margin(1e-3));
  CHECK(fit["nu_interval_95"][0].get<double>() < fit["nu_interval_95"][1].get<double>());
  CHECK(fit["E0_Pa"].get<double>() == Approx(2.0 * (1.0 + nu) * kG0_Pa).epsilon(1e-3));
  std::ifstream written(material);
  CHECK(nlohmann::json::parse(written)["nu"].get<double>() == Approx(nu).margin(1e-3));
  // Three times the shear modulus as tension needs more than an isotropic material has.
  const std::string wrong = folder.write("w.csv", modulus_table("Time (s),E(t) (MPa)", 4.0));
  const CommandOutcome other = run_command({"fit", "relaxation=" + shear, "relaxation=" + wrong});
  CHECK(other.status == kFailed);
  CHECK_THAT(other.out + other.err, Contains("Poisson ratio of 1"));
}

TEST_CASE("rows with gaps are counted, and the notes state how a table was read", "[cli]") {
  const TableFolder folder;
  std::string text = modulus_table("Time (s),E (MPa)");
  text += "200,\n300,NaN\n,,\n";
  const auto fit = fitted(folder.write("gaps.csv", text));
  CHECK(fit["left_out"]["not_a_number"] == 2);
  const auto relative = fitted(folder.write("r.csv", modulus_table("time (s),g_R(t)", 2.0)),
                               {"--youngs-modulus", "3 MPa"});
  CHECK(relative["E0_Pa"].get<double>() == Approx(3e6).epsilon(1e-3));
  CHECK_THAT(relative["notes"][0].get<std::string>(), Contains("--youngs-modulus"));
  // A storage modulus shows a spectrum, a loss modulus alone leaves out what does not relax.
  CHECK(has_flag(
      fitted(folder.write("s.csv", "Frequency (Hz),Storage modulus (MPa)\n1,2\n2,3\n3,4\n")),
      "storage-alone"));
  const CommandOutcome unknown = run_command(
      {"fit", folder.write("l.csv", "Frequency (Hz),Loss modulus (MPa)\n1,2\n2,3\n3,4\n")});
  CHECK(unknown.status == kFailed);
  CHECK_THAT(unknown.err, Contains("tan delta") && !Contains("modulus_Pa=2"));
}
