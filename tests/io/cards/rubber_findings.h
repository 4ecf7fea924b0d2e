#pragma once

#include "io/cards/hyperelastic/check_rubber.h"

#include <catch2/catch.hpp>

#include <string>

namespace viscard::test {

// The text with its last `from` changed.
inline std::string with_last(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.rfind(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// What a check of the card names, "name: text|name: text|".
inline std::string rubber_findings(const std::string& card, const std::string& target,
                                   const HyperelasticFile* file) {
  std::string out;
  for (const CardFinding& finding :
       check_rubber_card(card, file, {.target = target, .units = "mm-t-s"}).findings)
    out += finding.name + ": " + finding.text + "|";
  return out;
}

}  // namespace viscard::test
