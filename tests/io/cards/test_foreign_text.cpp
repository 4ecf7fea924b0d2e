// What other editors and programs make of a card: exponents of Fortran, byte order marks, blocks
// pasted twice, numbers a few digits off, modules without their header.
#include "io/cards/card.h"
#include "io/cards/check_card.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

using namespace viscard;
using namespace viscard::test;

namespace {

// A card without its header, as other programs write them.
std::string bare_card(const std::string& target) {
  const CardTarget& known = card_target(target);
  const std::string text =
      write_card(reference_material(), known, {.units = "mm-t-s", .is_reproducible = true}).text;
  std::string out;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (line.rfind(known.comment, 0) != 0) out += line + "\n";
    begin = end + 1;
  }
  return out;
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  INFO("looking for: " << from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

CardCheck checked(const std::string& text, const char* target) {
  const Material material = reference_material();
  return check_card(text, card_target(target), {.units = "mm-t-s"}, &material);
}

std::string names_in(const CardCheck& check) {
  std::string out;
  for (const CardFinding& finding : check.findings) {
    out += (out.empty() ? "" : " ") + finding.name;
  }
  return out;
}

}  // namespace

TEST_CASE("an exponent of Fortran is a mistake where the solver does not read it", "[cards]") {
  struct Edit {
    const char* target;
    const char* from;
    const char* to;
  };
  for (const Edit& edit : {Edit{"febio", "<E>1.88</E>", "<E>1.88D+00</E>"},
                           Edit{"febio", "<E>1.88</E>", "<E>.188d1</E>"},
                           Edit{"mfront", "E0 = 1.88;", "E0 = 1.88D+00;"},
                           Edit{"moose", "young_modulus = 1.88", "young_modulus = 188D-02"},
                           Edit{"sfepy", "E0 = 1.88", "E0 = 1.88d+00"}}) {
    CAPTURE(edit.target);
    const CardCheck check = checked(with(bare_card(edit.target), edit.from, edit.to), edit.target);
    CHECK_FALSE(check.agrees);
    CHECK(names_in(check).find("fortran-exponent") != std::string::npos);
  }
  for (const Edit& edit : {Edit{"abaqus", "1.88, 0.495", "1.88D+00, 0.495"},
                           Edit{"calculix", ", 1., 0.", ", 1.D+00, 0."},
                           Edit{"frontistr", "1.88, 0.495", "1.88D+00, 4.95-01"}}) {
    CAPTURE(edit.target);
    CHECK(checked(with(bare_card(edit.target), edit.from, edit.to), edit.target).agrees);
  }
}

TEST_CASE("a byte order mark is named, and a mistake where it hides the first keyword", "[cards]") {
  const std::string mark = "\xEF\xBB\xBF";
  for (const char* target : {"abaqus", "ansys", "calculix", "lsdyna", "frontistr"}) {
    CAPTURE(target);
    const CardCheck check = checked(mark + bare_card(target), target);
    CHECK_FALSE(check.agrees);
    CHECK(names_in(check) == "byte-order-mark");
  }
  for (const char* target : {"febio", "comsol", "sfepy"}) {
    CAPTURE(target);
    const CardCheck check = checked(mark + bare_card(target), target);
    CHECK(check.agrees);
    CHECK(names_in(check) == "byte-order-mark");
  }
}

TEST_CASE("a MOOSE block that was pasted twice is named", "[cards]") {
  const std::string moose = bare_card("moose");
  CHECK(names_in(checked(moose, "moose")).empty());
  CHECK(names_in(checked(moose + moose, "moose")) == "doubled-block");
}

TEST_CASE("a number that is no rounding is named even where E(t) agrees", "[cards]") {
  // nu 0.495 -> 0.49500005 changes K by 2e-5 and E(t) not at all.
  const CardCheck check = checked(with(bare_card("abaqus"), "0.495", "0.49500005"), "abaqus");
  CHECK(check.agrees);
  REQUIRE(names_in(check) == "digits-differ");
  CHECK(check.findings[0].text.find("nu is 0.49500005 where 0.495 is expected") == 0);
  // The bulk modulus rounded to five digits is a rounding.
  CHECK(names_in(checked(with(bare_card("lsdyna"), "62.666667", "   62.667"), "lsdyna")).empty());
}

TEST_CASE("the Poisson ratio is not blamed for a wrong modulus", "[cards]") {
  // K and all branches doubled: E is twice, nu as it was.
  std::string text = with(bare_card("lsdyna"), "62.666667", "125.33333");
  text = with(text, ".61488827", "1.2297765");
  text = with(text, ".005159625", " .01031925");
  text = with(text, ".008714649", ".017429298");
  const CardCheck check = checked(text, "lsdyna");
  CHECK_FALSE(check.agrees);
  CHECK(names_in(check).find("poisson-ratio") == std::string::npos);
}

TEST_CASE("an edited line of a Python card is named without the header, too", "[cards]") {
  for (const char* target : {"sfepy", "dolfinx"}) {
    CAPTURE(target);
    const std::string text = bare_card(target);
    CHECK(names_in(checked(text, target)).empty());
    const CardCheck check = checked(with(text, "K0 = E0 / (3", "K0 = E0 / (30"), target);
    CHECK_FALSE(check.agrees);
    CHECK(names_in(check) == "form-differs");
  }
}
