#include "models/array/contact/press_notes.h"

#include "models/answer/scene_mistake.h"
#include "models/maths/text_of_number.h"

#include <algorithm>

namespace viscard {
namespace {

std::string of_buckling(const PressState& state, const AtLimit& worst) {
  return "beyond buckling: pillar " + worst.place + " bears " + text_of(worst.value, 4) +
         " Pa; with a free top it buckles at " + text_of(state.free_Pa, 4) + " Pa, under a " +
         (state.sticks ? "shape that it sticks to" : "plate that slides") + " at about " +
         text_of(state.held_Pa, 3) +
         (!state.sticks && worst.value > state.held_Pa ? " Pa, which is exceeded too" : " Pa") +
         ". The answer is that of pillars that stay straight";
}

std::string of_pull(const PressState& state, const AtLimit& worst) {
  return "beyond pull-off: pillar " + worst.place + " is pulled by " + text_of(worst.value, 4) +
         " " + state.force_unit + ", and at a work of adhesion of " + text_of(state.work_J_m2, 3) +
         " J/m2 its top lets go at " + text_of(worst.limit, 4) + " " + state.force_unit;
}

void note_held(const PressState& state, std::vector<std::string>& notes) {
  if (!state.adheres) return;
  notes.push_back("adhesion pulls " + std::to_string(state.held) + " tops, and " +
                  std::to_string(state.let_go) +
                  " have let go; tops that touch are taken to lie flat");
}

}  // namespace

std::vector<std::string> press_notes(const PressState& state) {
  std::vector<std::string> notes;
  if (!state.touches) {
    note_held(state, notes);
    notes.push_back("the shape touches no pillar; lower it, or move it over the " + state.body);
    return notes;
  }
  if (state.sticks) {
    notes.emplace_back(
        "full stick: what touches at the end is held as if it had never slid, in one step; this is "
        "for a depth that only grows");
  }
  const auto note = [&](const AtLimit& worst, const std::string& text) {
    if (worst.value > worst.limit) notes.push_back(text);
  };
  const bool is_pressed = !(state.stretch.value > state.shortening.value);
  const AtLimit& strain = is_pressed ? state.shortening : state.stretch;
  note(state.pressure, of_buckling(state, state.pressure));
  note(strain, "large strain: pillar " + strain.place +
                   (is_pressed ? " shortens by " : " is stretched by ") +
                   text_of(100.0 * strain.value, 3) + " %; the answer is that of small strains");
  note(state.slope, "steep shape: its surface rises by " + text_of(state.slope.value, 2) +
                        " over pillar " + state.slope.place +
                        "; tops are taken to be nearly level, and their sides do not touch");
  note(state.sideways, "neighbours meet: the top of pillar " + state.sideways.place + " moves " +
                           micrometres(state.sideways.value, 3) +
                           " sideways, more than half of the smallest gap of " +
                           micrometres(2.0 * state.sideways.limit, 4) +
                           "; contact of their sides is not followed");
  note(state.lean, "large rotation: pillar " + state.lean.place + " leans by " +
                       text_of(100.0 * state.lean.value, 3) +
                       " % of its length where it is dragged; the answer is that of small "
                       "rotations");
  note(state.pull, of_pull(state, state.pull));
  note_held(state, notes);
  return notes;
}

void check_press_place(const ShapePress& press, const std::string& force_words, double length_m) {
  if ((press.depth_m > 0.0 || !press.before_m.empty()) == (press.force_N > 0.0)) {
    throw SceneMistake("shape",
                       "needs either a depth, such as depth = \"3 um\", or " + force_words);
  }
  const std::vector<double> path_m = path_of(press);
  if (*std::max_element(path_m.begin(), path_m.end()) > length_m) {
    throw SceneMistake("shape.depth",
                       "is more than the pillars' length of " + micrometres(length_m));
  }
}

void check_press_plan(const ShapePress& press, const PressPlan& plan) {
  if (press.force_N > 0.0 && !plan.touches) {
    throw SceneMistake("shape", "there is no pillar under the shape; move it with shape.at");
  }
  if (plan.shortening >= 1.0) {
    throw SceneMistake(
        press.force_N > 0.0 ? "shape.force" : "shape.depth",
        "would press the pillars flat; they are " + micrometres(plan.length_m) + " long");
  }
  if (!plan.feels_contact && !plan.covers_all) {
    throw SceneMistake(
        "effects.contact",
        "cannot be off: the shape does not cover all tops, which could not follow it");
  }
}

void check_in_section(const RigidShape& shape) {
  if (shape.y_m == 0.0 && shape.tilt_y == 0.0 && shape.direction_rad == 0.0) return;
  throw SceneMistake("shape",
                     "lies in the section of x and z: at and tilt along y must be 0, and there is "
                     "no direction");
}

}  // namespace viscard
