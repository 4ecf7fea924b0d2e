#pragma once

#include "models/material/frequency_band.h"
#include "models/material/material.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

struct CardTarget;

// How one part of the material was written.
enum class Mapping { kExact, kApproximated, kDropped };

// How exactly one part of the material is in the card.
struct FidelityItem {
  std::string
      item;  // "terms", "bulk", "nu", "density", "numbers", "temperature", "harmonic", "total"
  Mapping mapping = Mapping::kExact;
  std::string text;
};

// A file that the card reads, beside it.
struct CompanionFile {
  std::string suffix;  // replaces the card's extension: "_relaxation.txt"
  std::string text;
};

// The text for a solver, and how exactly it states the material.
struct Card {
  std::string name;  // of the material in the text
  std::string text;
  std::vector<CompanionFile> companions;
  std::vector<FidelityItem> fidelity;
  std::vector<std::string> warnings;  // lines of the header that say EXTRAPOLATED
  Material written;                   // what a reader of the card gets, SI
  // Of E(t), relative, over the window: from CardOptions::original, else from the given material.
  double largest_difference = 0.0;
};

// Units of a card, and what may be done to the material.
struct CardOptions {
  std::string units = "SI";
  bool is_reproducible = false;      // no date and no command line: byte-identical output
  bool may_approximate = false;      // write what the target cannot take exactly, with the error
  bool accepts_flags = false;        // write terms that the fit has flagged
  std::optional<double> clamped_nu;  // use this Poisson ratio instead of a larger one
  std::string created_at;            // ISO 8601
  std::string command;               // command line
  std::string material_sha256, material_file;  // its sum, and its name without folder
  std::vector<FidelityItem> done_before;       // changes made to the material (terms reduced ...)
  std::optional<Material> original;            // the material before those changes
  std::vector<std::string> notes;              // further header lines
  // Of a card over a band of frequencies; if not given, that which the material's data support.
  std::optional<FrequencyBand> band = {};
};

// Writes the card in memory, reads it back and compares before returning it.
// Throws std::invalid_argument with one line about what to do: unknown unit system, unphysical
// material, nu = 0.5 where K must be finite, too many terms, a stated bulk relaxation the target
// has no place for, a temperature shift likewise, flagged terms, no density where the solver needs
// one, numbers that do not fit the columns.
Card write_card(const Material& material, const CardTarget& target,
                const CardOptions& options = {});

// "exact", "approximated" or "dropped", as `mapping` says.
inline std::string to_word(Mapping mapping) {
  if (mapping == Mapping::kExact) return "exact";
  return mapping == Mapping::kApproximated ? "approximated" : "dropped";
}

}  // namespace viscard
