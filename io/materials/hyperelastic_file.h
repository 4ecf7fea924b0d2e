#pragma once

#include "models/hyperelastic/finite_viscoelasticity.h"
#include "models/hyperelastic/foam_law.h"
#include "models/hyperelastic/hyperelastic_law.h"
#include "models/hyperelastic/mullins_damage.h"
#include "models/maths/interval.h"
#include "models/quantities/plausible.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A law of rubber as `viscard fit uniaxial=a.csv ... --out FILE` writes it, schema
// "viscard-hyperelastic/1".
struct HyperelasticFile {
  HyperelasticLaw law;                       // the chosen one, at once
  std::optional<FoamLaw> foam = {};          // stands in its place, which then means nothing
  std::vector<RubberTerm> terms;             // its relaxation; empty: elastic
  std::optional<MullinsDamage> damage = {};  // its softening by the first loading
  // Young's modulus at rest: at once, and after all relaxation.
  double E0_Pa = 0.0, E_inf_Pa = 0.0;
  Interval E0_interval_95, E_inf_interval_95;
  double t_min_s = 0.0, t_max_s = 0.0;  // shortest step and longest test; 0: without times
  bool is_trustworthy = true;
  std::vector<std::string> defects;  // texts of its flags
  bool is_edited = false;            // since viscard wrote it (material_json.h)
  bool accepts_implausible = false;  // the file, or who read it, says plausible = off
  // Measured stretches, in the order of Deformation; nothing where no test measured.
  struct Range {
    double low = 1.0, high = 1.0;
  };
  std::array<std::optional<Range>, 3> measured;
  // Of a foam the tests of its own kinds, in words: "confined 0.5 to 1".
  std::string foam_tests = {};
  // A table that was fitted.
  struct RawFile {
    std::string file, sha256;
  };
  std::vector<RawFile> raw_files;
  // Of a law that was read from a card.
  std::optional<double> bulk_Pa = {}, density_kg_m3 = {};
  std::string card_doubt = {};  // why an edit of that card could not be seen; "": it states its sum
};

// Name of its law: "yeoh", "hyperfoam-2".
std::string name_of(const HyperelasticFile& file);

// A file of the law of a card that somebody sent, without tests; raw_files names the card.
std::string json_from_card_of_rubber(const HyperelasticFile& file);

// True if the file says that it is one.
bool looks_like_hyperelastic_file(const std::filesystem::path& path);

// Throws std::runtime_error naming the file and the key.
HyperelasticFile read_hyperelastic(const std::filesystem::path& path,
                                   Plausible judged = Plausible::kMeasured);
// The same from text; messages show name in place of the file.
HyperelasticFile hyperelastic_from_json(const std::string& text, const std::string& name,
                                        Plausible judged = Plausible::kMeasured);

}  // namespace viscard
