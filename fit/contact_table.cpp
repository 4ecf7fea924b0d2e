#include "fit/contact_table.h"

#include "fit/curves/contact_course.h"
#include "fit/samples/clean_data.h"
#include "fit/samples/depth_course.h"
#include "fit/samples/median.h"
#include "fit/samples/noise_model.h"
#include "fit/samples/spikes.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <stdexcept>

namespace viscard {
namespace {

using Column = std::vector<double>;

void check_force(std::span<const double> force_N) {
  const auto [low, high] = std::minmax_element(force_N.begin(), force_N.end());
  if (*low == *high) {
    throw std::runtime_error(
        "the force is constant (" + text_of(*low) +
        " N in all samples): there was no contact, or the column is not the force");
  }
  const double mean = std::accumulate(force_N.begin(), force_N.end(), 0.0);
  if (mean < 0.0 && -*low > *high) {
    throw std::runtime_error(
        "the force is negative at its largest magnitude, but compression must be positive. Flip "
        "the sign of the column: --column force_N=-NAME");
  }
}

// Throws unless the depth grows with the force.
void check_depth(const Column& force_N, const Column& depth_m) {
  const auto peak =
      static_cast<std::size_t>(std::max_element(force_N.begin(), force_N.end()) - force_N.begin());
  if (peak > 0 && depth_m[peak] < depth_m[0]) {
    throw std::runtime_error(
        "the depth falls while the force rises. If the depth has the other sign, flip the column: "
        "--column depth_m=-NAME");
  }
}

// A frame that yields by more than the stage moved leaves no depth.
void check_frame(const Column& force_N, const Column& depth_m, double stiffness_N_m) {
  const auto [least, most] = std::minmax_element(force_N.begin(), force_N.end());
  const auto [deepest_low, deepest] = std::minmax_element(depth_m.begin(), depth_m.end());
  const double rise_N = std::max(*most, *most - *least);
  const double moved_m = std::max(*deepest, *deepest - *deepest_low);
  const double frame_m = rise_N / stiffness_N_m;
  if (!(frame_m >= moved_m)) return;
  throw std::runtime_error(
      "a frame of " + text_of(stiffness_N_m, 4) + " N/m yields by " + text_of(1e3 * frame_m, 4) +
      " mm at " + text_of(rise_N, 4) + " N, but the position changes by " +
      text_of(1e3 * moved_m, 4) +
      " mm only. Is the unit of the frame's stiffness right? State it, such as "
      "--frame-stiffness \"10 N/mm\"");
}

void find_first_contact(ContactTable& table) {
  const FirstLoading first = first_loading(table.depth_m);
  const bool is_flat = table.law.power == 1.0;
  table.goes_back = is_flat && first.goes_back;
  table.loaded = table.goes_back ? first.loaded : end_of_loading(table.depth_m);
  table.contact = find_contact(table.force_N, table.depth_m, table.loaded, table.law.power);
}

double limit_m(const ContactTable& table) {
  return table.contact.is_fitted ? table.contact.depth_m : 0.0;
}

// Force out of contact before the first touch; 0 if the table begins in contact.
double zero_force_N(const ContactTable& table) {
  if (!table.contact.is_fitted) return 0.0;
  const auto first = static_cast<std::ptrdiff_t>(table.contact.first);
  return median(Column(table.force_N.begin(), table.force_N.begin() + first));
}

// True if the force has fallen to its value out of contact: the punch moves back faster than the
// surface follows. Single samples may be noise.
bool is_without_force(const ContactTable& table, std::size_t from, double small_N) {
  constexpr std::size_t kRun = 3;
  if (from + kRun > table.force_N.size()) return false;
  const auto begin = table.force_N.begin() + static_cast<std::ptrdiff_t>(from);
  return std::all_of(begin, begin + kRun, [&](double force) { return force < small_N; });
}

std::size_t end_of_first_contact(const ContactTable& table) {
  const double zero_N = zero_force_N(table);
  const double small_N = zero_N + 0.02 * (table.force_N[table.loaded] - zero_N);
  // Under a sphere or cone the contact must not shrink: the hereditary integral would not hold.
  const double contact_m = limit_m(table);
  const double least_m = table.law.power == 1.0
                             ? contact_m
                             : contact_m + 0.98 * (table.depth_m[table.loaded] - contact_m);
  std::size_t end = table.loaded;
  while (end < table.time_s.size() && table.depth_m[end] > least_m &&
         !(table.goes_back && end > table.loaded && is_without_force(table, end, small_N))) {
    ++end;
  }
  return end;
}

HistoryInput input_of(const ContactTable& table) {
  HistoryInput input;
  input.time_s = table.time_s;
  input.output = table.force_N;
  input.input = table.depth_m;
  input.factor = table.law.factor;
  input.power = table.law.power;
  input.contact = table.contact.first;
  if (table.goes_back) input.loaded = table.loaded;
  if (!table.contact.is_fitted) return input;
  const double high_m = *std::max_element(input.input.begin(), input.input.end());
  input.contact_input = table.contact.depth_m;
  input.contact_half_width = 0.25 * (high_m - table.contact.depth_m);
  input.with_offset = true;
  return input;
}

// Samples out of contact whose force is clearly negative: the surface sticks to the punch.
std::vector<std::size_t> rows_in_tension(const ContactTable& table,
                                         const std::vector<char>& is_free) {
  constexpr double kSigmas = 6.0, kShareOfPeak = 0.02;
  const double zero_N = zero_force_N(table);
  const double sigma_N = sigma_from_differences(table.force_N);
  const double peak_N = *std::max_element(table.force_N.begin(), table.force_N.end()) - zero_N;
  const double limit_N = zero_N - std::max(kSigmas * sigma_N, kShareOfPeak * peak_N);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < is_free.size(); ++i) {
    if (is_free[i] && table.force_N[i] < limit_N) rows.push_back(i);
  }
  return rows;
}

// Depths of the stage become those of the punch.
void take_frame_off(const Column& force_N, double stiffness_N_m, Column& depth_m) {
  if (!(stiffness_N_m > 0.0)) return;
  for (std::size_t i = 0; i < depth_m.size(); ++i) depth_m[i] -= force_N[i] / stiffness_N_m;
}

// The rows before those of the table, in order of time.
void take_rows_before(const IndentationData& data, ContactTable& table) {
  const ForceDepthRows& rows = data.before;
  Column depth_m = rows.depth_m;
  take_frame_off(rows.force_N, data.frame_stiffness_N_m, depth_m);
  for (std::size_t i = 0; i < rows.time_s.size(); ++i) {
    const bool is_known = std::isfinite(depth_m[i]) && rows.time_s[i] < table.time_s.front() &&
                          (table.touch_m.empty() || rows.time_s[i] > table.touch_m.back().time_s);
    if (is_known) table.touch_m.push_back({rows.time_s[i], depth_m[i]});
  }
}

// The surface from the end of the first loading back to its begin: where no earlier touch is known, it rests until
// the punch passes the contact.
ContactCourse course_of(const ContactTable& table, double contact_m, const PronySeries& series) {
  std::size_t first = table.loaded;
  Course punch_m = table.touch_m;
  const Course of_table = course_from_columns(table.time_s, table.depth_m);
  punch_m.insert(punch_m.end(), of_table.begin(), of_table.end());
  if (table.touch_m.empty()) {
    while (first > 0 && table.depth_m[first - 1] > contact_m) --first;
    return contact_course(punch_m, contact_m, first, series);
  }
  const auto touched = std::find_if(punch_m.begin(), punch_m.end(),
                                    [&](const CoursePoint& at) { return at.value > contact_m; });
  ContactCourse course = contact_course(
      punch_m, contact_m, static_cast<std::size_t>(touched - punch_m.begin()), series);
  const auto n_touch = std::ssize(table.touch_m);
  course.surface_m.erase(course.surface_m.begin(), course.surface_m.begin() + n_touch);
  course.is_free.erase(course.is_free.begin(), course.is_free.begin() + n_touch);
  while (first > 0 && !course.is_free[first - 1]) --first;
  // The rows before the loading are those of a punch that has not touched yet.
  std::copy_n(table.depth_m.begin(), first, course.surface_m.begin());
  std::fill_n(course.is_free.begin(), first, 0);
  course.n_contacts = count_contacts(course.is_free, first);
  return course;
}

// The surface pressed by the earlier touch, then free until the first loading ends.
Course touch_of(const ContactTable& table, double contact_m, const PronySeries& series) {
  constexpr double kLifted_m = -1.0;
  if (table.touch_m.empty()) return {};
  Course punch_m = table.touch_m;
  for (CoursePoint& at : punch_m) at.value -= contact_m;
  for (std::size_t k = 0; k <= table.loaded; ++k) punch_m.push_back({table.time_s[k], kLifted_m});
  return earlier_touch(punch_m, series);
}

template <typename Value>
void drop_rows(std::vector<Value>& column, const std::vector<std::size_t>& rows) {
  auto next = rows.begin();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (next != rows.end() && *next == i) {
      ++next;
    } else {
      column[kept++] = column[i];
    }
  }
  column.resize(kept);
}

}  // namespace

ContactTable contact_table(const IndentationData& data) {
  ContactTable table;
  CheckedRecord record({data.time_s, data.force_N, data.depth_m}, kLeastContactRows,
                       RecordKind::kHistory);
  CleanViews& clean = record.clean;
  check_force(clean.column(1));
  const std::vector<std::size_t> spikes = isolated_spikes(clean.steps(), clean.column(1));
  clean.drop(spikes);
  const std::vector<std::size_t> jumps = depth_jumps(clean.column(1), clean.column(2));
  clean.drop(jumps);
  table.n_not_a_number = clean.n_left_out();
  table.notes = record.notes;
  table.n_spikes = spikes.size();
  table.n_depth_spikes = jumps.size();
  const auto copy = [&](std::size_t i) {
    return Column(clean.column(i).begin(), clean.column(i).end());
  };
  table.time_s = copy(0);
  table.force_N = copy(1);
  table.depth_m = copy(2);
  check_depth(table.force_N, table.depth_m);
  if (data.frame_stiffness_N_m > 0.0) {
    check_frame(table.force_N, table.depth_m, data.frame_stiffness_N_m);
    take_frame_off(table.force_N, data.frame_stiffness_N_m, table.depth_m);
  }
  if (data.contact) table.law = depth_law(*data.contact);
  find_first_contact(table);
  if (!table.contact.is_fitted) return table;
  const bool is_remembered = table.law.power == 1.0;
  if (is_remembered) take_rows_before(data, table);
  table.n_touch = end_of_earlier_touch(table.depth_m, table.loaded, table.contact.depth_m);
  if (table.n_touch == 0) return table;
  const auto n_touch = static_cast<std::ptrdiff_t>(table.n_touch);
  if (is_remembered) {
    for (std::size_t k = 0; k < table.n_touch; ++k) {
      table.touch_m.push_back({table.time_s[k], table.depth_m[k]});
    }
  }
  for (Column* column : {&table.time_s, &table.force_N, &table.depth_m}) {
    column->erase(column->begin(), column->begin() + n_touch);
  }
  find_first_contact(table);
  return table;
}

HistoryInput first_contact(const ContactTable& table) {
  HistoryInput input = input_of(table);
  const std::size_t end = end_of_first_contact(table);
  for (Column* column : {&input.time_s, &input.output, &input.input}) column->resize(end);
  return input;
}

WholeRecord whole_record(const ContactTable& table, const PronySeries& series, double contact_m,
                         bool with_drift) {
  WholeRecord whole;
  HistoryInput& input = whole.input = input_of(table);
  ContactCourse course = course_of(table, contact_m, series);
  input.touch = touch_of(table, contact_m, series);
  whole.n_contacts = course.n_contacts;
  input.input = std::move(course.surface_m);
  input.is_free = std::move(course.is_free);
  input.has_moved = moved_samples(table.depth_m);
  for (std::size_t i = 1; i < input.is_free.size(); ++i) {
    if (input.is_free[i] != input.is_free[i - 1]) input.has_moved[i] = 1;
  }
  if (input.contact_input) input.contact_input = contact_m;
  const auto n_free = std::count(input.is_free.begin(), input.is_free.end(), 1);
  constexpr std::ptrdiff_t kLeastFree = 10;
  input.with_drift = with_drift && table.contact.is_fitted && n_free >= kLeastFree;
  const std::vector<std::size_t> tension = rows_in_tension(table, input.is_free);
  whole.n_adhesion = tension.size();
  for (Column* column : {&input.time_s, &input.output, &input.input}) drop_rows(*column, tension);
  drop_rows(input.is_free, tension);
  drop_rows(input.has_moved, tension);
  return whole;
}

}  // namespace viscard
