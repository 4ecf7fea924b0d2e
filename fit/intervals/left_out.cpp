#include "fit/intervals/left_out.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>

namespace viscard {
namespace {

enum class Kind { kLost, kByFormula, kOutside };

struct Reason {
  const char* key;
  Kind kind;
  const char* text;           // after "N rows"
  const char* one = nullptr;  // after "1 row", where it differs
};

constexpr std::array kReasons{
    Reason{left_out::kNotANumber, Kind::kLost, "without a number"},
    Reason{left_out::kIsotherm, Kind::kLost, "of isotherms outside the master curve",
           "of an isotherm outside the master curve"},
    Reason{left_out::kSpike, Kind::kLost, "that are spikes", "that is a spike"},
    Reason{left_out::kDepthSpike, Kind::kLost, "whose depth jumps away and back without the force"},
    Reason{left_out::kStamp, Kind::kLost, "with a wrong time", "with a wrong time"},
    Reason{left_out::kDropout, Kind::kLost, "that the logger lost", "that the logger lost"},
    Reason{left_out::kStuck, Kind::kLost, "of an instrument that stood still"},
    Reason{left_out::kBeforeLoad, Kind::kOutside, "before the load"},
    Reason{left_out::kSaturated, Kind::kLost, "at the end of the converter's range"},
    Reason{left_out::kGlitch, Kind::kLost, "that the amplifier garbled"},
    Reason{left_out::kBeforeZero, Kind::kOutside, "before t = 0"},
    Reason{left_out::kEarlierTouch, Kind::kOutside, "of an earlier touch"},
    Reason{left_out::kUnloading, Kind::kLost, "after the depth of a sphere or cone fell"},
    Reason{left_out::kContactLost, Kind::kLost, "after contact was lost"},
    Reason{left_out::kLifted, Kind::kByFormula, "from the move that lifted the punch off"},
    Reason{left_out::kAdhesion, Kind::kLost, "in tension (adhesion)"},
    Reason{left_out::kBeforeTest, Kind::kOutside, "before the first baseline"},
    Reason{left_out::kAfterTest, Kind::kOutside, "of the homing after the test"},
    Reason{left_out::kNotChosen, Kind::kOutside, "outside the chosen part"}};

const Reason* reason_of(const std::string& key) {
  const auto* found = std::find_if(kReasons.begin(), kReasons.end(),
                                   [&](const Reason& reason) { return key == reason.key; });
  return found == kReasons.end() ? nullptr : found;
}

std::string list_of(const FitResult& result, bool only_lost) {
  std::string text;
  for (const LeftOutRows& left : result.left_out) {
    const Reason* reason = reason_of(left.reason);
    if (reason == nullptr || (only_lost && reason->kind == Kind::kOutside)) continue;
    const bool is_single = left.count == 1 && reason->one != nullptr;
    text += (text.empty() ? "" : ", ") + counted(left.count, "row") + " " +
            (is_single ? reason->one : reason->text);
  }
  return text;
}

}  // namespace

void add_left_out(FitResult& result, const std::string& reason, std::size_t count) {
  if (count == 0) return;
  result.n_left_out += count;
  const auto known = std::find_if(result.left_out.begin(), result.left_out.end(),
                                  [&](const LeftOutRows& left) { return left.reason == reason; });
  if (known != result.left_out.end()) {
    known->count += count;
  } else {
    result.left_out.push_back({reason, count});
  }
}

void flag_left_out(FitResult& result) {
  constexpr double kVisible = 0.01, kMuch = 0.2;
  std::size_t lost = 0, by_formula = 0, outside = 0;
  for (const LeftOutRows& left : result.left_out) {
    const Reason* reason = reason_of(left.reason);
    const Kind kind = reason == nullptr ? Kind::kLost : reason->kind;
    (kind == Kind::kLost ? lost : kind == Kind::kByFormula ? by_formula : outside) += left.count;
  }
  const std::size_t rows = result.n_samples + result.n_left_out - outside;
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(rows, 1));
  };
  if (share(lost + by_formula) <= kVisible) return;
  const std::string text = text_of(100.0 * share(lost + by_formula), 2) + " % of the " +
                           counted(rows, "row") +
                           " of the test are not fitted: " + list_of(result, /*only_lost=*/true);
  if (share(lost) > kMuch) {
    result.is_trustworthy = false;
    result.flags.push_back({"rows-lost", 0,
                            text + ". Look at the record, or choose the part to fit with --crop "
                                   "auto, or --from and --to"});
  } else {
    result.flags.push_back({"rows-left-out", 0, text});
  }
}

std::string left_out_text(const FitResult& result) {
  if (result.n_left_out == 0) return "";
  return std::to_string(result.n_left_out) + " of " +
         counted(result.n_samples + result.n_left_out, "row") +
         " left out: " + list_of(result, /*only_lost=*/false);
}

}  // namespace viscard
