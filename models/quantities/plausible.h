#pragma once

#include "models/quantities/quantities.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {

// How numbers are judged: as measured or asked for at a bench, as those of a scene, or not at all
// (--plausible off, or `plausible = "off"` in a file).
enum class Plausible { kMeasured, kScene, kOff };

// "on": `otherwise`; "off": kOff. Throws std::invalid_argument for another word.
Plausible plausible_from_word(const std::string& word, Plausible otherwise);

// Why a number is not plausible, in the words of a message.
struct Doubt {
  double value = 0.0;      // SI
  std::string value_text;  // "2 Pa"
  std::string range;       // "100 Pa to 1 TPa"
  std::string reason;      // of the range
  std::string sign;        // "it must be positive": no unit helps, and no range is named
  std::string meant;  // "2 MPa": the same number in a unit that makes it plausible; may be empty
  double meant_factor =
      1.0;  // SI per that unit; negative: it flips a column of the other sign, too

  // "is 2 Pa; plausible are 100 Pa to 1 TPa (from the softest gels ...)".
  std::string text() const;
  // "is 2 Pa; ... . If 2 MPa was meant, write E0 = "2 MPa"; if the value is right, add --plausible
  // off", from the two things to do. For a wrong sign the text alone, because neither would help.
  std::string with_remedy(const std::string& write_meant, const std::string& accept) const;
};

// Nothing if the value is plausible. Numbers that are not finite are not judged.
std::optional<Doubt> doubt_about(const Quantity& quantity, double value, Plausible judged);
// Nothing if a number can have that sign, at any size. value: in the SI unit of the quantity.
std::optional<Doubt> doubt_about_sign(const Quantity& quantity, double value);
// The same of a column, by the kind of the quantity; values: in its SI unit. If all of them have
// the wrong sign, the factor of the doubt flips them.
std::optional<Doubt> doubt_about(const Quantity& quantity, const std::vector<double>& values,
                                 Plausible judged);

// "100 Pa", "1 TPa", "30 days": a number in SI with a prefix that makes it short;
// value: in that SI unit.
std::string text_with_unit(double value, const std::string& unit);

// A linear law describes strains up to a tenth well. Above a half a strain is refused unless its
// unit was stated, because a number without one is often per cent.
inline constexpr double kDoubtfulStrain = 0.1;  // a pure number
// The largest one without a unit, a pure number.
inline constexpr double kLargestBareStrain = 0.5;
// Depth of a tip over the thickness of the layer: small strains below the first, and a rigid base
// at the second.
inline constexpr double kDoubtfulDepth = 0.3;  // a pure number
// Depth at the rigid base, a pure number.
inline constexpr double kDeepest = 1.0;

// A number of a file has a wrong unit, or is not plausible.
class BadNumber : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Name of the flag of a result for which implausible numbers were accepted, and its text.
inline constexpr const char* kPlausibleOff = "plausible-off";
inline constexpr const char* kPlausibleOffText =
    "the ranges of plausible values were switched off (plausible = off)";

}  // namespace viscard
