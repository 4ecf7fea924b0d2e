#include "io/cards/card.h"
#include "io/cards/card_sum.h"
#include "io/cards/targets/card_targets.h"
#include "models/material/prony_series.h"
#include "tests/io/cards/card_materials.h"
#include "tests/support/without_commit.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

using namespace viscard;
using namespace viscard::test;

namespace {

std::string text_of(const char* target, const char* units, const Material& material) {
  return write_card(material, card_target(target), {.units = units, .is_reproducible = true}).text;
}

// All numbers after a place in the text, found without viscard's readers.
std::vector<double> numbers_after(const std::string& text, const std::string& from) {
  std::vector<double> out;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  const std::string rest = text.substr(at + from.size());
  const std::regex number("[-+]?(\\d+\\.?\\d*|\\.\\d+)([eE][-+]?\\d+)?");
  for (std::sregex_iterator it(rest.begin(), rest.end(), number), end; it != end; ++it) {
    out.push_back(std::strtod(it->str().c_str(), nullptr));
  }
  return out;
}

double exact_E_Pa(double t) {
  return 1.88e6 *
         (1.0 - 0.008206 * (1.0 - std::exp(-t / 0.1945)) - 0.01386 * (1.0 - std::exp(-t / 2.403)));
}

const std::vector<double> kTimes{0.0, 0.05, 0.2, 1.0, 3.0, 20.0, 500.0};

// The card as a source without a commit would write it.
std::string without_commit_and_its_sum(const std::string& card) {
  std::string text = without_commit(card);
  const std::string unsealed = unsealed_sum_line();
  const std::string mark = unsealed.substr(0, unsealed.find('0'));
  text.replace(text.find(mark), unsealed.size(), unsealed);
  return sealed(text);
}

}  // namespace

TEST_CASE("E(t) recomputed from the text of an Abaqus card is the material's", "[cards]") {
  const std::string text = text_of("abaqus", "mm-kg-ms", reference_material());
  REQUIRE(text.find("*ELASTIC, MODULI=INSTANTANEOUS\n") != std::string::npos);
  const std::vector<double> elastic = numbers_after(text, "MODULI=INSTANTANEOUS\n");
  const std::vector<double> prony = numbers_after(text, "TIME=PRONY\n");
  REQUIRE(prony.size() == 6);  // rows g, k, tau
  for (const double t : kTimes) {
    const double ms = 1e3 * t;
    double E = elastic[0];
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(prony[3 * i] == prony[3 * i + 1]);
      E -= elastic[0] * prony[3 * i] * (1.0 - std::exp(-ms / prony[3 * i + 2]));
    }
    CHECK(E * 1e9 == Approx(exact_E_Pa(t)).epsilon(1e-14));  // shortest text is exact
  }
}

TEST_CASE("E(t) recomputed from the text of a FEBio card is the material's", "[cards]") {
  const std::string text = text_of("febio", "mm-t-s", reference_material());
  // <g0>a</g0> <g1>b</g1><t1>c</t1> ...: tag digits come between the numbers.
  const auto value = [&](const std::string& tag) {
    return numbers_after(text, "<" + tag + ">").front();
  };
  for (const double t : kTimes) {
    const double E = value("E") * (value("g0") + value("g1") * std::exp(-t / value("t1")) +
                                   value("g2") * std::exp(-t / value("t2")));
    CHECK(E * 1e6 == Approx(exact_E_Pa(t)).epsilon(1e-14));
  }
}

TEST_CASE("G(t) recomputed from the columns of an LS-DYNA card is the material's", "[cards]") {
  const std::string text = text_of("lsdyna", "mm-t-s", reference_material());
  std::istringstream stream(text.substr(text.find("\n*MAT_GENERAL") + 1));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] != '$') lines.push_back(line);
  }
  // keyword, title, card 1, blank card 2, three rows
  REQUIRE(lines.size() == 7);
  CHECK(lines[3].empty());
  const auto field = [&](std::size_t row, std::size_t column) {
    return std::stod(lines[row].substr(10 * column, 10));
  };
  CHECK(field(2, 2) == Approx(62.6666667).epsilon(1e-7));  // eight digits fit
  CHECK(field(4, 1) == 0.0);
  for (const double t : kTimes) {
    double G = 0.0;
    for (std::size_t row = 4; row < 7; ++row) G += field(row, 0) * std::exp(-field(row, 1) * t);
    CHECK(G * 1e6 == Approx(exact_E_Pa(t) / (2.0 * 1.495)).epsilon(5e-8));  // eight digits
  }
}

TEST_CASE("E(t) recomputed from the shares of a CalculiX overlay is the material's", "[cards]") {
  const std::string text = text_of("calculix", "SI", reference_material());
  std::vector<double> share, rate;
  for (const char* name : {"PDMS_INF", "PDMS_M1", "PDMS_M2"}) {
    const std::string block = text.substr(text.find(std::string("NAME=") + name));
    share.push_back(numbers_after(block, "*ELASTIC\n").front());
    rate.push_back(std::string(name) == "PDMS_INF" ? 0.0
                                                   : numbers_after(block, "LAW=NORTON\n").front());
  }
  for (const double t : kTimes) {
    double G = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double branch_G = share[i] / (2.0 * 1.495);
      G += branch_G * std::exp(-3.0 * branch_G * rate[i] * t);  // Norton: rate of shear 3 A s
    }
    CHECK(G == Approx(exact_E_Pa(t) / (2.0 * 1.495)).epsilon(1e-13));  // rounding
  }
}

TEST_CASE("cards of the reference material equal the golden files", "[cards][golden]") {
  for (const CardTarget& target : card_targets()) {
    CAPTURE(target.name);
    CardOptions options{.units = "mm-t-s", .is_reproducible = true};
    options.may_approximate = true;
    Material material = reference_material();
    if (target.max_terms == 1) material.terms.resize(1);
    const std::string text = without_commit_and_its_sum(write_card(material, target, options).text);
    const std::string path =
        std::string(VISCARD_GOLDEN_FOLDER) + "/reference_" + target.name + target.extension;
    if (std::getenv("VISCARD_UPDATE_GOLDEN") != nullptr) {
      std::ofstream(path, std::ios::binary) << text;
    }
    std::ifstream kept(path, std::ios::binary);
    REQUIRE(kept);
    std::ostringstream contents;
    contents << kept.rdbuf();
    CHECK(text == contents.str());
  }
}

TEST_CASE("reproducible cards are byte-identical, others carry date and command", "[cards]") {
  const CardTarget& target = card_target("abaqus");
  CardOptions options;
  options.created_at = "2024-01-01T00:00:00Z";
  options.command = "viscard card --for abaqus";
  const std::string dated = write_card(reference_material(), target, options).text;
  CHECK(dated.find("2024-01-01") != std::string::npos);
  options.is_reproducible = true;
  const std::string one = write_card(reference_material(), target, options).text;
  options.created_at = "2025-01-01T00:00:00Z";
  CHECK(write_card(reference_material(), target, options).text == one);
}

TEST_CASE("a material named like a word of the solver gets another name in its card", "[cards]") {
  Material material = reference_material();
  for (const char* name : {"creep", "double", "tau", "E0", "Density"}) {
    material.name = name;
    CAPTURE(name);
    const std::string moose = write_card(material, card_target("moose")).text;
    CHECK(moose.find("[" + std::string(name) + "_material]") != std::string::npos);
    const std::string mfront = write_card(material, card_target("mfront")).text;
    CHECK(mfront.find("@Behaviour " + std::string(name) + "_material;") != std::string::npos);
  }
  material.name = "PDMS 1:10";
  CHECK(write_card(material, card_target("moose")).text.find("[PDMS_1_10]") != std::string::npos);
}

TEST_CASE("headers never break the comment syntax of the target", "[cards]") {
  Material material = reference_material();
  material.name = "PDMS -- 1:10 -->\n*STATIC\xc3\xa9";
  for (const CardTarget& target : card_targets()) {
    CAPTURE(target.name);
    if (target.comment.empty() || target.max_terms == 1) continue;
    CardOptions options;
    options.command = "viscard card --for x --out -->";
    const std::string text = write_card(material, target, options).text;
    CHECK(text.find("\n*STATIC") == std::string::npos);
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
      if (line.rfind("<!--", 0) == 0) CHECK(line.find("--", 4) == line.size() - 3);
      for (const char c : line) CHECK((c >= ' ' && c <= '~'));
    }
  }
}

TEST_CASE("a material that a target cannot take is refused with one line that says what to do",
          "[cards]") {
  const auto refused = [](const Material& material, const char* target, const std::string& part,
                          const CardOptions& options = {}) {
    CHECK_THROWS_WITH(write_card(material, card_target(target), options), Catch::Contains(part));
  };
  Material material = reference_material();
  refused(material, "abacus", "abaqus, ansys");
  refused(material, "abaqus", "mm-t-s", {.units = "mm"});
  material.nu = 0.5;
  for (const CardTarget& target : card_targets()) {
    CAPTURE(target.name);
    if (target.max_terms == 1) material.terms.resize(1);
    if (target.takes_incompressible) {
      CHECK_NOTHROW(write_card(material, target));
    } else {
      refused(material, target.name.c_str(), "--clamp-nu");
      const CardOptions clamped{.clamped_nu = 0.4995};
      CHECK(write_card(material, target, clamped).written.nu == Approx(0.4995).epsilon(1e-9));
    }
  }
  material = reference_material();
  material.terms[0].g = 0.99;
  refused(material, "abaqus", "below 1");
  refused(material_of_terms(7, 0.4), "febio", "at most 6");
  refused(material_of_terms(7, 0.4), "openradioss", "at most 5");
  material = reference_material();
  material.flags = {{"tau-below-sampling", 1, "faster than the samples"}};
  refused(material, "abaqus", "--accept-flags");
  CHECK_NOTHROW(write_card(material, card_target("abaqus"), {.accepts_flags = true}));
  for (const char* defect : {"misfit", "modulus-rises"}) {
    material.flags = {{defect, 0, "the model does not describe the record"}};
    refused(material, "abaqus", "not to be trusted");
  }
  CHECK_NOTHROW(write_card(material, card_target("abaqus"), {.accepts_flags = true}));
  material.flags = {{"order-uncertain", 0, "other orders do as well"}};  // widens intervals only
  CHECK_NOTHROW(write_card(material, card_target("abaqus")));
  material = reference_material();
  for (MaterialTerm& term : material.terms) term.k = 0.0;
  refused(material, "febio",
          "--approximate");  // stated constant K, taken as constant nu
  CHECK_NOTHROW(write_card(material, card_target("febio-uncoupled")));
  material = reference_material();
  material.provenance.bulk_origin = "measured";
  refused(material, "calculix", "--approximate");
}

TEST_CASE(
    "an assumed bulk part is replaced by the target's rule and the header states the difference",
    "[cards]") {
  const Card card = write_card(reference_material(), card_target("calculix"), {.units = "mm-t-s"});
  // Constant K instead of constant nu: 7.36e-5 in the long-term modulus at nu = .495.
  CHECK(card.largest_difference == Approx(7.36e-5).epsilon(5e-3));
  CHECK(card.text.find("bulk: approximated") != std::string::npos);
  CHECK(card.text.find("7.4e-05") != std::string::npos);
}
