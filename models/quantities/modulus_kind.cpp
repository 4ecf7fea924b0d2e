#include "models/quantities/modulus_kind.h"

#include <stdexcept>

namespace viscard {
namespace {

constexpr ModulusKindText kTexts[] = {{"tension", "E", "E = E"},
                                      {"shear", "G", "E = 2 (1 + nu) G"},
                                      {"plane-strain", "Er", "E = (1 - nu^2) Er"},
                                      {"indentation", "Er", "E = (1 - nu^2) Er"},
                                      {"bulk", "K", "E = 3 (1 - 2 nu) K"}};

}  // namespace

const ModulusKindText& text_of(ModulusKind kind) {
  return kTexts[static_cast<std::size_t>(kind)];
}

const std::vector<std::string>& modulus_kind_words() {
  static const std::vector<std::string> kWords = [] {
    std::vector<std::string> words;
    for (const ModulusKindText& text : kTexts) words.emplace_back(text.word);
    return words;
  }();
  return kWords;
}

ModulusKind modulus_kind_from_word(const std::string& word) {
  std::string known;
  for (std::size_t i = 0; i < modulus_kind_words().size(); ++i) {
    if (word == kTexts[i].word) return static_cast<ModulusKind>(i);
    known += (i == 0 ? "" : ", ") + modulus_kind_words()[i];
  }
  throw std::invalid_argument("'" + word + "' is no kind of modulus; there are " + known);
}

double young_over(ModulusKind kind, double nu) {
  if (!(nu > -1.0 && nu <= 0.5)) {
    throw std::invalid_argument("a Poisson ratio lies between -1 and 0.5");
  }
  switch (kind) {
    case ModulusKind::kTension:
      return 1.0;
    case ModulusKind::kShear:
      return 2.0 * (1.0 + nu);
    case ModulusKind::kPlaneStrain:
    case ModulusKind::kIndentation:
      return 1.0 - nu * nu;
    case ModulusKind::kBulk:
      if (nu == 0.5) {
        throw std::invalid_argument(
            "a bulk modulus gives no Young's modulus at a Poisson ratio of 0.5; state a smaller "
            "one with --poisson-ratio");
      }
      return 3.0 * (1.0 - 2.0 * nu);
  }
  return 1.0;
}

}  // namespace viscard
