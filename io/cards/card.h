#pragma once

#include "io/cards/conventions.h"
#include "io/cards/unit_system.h"
#include "models/material/material.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// How one part of the material came through.
enum class Mapping { kExact, kApproximated, kDropped };

struct FidelityItem {
  std::string item;  // "terms", "bulk", "nu", "density", "numbers"
  Mapping mapping = Mapping::kExact;
  std::string text;
};

struct CompanionFile {
  std::string suffix;  // stands in place of the card's extension: "_relaxation.txt"
  std::string text;
};

struct Card {
  std::string text;
  std::vector<CompanionFile> companions;
  std::vector<FidelityItem> fidelity;
  Material written;                 // the material a reader of the card gets, SI
  double largest_difference = 0.0;  // of E(t) from the given material, relative, over the window
};

struct CardOptions {
  std::string target = "abaqus";
  std::string units = "SI";
  bool is_reproducible = false;      // no date and no command line: byte-identical output
  bool may_approximate = false;      // write what the target cannot take exactly, and say so
  bool accepts_flags = false;        // write terms the fit has flagged
  std::optional<double> clamped_nu;  // use this Poisson ratio instead of a larger one
  std::string created_at;            // ISO 8601
  std::string command;               // command line
  std::string material_sha256;
  std::vector<FidelityItem>
      done_before;                 // what was done to the material already (terms reduced ...)
  std::vector<std::string> notes;  // further header lines
};

// Writes the card in memory, reads it back and compares before handing it out.
// Throws std::invalid_argument with one line that says what to do: unknown target or unit system,
// unphysical material, nu = 0.5 where K must be finite, too many terms, a stated bulk relaxation
// the target has no place for, flagged terms, numbers that do not fit the columns.
Card write_card(const Material& material, const CardOptions& options);

std::string to_word(Mapping mapping);

// Times over which E(t) of two materials is compared: the validity window, or where it is unknown
// two decades beyond the relaxation times; logarithmic.
std::vector<double> comparison_times_s(const Material& material, int count = 400);
double largest_E_difference(const Material& one, const Material& reference,
                            const std::vector<double>& times_s);

}  // namespace viscard
