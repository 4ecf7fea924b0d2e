// Mutation tests of --check: edits of a right card are each named, or harmless.
#include "io/cards/card.h"
#include "io/cards/card_lines.h"
#include "io/cards/check_card.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_edits.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cstdlib>
#include <functional>
#include <iostream>
#include <random>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

std::string right_card(const char* target, const Material& material = reference_material()) {
  return write_card(material, card_target(target), {.units = "mm-t-s", .is_reproducible = true})
      .text;
}

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  INFO("looking for: " << from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// The names of all findings, or the text of the error.
std::string findings_of(const std::string& text, const char* target,
                        const Material& material = reference_material()) {
  try {
    std::string names;
    for (const CardFinding& finding :
         check_card(text, card_target(target), {.units = "mm-t-s"}, &material).findings) {
      names += (names.empty() ? "" : " ") + finding.name;
    }
    return names;
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

enum class Verdict { kNamed, kAgrees, kUnnamed };

Verdict verdict_of(const std::string& text, const CardTarget& target, const Material& material) {
  try {
    const CardCheck check = check_card(text, target, {}, &material);
    for (const CardFinding& finding : check.findings) {
      if (finding.name != "differs") return Verdict::kNamed;
    }
    return check.agrees ? Verdict::kAgrees : Verdict::kUnnamed;
  } catch (const std::runtime_error& error) {
    return std::string(error.what()).empty() ? Verdict::kUnnamed : Verdict::kNamed;
  } catch (const std::invalid_argument& error) {
    return std::string(error.what()).empty() ? Verdict::kUnnamed : Verdict::kNamed;
  }
}

}  // namespace

TEST_CASE("a card without its viscoelastic keyword is named", "[cards]") {
  const std::string abaqus = right_card("abaqus"), frontistr = right_card("frontistr");
  CHECK(findings_of(abaqus.substr(0, abaqus.find("*VISCOELASTIC")), "abaqus") ==
        "missing-viscoelastic");
  CHECK(findings_of(frontistr.substr(0, frontistr.find("!VISCOELASTIC")), "frontistr") ==
        "missing-viscoelastic");
  CHECK(findings_of(
            edited(right_card("calculix"), "*CREEP, LAW=NORTON\n332.15513131443174, 1., 0.\n", ""),
            "calculix") == "missing-creep");
}

TEST_CASE("a missing row, a doubled one and one number off are named", "[cards]") {
  const std::string abaqus = right_card("abaqus"), row = "0.01386, 0.01386, 2.403\n";
  CHECK(findings_of(edited(abaqus, row, ""), "abaqus") == "missing-row");
  CHECK(findings_of(edited(abaqus, row, row + row), "abaqus") == "doubled-row");
  CHECK(findings_of(edited(abaqus, ", 2.403", ", 2403"), "abaqus").find("one-number-unit") == 0);
  CHECK(findings_of(edited(abaqus, ", 2.403", ", 3.1"), "abaqus").find("one-number") == 0);
  const std::string lsdyna = right_card("lsdyna");
  CHECK(findings_of(edited(lsdyna, ".008714649 .41614648\n", ""), "lsdyna") == "missing-row");
  const Material material = reference_material();
  const CardCheck check = check_card(edited(abaqus, ", 2.403", ", 2403"), card_target("abaqus"),
                                     {.units = "mm-t-s"}, &material);
  CHECK(check.findings.at(0).text.find("tau of the term g = 0.01386") == 0);
}

TEST_CASE("a decimal comma is named", "[cards]") {
  CHECK(findings_of(
            edited(right_card("abaqus"), "0.01386, 0.01386, 2.403", "0.01386, 0.01386, 2,403"),
            "abaqus")
            .find("decimal-comma") == 0);
  CHECK(findings_of(edited(right_card("abaqus"), "1.88, 0.495", "1,88, 0.495"), "abaqus")
            .find("decimal-comma") == 0);
  CHECK(findings_of(edited(right_card("frontistr"), " 0.01386, 2.403", " 0,01386, 2.403"),
                    "frontistr")
            .find("decimal-comma") == 0);
  CHECK(findings_of(edited(right_card("febio"), "<E>1.88</E>", "<E>1,88</E>"), "febio")
            .find("'1,88' is not a number") != std::string::npos);
}

TEST_CASE("right numbers in a card that does something else are named", "[cards]") {
  CHECK(findings_of(edited(right_card("ansys"), "MP,EX,1,", "MP,EX,2,"), "ansys")
            .find("material-number-differs") == 0);
  CHECK(findings_of(edited(right_card("mfront"), "real(1)", "real(2)"), "mfront") ==
        "integrator-differs");
  CHECK(findings_of(edited(right_card("mfront"), "Nt = 2", "Nt = 3"), "mfront") == "array-size");
  CHECK(
      findings_of(edited(right_card("frontistr"), "!VISCOELASTIC, INFINITESIMAL", "!VISCOELASTIC"),
                  "frontistr")
          .find("finite-strain") == 0);
  CHECK(
      findings_of(edited(right_card("moose"), "    integration_rule = zienkiewicz\n", ""), "moose")
          .find("integration-rule") == 0);
  CHECK(findings_of(edited(right_card("febio"), "isotropic elastic", "neo-Hookean"), "febio") ==
        "elastic-type");
  CHECK(findings_of(edited(right_card("febio"), "  </elastic>\n", ""), "febio")
            .find("an element is closed that is not open") != std::string::npos);
  // Three moduli, two times: the third branch has no partner.
  const Card mfront = write_card(reference_material(), card_target("mfront"), {.units = "mm-t-s"});
  const std::string third = "@MaterialProperty<constant> 'ViscoelasticShearModulus[2]' 0.1;\n";
  CHECK(findings_of(mfront.companions.at(0).text + third, "mfront")
            .find("property-without-partner") == 0);
  // By FrontISTR's source the last of the two keywords decides the type of the material.
  CHECK(findings_of("!MATERIAL, NAME=R\n!VISCOELASTIC, INFINITESIMAL\n.008206,.1945\n"
                    ".01386,2.403\n!ELASTIC, INFINITESIMAL\n1.88,.495\n",
                    "frontistr")
            .find("elastic-after-viscoelastic") == 0);
}

TEST_CASE("an MFront card that lost its parameters is named", "[cards]") {
  CHECK(findings_of("@DSL Default;\n@Behaviour A;\n@Parameter real E0 = 1.88;\n"
                    "@Parameter real nu0 = 0.495;\n",
                    "mfront")
            .find("array-size") != std::string::npos);
  const std::string mfront = right_card("mfront");
  const std::size_t from = mfront.find("@Parameter real g"), to = mfront.find("@StateVariable");
  CHECK_FALSE(findings_of(mfront.substr(0, from) + mfront.substr(to), "mfront").empty());
}

TEST_CASE("a COMSOL card with E0 beside nu_inf is blamed on the modulus", "[cards]") {
  const std::string comsol = right_card("comsol");
  const std::size_t at = comsol.find("PDMS_Einf ") + 10;
  const std::string young = comsol.substr(at, comsol.find('[', at) - at);
  CHECK(findings_of(edited(comsol, young + "[MPa]", "1.88[MPa]"), "comsol") ==
        "instantaneous-modulus-as-long-term");
}

TEST_CASE("an edit that no reader sees is reported with its line", "[cards]") {
  const Material material = reference_material();
  const std::string text = edited(right_card("moose"), "[strain]", "[deformation]");
  const CardCheck check = check_card(text, card_target("moose"), {}, &material);
  REQUIRE(check.findings.size() == 1);
  CHECK(check.findings[0].name == "form-differs");
  CHECK(check.findings[0].text.find("where viscard writes '[strain]'") != std::string::npos);
  const std::string json = edited(right_card("json"), "\"G0\": 0.62", "\"G0\": 0.72");
  CHECK(findings_of(json, "json") == "form-differs");
  CHECK(findings_of(right_card("mfront") + "}\n", "mfront") == "doubled-line");
  CHECK(findings_of(edited(right_card("sfepy"), "        self.strain = strain.copy()",
                           "    self.strain = strain.copy()"),
                    "sfepy") == "form-differs");
  const std::string csv = right_card("csv");
  const std::size_t row = csv.find('\n', csv.find("time_")) + 1;
  const std::size_t third = csv.find(',', csv.find(',', row) + 1) + 1;
  CHECK(findings_of(std::string(csv).insert(third, "1"), "csv") == "table-differs");
  // E(t) no longer changes at the end of the table, so a wrong time there keeps its modulus.
  const std::size_t last = csv.rfind('\n', csv.size() - 2) + 1;
  CHECK_THAT(findings_of(csv + csv.substr(last), "csv"), Catch::Contains("do not increase"));
}

TEST_CASE("a doubled line of any card is a mistake, not a note", "[cards]") {
  for (const CardTarget& target : card_targets()) {
    Material material = reference_material();
    if (target.max_terms == 1) material.terms.resize(1);
    const std::string text = right_card(target.name.c_str(), material);
    const std::size_t header = target.comment.empty() ? text.find("\"header\"") : text.size();
    for (std::size_t at = 0, end = 0; at < header; at = end) {
      end = text.find('\n', at) + 1;
      const std::string line = text.substr(at, end - at);
      const bool is_comment = !target.comment.empty() && line.rfind(target.comment, 0) == 0;
      if (is_comment || line.find_first_not_of(" \n") == std::string::npos) continue;
      CAPTURE(target.name, line);
      bool agrees = false;
      try {
        agrees =
            check_card(text.substr(0, at) + line + text.substr(at), target, {}, &material).agrees;
      } catch (const std::runtime_error& error) {
        CHECK_FALSE(std::string(error.what()).empty());
      }
      CHECK_FALSE(agrees);
    }
  }
}

TEST_CASE("foreign lines of a Python card and lost rows of a table are mistakes", "[cards]") {
  for (const char* target : {"sfepy", "dolfinx"}) {
    INFO(target);
    CHECK(findings_of(right_card(target) + "G_inf = 7.0\n", target) == "form-differs");
    CHECK_FALSE(
        check_card(right_card(target) + "G_inf = 7.0\n", card_target(target), {}, nullptr).agrees);
  }
  const std::string table = right_card("abaqus-table");
  std::size_t first = table.find("TABULAR");
  for (int row = 0; row < 5; ++row) first = table.find('\n', first + 1);
  std::size_t last = first;
  for (int row = 0; row < 3; ++row) last = table.find('\n', last + 1);
  const std::string gap = table.substr(0, first) + table.substr(last);
  CHECK_THAT(findings_of(gap, "abaqus-table"), Catch::Contains("missing-rows"));
  CHECK_THAT(findings_of(table.substr(0, last + 1), "abaqus-table"),
             Catch::Contains("missing-rows"));
}

TEST_CASE("what no reader uses is named in a card without header", "[cards]") {
  const auto bare = [](const char* target) {
    std::string out;
    const CardTarget& found = card_target(target);
    for (const CardLine& line : card_lines(right_card(target), found.comment))
      out += line.text + "\n";
    return out;
  };
  const auto unread = [](const std::string& text, const char* target) {
    return findings_of(text, target).find("not-read") != std::string::npos;
  };
  struct Foreign {
    const char *target, *text;
  };
  const std::vector<Foreign> all{{"abaqus", "*FOOBAR\n1., 2.\n"},
                                 {"abaqus", "*MULLINS EFFECT\n1.5, 0.1, 0.1\n"},
                                 {"abaqus-frequency", "*PLASTIC\n1., 0.\n"},
                                 {"abaqus-table", "*EXPANSION\n1e-4\n"},
                                 {"calculix", "*DAMPING, ALPHA=0.1\n"},
                                 {"frontistr", "!EXPANSION_COEFF\n1e-4\n"},
                                 {"ansys", "MP,ALPX,1,1e-4\n"},
                                 {"lsdyna", "*MAT_ADD_EROSION\n         1       1.0\n"},
                                 {"lsdyna", "*DAMPING_GLOBAL\n         1       1.0\n"},
                                 {"openradioss", "/VISC/PRONY/1\n         1\n"},
                                 {"openradioss", "/DAMP/1\nd\n                 0.1\n"},
                                 {"moose", "[Materials]\n[foo]\ntype = Foo\n[]\n[]\n"}};
  for (const Foreign& foreign : all) {
    CAPTURE(foreign.target, foreign.text);
    CHECK(findings_of(bare(foreign.target), foreign.target) == "");
    CHECK(unread(bare(foreign.target) + foreign.text, foreign.target));
  }
  // Cells that the card's law leaves at 0, and a unit block that is not there.
  const std::string radioss = bare("openradioss"), zero = "                 0.0\n";
  CHECK(unread(edited(radioss, zero, "                 7.0\n"), "openradioss"));
  CHECK(findings_of(edited(radioss, "/UNIT/1", "/UNIT/2"), "openradioss") == "unit-block");
  CHECK(findings_of(edited(radioss, "LAW40/1/", "LAW40/0/"), "openradioss") == "material-number");
  CHECK(findings_of(edited(bare("lsdyna"), "         1  ", "         0  "), "lsdyna") ==
        "material-number");
  // Keywords that say too little or stand twice.
  const std::string abaqus = bare("abaqus");
  CHECK(findings_of(edited(abaqus, "NAME=PDMS", "NAME="), "abaqus") == "missing-name");
  CHECK(findings_of(edited(abaqus, "*DENSITY\n", ""), "abaqus").find("data-without-keyword") == 0);
  CHECK(findings_of(edited(abaqus, "*DENSITY\n", "*DENSITY\n*DENSITY\n"), "abaqus")
            .find("DENSITY has no data line") != std::string::npos);
  CHECK(findings_of(edited(bare("moose"), "    young_modulus = 1.88\n",
                           "    young_modulus = 1.88\n    young_modulus = 1.88\n"),
                    "moose") == "doubled-parameter");
  CHECK(findings_of(edited(bare("febio"), "</material>", "<density>3</density></material>"),
                    "febio") == "not-read");
  // Choices of the solver and columns of temperature are no mistakes.
  const Material material = reference_material();
  const std::string row_of_two = "0.01386, 0.01386, 2.403";
  const CardCheck warm = check_card(edited(abaqus, row_of_two, row_of_two + ", 20."),
                                    card_target("abaqus"), {.units = "mm-t-s"}, &material);
  CHECK(warm.agrees);
  CHECK(has_unread_parts(warm.findings));
  CHECK(check_card(edited(bare("moose"), "    integration_rule = zienkiewicz\n", ""),
                   card_target("moose"), {.units = "mm-t-s"}, &material)
            .agrees);
  CHECK(check_card(edited(bare("frontistr"), "!VISCOELASTIC, INFINITESIMAL", "!VISCOELASTIC"),
                   card_target("frontistr"), {.units = "mm-t-s"}, &material)
            .agrees);
  // Every column of a table of E(t).
  const std::string csv = bare("csv");
  const std::size_t row = csv.find('\n', csv.size() / 2) + 1;
  for (int column = 0, at = static_cast<int>(row); column < 6; ++column) {
    CAPTURE(column);
    CHECK_FALSE(findings_of(std::string(csv).insert(static_cast<std::size_t>(at), "1"), "csv") ==
                "");
    at = static_cast<int>(csv.find(',', static_cast<std::size_t>(at))) + 1;
  }
}

namespace {

struct Counts {
  int named = 0, agreed = 0, unnamed = 0;
};

// Edits of one right card, each judged; those that are not named are listed on request.
Counts judge_edits(const CardTarget& target, const Material& material, int count,
                   const std::function<CardEdit(const std::string& text, int tried)>& edit_of) {
  const std::string text =
      write_card(material, target, {.units = "mm-t-s", .is_reproducible = true}).text;
  Counts counts;
  for (int done = 0, tried = 0; done < count; ++tried) {
    const CardEdit edit = edit_of(text, tried);
    if (edit.text == text) continue;
    ++done;
    const Verdict verdict = verdict_of(edit.text, target, material);
    counts.named += verdict == Verdict::kNamed ? 1 : 0;
    counts.agreed += verdict == Verdict::kAgrees ? 1 : 0;
    counts.unnamed += verdict == Verdict::kUnnamed ? 1 : 0;
    if (verdict != Verdict::kNamed && std::getenv("VISCARD_LIST_EDITS") != nullptr) {
      std::cout << fmt::format("{} {} {}: '{}' -> '{}'\n", target.name,
                               verdict == Verdict::kAgrees ? "agrees" : "UNNAMED", edit.kind,
                               edit.line, edit.now);
    }
  }
  return counts;
}

Material material_for(const CardTarget& target) {
  Material material = reference_material();
  if (target.max_terms == 1) material.terms.resize(1);
  return material;
}

const std::string& kind_of(int tried) {
  return kEditKinds[static_cast<std::size_t>(tried) % kEditKinds.size()];
}

}  // namespace

TEST_CASE("random edits of a right card are named or harmless", "[cards][slow]") {
  for (const CardTarget& target : card_targets()) {
    std::mt19937 random(17);
    const Counts body =
        judge_edits(target, material_for(target), 200, [&](const std::string& text, int tried) {
          return random_edit(text, target.comment, kind_of(tried), random);
        });
    std::cout << fmt::format("{:<16} named {:>3}, agrees {:>3}, unnamed {:>3}\n", target.name,
                             body.named, body.agreed, body.unnamed);
    CHECK(body.unnamed == 0);
  }
}

TEST_CASE("random edits of the header of a right card are named or harmless", "[cards][slow]") {
  for (const CardTarget& target : card_targets()) {
    if (target.comment.empty()) continue;  // its header is part of the body
    std::mt19937 random(18);
    const Counts header =
        judge_edits(target, material_for(target), 200, [&](const std::string& text, int tried) {
          return random_edit(text, target.comment, kind_of(tried), random, EditPlace::kHeader);
        });
    std::cout << fmt::format("{:<16} header named {:>3}, agrees {:>3}, unnamed {:>3}\n",
                             target.name, header.named, header.agreed, header.unnamed);
    CHECK(header.unnamed == 0);
  }
}

TEST_CASE("a second, contradicting card in the same file is named", "[cards]") {
  for (const CardTarget& target : card_targets()) {
    std::mt19937 random(19);
    const Counts second =
        judge_edits(target, material_for(target), 20, [&](const std::string& text, int) {
          return with_second_element(text, target.comment, random);
        });
    CAPTURE(target.name);
    CHECK(second.agreed == 0);
    CHECK(second.unnamed == 0);
  }
}
