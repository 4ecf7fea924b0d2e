#include "io/flow/design/remedies.h"

#include "io/config/quantity_text.h"
#include "io/config/toml_text.h"
#include "io/flow/design/verdict.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

// As [geometry] has them, in the order of the workshop.
constexpr const char* kDimensions[] = {"geometry.diameter",       "geometry.length",
                                       "geometry.spacing",        "geometry.thickness",
                                       "geometry.film.thickness", "geometry.electrode.radius"};

constexpr int kDoublings = 2;
constexpr int kWorse = 2;       // doublings away from the limit after which a direction is given up
constexpr int kNarrowings = 3;  // of the bracket
constexpr double kNarrow = 1.005;

// To three digits, away from the value that fails.
double rounded(double passing_m, double failing_m) {
  const double unit = std::pow(10.0, std::floor(std::log10(passing_m)) - 2.0);
  const double count = passing_m / unit;
  return unit * (passing_m > failing_m ? std::ceil(count - 1e-9) : std::floor(count + 1e-9));
}

// A value of the dimension, and the logarithm of the margin with which the quantity certainly keeps
// the limit: below 0 it does not keep it. NaN: not answered.
struct Tried {
  double value_m = 0.0, sure = 0.0;
};

// A search outward from the value in the scene.
class RemedySearch {
 public:
  RemedySearch(double limit, bool is_upper, const QuantityAt& quantity_at)
      : limit_(limit), is_upper_(is_upper), quantity_at_(quantity_at) {}

  std::optional<Remedy> outward(double from_m, double factor) const {
    Tried failing = tried(from_m);
    int worse = 0;
    for (int i = 0; i < kDoublings && worse < kWorse; ++i) {
      const Tried next = tried(failing.value_m * factor);
      if (next.sure >= 0.0) return between(from_m, failing, next);
      worse = next.sure > failing.sure ? 0 : worse + 1;
      failing = next;
    }
    return std::nullopt;
  }

 private:
  Tried tried(double value_m) const {
    const RequiredValue found = quantity_at_(value_m);
    if (!found.is_answered) return {value_m, std::nan("")};
    const double size = std::max(std::abs(found.value), 1e-300);
    const double spare = is_upper_ ? std::log(limit_ / size) : std::log(size / limit_);
    return {value_m, spare - found.error_estimate / size};
  }

  // Regula falsi on logarithms, in which most quantities are straight lines; never close to an end.
  std::optional<Remedy> between(double from_m, Tried failing, Tried passing) const {
    for (int i = 0; i < kNarrowings; ++i) {
      const double width = std::log(passing.value_m / failing.value_m);
      if (std::abs(width) < std::log(kNarrow)) break;
      double share = failing.sure / (failing.sure - passing.sure);
      share = std::isfinite(share) ? std::clamp(share + 0.002, 0.02, 0.98) : 0.5;
      const Tried middle = tried(failing.value_m * std::exp(share * width));
      (middle.sure >= 0.0 ? passing : failing) = middle;
    }
    // The rounded value may be undecided; then try one or two further steps outward.
    const double step = passing.value_m > failing.value_m ? 1.005 : 1.0 / 1.005;
    double value_m = passing.value_m;
    for (int i = 0; i < 4; ++i) {
      const double shown_m = rounded(value_m, failing.value_m);
      RequiredValue found = quantity_at_(shown_m);
      if (verdict_of(found, limit_, is_upper_) == Verdict::kPass) {
        return Remedy{.from_m = from_m, .to_m = shown_m, .found = std::move(found)};
      }
      value_m *= step;
    }
    return std::nullopt;
  }

  double limit_;
  bool is_upper_;
  const QuantityAt& quantity_at_;
};

}  // namespace

std::vector<SceneDimension> dimensions_of(const std::string& text,
                                          const std::filesystem::path& path) {
  const toml::table table = parsed_toml(text, path.string());
  std::vector<SceneDimension> found;
  for (const char* const key : kDimensions) {
    const auto node = table.at_path(key);
    if (const auto number = node.value<double>()) {
      found.push_back({key, *number});
    } else if (const auto words = node.value<std::string>()) {
      const auto uncertain = uncertain_from_text(*words, "m");
      found.push_back({key, uncertain ? uncertain->value : quantity_from_text(*words, "m")});
    }
  }
  return found;
}

std::optional<Remedy> seek_remedy(double from_m, double limit, bool is_upper,
                                  const QuantityAt& quantity_at) {
  const RemedySearch search(limit, is_upper, quantity_at);
  auto larger = search.outward(from_m, 2.0);
  auto smaller = search.outward(from_m, 0.5);
  if (!larger) return smaller;
  if (!smaller) return larger;
  return larger->to_m / from_m <= from_m / smaller->to_m ? larger : smaller;
}

}  // namespace viscard
