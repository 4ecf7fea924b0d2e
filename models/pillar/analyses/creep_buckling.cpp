#include "models/pillar/analyses/creep_buckling.h"

#include "models/answer/scene_mistake.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace viscard {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Falls with time from the instantaneous to the long-term buckling pressure.
struct FallingLimit {
  double now_Pa = kNever, long_term_Pa = kNever;
  PronySeries young;  // E(t)

  // E(t)/E_0 at which the buckling pressure is this one.
  double share_at(double pressure_Pa) const {
    const double E0_Pa = instantaneous_modulus_Pa(young);
    const double lasting = young.equilibrium_modulus_Pa / E0_Pa;
    return lasting + (1.0 - lasting) * (pressure_Pa - long_term_Pa) / (now_Pa - long_term_Pa);
  }
  // How long the pillar bears a pressure.
  double bears_s(double pressure_Pa) const {
    if (pressure_Pa <= long_term_Pa) return kNever;
    if (pressure_Pa >= now_Pa) return 0.0;
    const double E_Pa = share_at(pressure_Pa) * instantaneous_modulus_Pa(young);
    double high_s = 0.0;
    for (const MaxwellTerm& term : young.terms) {
      high_s = std::max(high_s, 100.0 * term.relaxation_time_s);
    }
    double low_s = 0.0;
    for (int i = 0; i < 1100 && low_s < high_s * (1.0 - 1e-12); ++i) {  // E(t) falls from E_0
      const double middle_s = low_s > 0.0 ? std::sqrt(low_s * high_s) : 0.5 * high_s;
      if (relaxation_modulus_Pa(young, middle_s) > E_Pa) {
        low_s = middle_s;
      } else {
        high_s = middle_s;
      }
    }
    return high_s;
  }
};

// The largest pressure on the top that acts long enough for creep; 0 if there is none.
double staying_pressure_Pa(const PillarScene& scene) {
  const Analysis& analysis = analysis_of(scene);
  if (scene.pillar.terms.empty() || holds_straight(scene) || !scene.fixed_bottom) return 0.0;
  if (is_lateral(scene) || moves_top(scene) || load_place(scene) == LoadPlace::kBase) return 0.0;
  if (analysis.load_stays) return pressure_Pa(scene);
  if (analysis.swings_from_Hz != nullptr) return std::abs(pressure_Pa(scene));
  double largest_Pa = 0.0;
  if (analysis.history != HistoryOf::kPressure) return largest_Pa;
  for (const CoursePoint& point : history(scene)) largest_Pa = std::max(largest_Pa, point.value);
  return largest_Pa;
}

// The limits of a scene whose load comes near the long-term limit; otherwise infinite.
FallingLimit limit_of(const PillarScene& scene, double pressure_Pa) {
  FallingLimit limit;
  const PillarScene relaxed = long_term_scene(scene);
  const bool is_liquid = !(relaxed.pillar.E0_Pa > 1e-9 * scene.pillar.E0_Pa);
  if (!is_liquid && pressure_Pa < rough_buckling_pressure_Pa(relaxed)) return limit;
  limit.now_Pa = pillar_buckling_pressure_Pa(scene);
  limit.long_term_Pa = is_liquid ? 0.0 : pillar_buckling_pressure_Pa(relaxed);
  limit.young = young_series(scene.pillar);
  return limit;
}

// The first time at which a history has stayed above a level for as long as the pillar bears that
// level.
double buckles_at_s(const Course& points, double level, double bears_s) {
  double since_s = points.front().value >= level ? points.front().time_s : kNever;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const CoursePoint& from = points[i - 1];
    const CoursePoint& to = points[i];
    const double share = (level - from.value) / (to.value - from.value);  // if it crosses
    const double crossed_s = from.time_s + share * (to.time_s - from.time_s);
    if (from.value < level && to.value >= level) since_s = crossed_s;
    const double until_s = to.value >= level ? to.time_s : crossed_s;
    if (since_s < kNever && since_s + bears_s <= until_s) return since_s + bears_s;
    if (to.value < level) since_s = kNever;
  }
  return kNever;
}

// Level number `of` among the levels between the long-term limit and the largest pressure.
constexpr int kLevels = 200;
double level_Pa(const FallingLimit& limit, double largest_Pa, int number) {
  if (number == kLevels) return largest_Pa;
  const double share = static_cast<double>(number) / kLevels;
  return (1.0 - share) * limit.long_term_Pa + share * largest_Pa;
}

// Sets the time at which the pillar buckles within a history, and the level that causes it.
void find_in_history(const Course& points, const FallingLimit& limit, CreepBuckling& found) {
  const double largest_Pa = found.pressure_Pa;
  for (int i = 1; i <= kLevels; ++i) {
    const double level = level_Pa(limit, largest_Pa, i);
    const double at_s = buckles_at_s(points, level, limit.bears_s(level));
    if (!(at_s < found.at_s)) continue;
    found.at_s = at_s;
    found.pressure_Pa = level;
  }
}

// Sets the highest frequency at which the pillar buckles within a half cycle.
void find_in_cycle(const FallingLimit& limit, CreepBuckling& found) {
  for (int i = 1; i < kLevels; ++i) {
    const double level = level_Pa(limit, found.pressure_Pa, i);
    const double above_rad = 2.0 * std::acos(level / found.pressure_Pa);
    const double omega_1_s = above_rad / limit.bears_s(level);
    found.below_Hz = std::max(found.below_Hz, omega_1_s / (2.0 * std::numbers::pi));
  }
}

std::string clause_of(const CreepBuckling& found) {
  return "a pressure of " + text_of(found.pressure_Pa, 5) +
         " Pa lies between the long-term buckling pressure of about " +
         text_of(found.long_term_Pa, 4) + " Pa and the instantaneous one of about " +
         text_of(found.now_Pa, 4) + " Pa: the straight pillar bears it for about " +
         text_of(found.after_s, 3) + " s and then buckles in creep, when E(t) has fallen to " +
         text_of(100.0 * found.share, 3) + " % of E_0";
}

// For a buckling analysis, whose result is the pressure right after loading.
std::string long_term_note(const PillarScene& scene) {
  if (scene.pillar.terms.empty() || plate_on_top(scene)) return "";
  const double long_term_Pa = limit_of(scene, kNever).long_term_Pa;
  if (!std::isfinite(long_term_Pa)) return "";
  return "right after loading; a pressure that stays buckles the pillar in creep from about " +
         text_of(long_term_Pa, 4) + " Pa on (long-term moduli)";
}

}  // namespace

std::optional<CreepBuckling> creep_buckling(const PillarScene& scene) {
  CreepBuckling found;
  found.pressure_Pa = staying_pressure_Pa(scene);
  if (!(found.pressure_Pa > 0.0)) return {};
  const FallingLimit limit = limit_of(scene, found.pressure_Pa);
  if (found.pressure_Pa <= limit.long_term_Pa || found.pressure_Pa >= limit.now_Pa) return {};
  found.now_Pa = limit.now_Pa;
  found.long_term_Pa = limit.long_term_Pa;
  if (has_history(scene)) find_in_history(history(scene), limit, found);
  if (analysis_of(scene).swings_from_Hz != nullptr) find_in_cycle(limit, found);
  found.share = limit.share_at(found.pressure_Pa);
  found.after_s = limit.bears_s(found.pressure_Pa);
  return found;
}

std::string creep_buckling_note(const PillarScene& scene) {
  if (analysis_of(scene).found_pressure_Pa != nullptr) return long_term_note(scene);
  const std::optional<CreepBuckling> found = creep_buckling(scene);
  if (!found) return "";
  if (analysis_of(scene).swings_from_Hz != nullptr) {
    return clause_of(*found) + "; above about " + text_of(found->below_Hz, 3) +
           " Hz, as here, the load turns before";
  }
  if (!has_history(scene)) return clause_of(*found) + "; the answer holds until then";
  return clause_of(*found) + (std::isfinite(found->at_s)
                                  ? ", at about " + text_of(found->at_s, 3) + " s of the history"
                                  : "; the history ends or unloads it before");
}

void refuse_buckling_in_creep(const PillarScene& scene) {
  const Analysis& analysis = analysis_of(scene);
  const bool swings = analysis.swings_from_Hz != nullptr;
  if (!analysis.follows_creep && !swings) return;
  const std::optional<CreepBuckling> found = creep_buckling(scene);
  if (!found) return;
  const std::string instead =
      "stay below the long-term buckling pressure, or declare that the pillar is held straight "
      "(geometric_stiffness = \"off\" under [effects])";
  if (swings && analysis.swings_from_Hz(scene) < found->below_Hz) {
    throw SceneMistake("analysis.frequencies",
                       clause_of(*found) + ". Below about " + text_of(found->below_Hz, 3) +
                           " Hz it does so within a half cycle of the load. Begin the frequencies "
                           "above, " +
                           instead);
  }
  if (!std::isfinite(found->at_s)) return;
  throw SceneMistake("analysis.history",
                     clause_of(*found) + ", at about " + text_of(found->at_s, 3) +
                         " s of the history. End the history before, " + instead);
}

}  // namespace viscard
