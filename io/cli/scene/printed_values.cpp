#include "io/basics/inputs.h"
#include "io/basics/units.h"
#include "io/basics/words.h"
#include "io/cli/scene/answer_output.h"
#include "io/flow/scenes/named_values.h"
#include "models/maths/result_visitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
std::vector<PrintedComparison> compare_printed(const std::vector<PrintedValue>& printed,
                                               const SceneAnswer& answer) {
  const std::vector<NamedValue> all = named_values(answer);
  std::vector<std::string> known;
  for (const NamedValue& one : all) known.push_back(one.name);
  std::vector<PrintedComparison> rows;
  for (const PrintedValue& p : printed) {
    const auto ours =
        std::find_if(all.begin(), all.end(), [&](const NamedValue& n) { return n.name == p.name; });
    if (ours == all.end()) {
      throw std::runtime_error("[[printed]]: the answer has no '" + p.name + "'" +
                               did_you_mean(p.name, known, ""));
    }
    const double value = si_from_text(p.value, ours->unit.c_str());
    // Publications print voltages and displacements without their sign.
    const double percent = 100.0 * (std::abs(value) / std::abs(ours->value) - 1.0);
    rows.push_back({p.name, value, ours->value, ours->unit, percent, p.note});
    if (ours->unit == "%") rows.back().difference_points = value - ours->value;
  }
  return rows;
}

void print_comparison(const std::vector<PrintedComparison>& rows, std::ostream& out) {
  if (rows.empty()) return;
  std::size_t width = 24;
  for (const PrintedComparison& row : rows) width = std::max(width, row.name.size());
  out << fmt::format("\n  {:<{}} {:>12} {:>14} {:<5} {:>11}\n", "", width, "printed", "ours", "",
                     "difference");
  for (const PrintedComparison& row : rows) {
    const std::string difference = row.difference_points
                                       ? fmt::format("{:+9.4f} points", *row.difference_points)
                                       : fmt::format("{:+9.3f} %", row.difference_percent);
    out << fmt::format("  {:<{}} {:>12.6g} {:>14.7g} {:<5} {}{}{}\n", row.name, width, row.printed,
                       row.ours, row.unit, difference, row.note.empty() ? "" : "  ", row.note);
  }
  out << "  (magnitudes are compared, because publications often omit signs)\n";
}

void show_keys(ResultVisitor& v, const PrintedComparison& row) {
  v("difference_percent", row.difference_percent, "of the magnitudes");
  v("difference_points", row.difference_points, "for percentages");
  v("name", row.name, "its name");
  v("note", row.note, "of the scene");
  v("ours", row.ours, "our value");
  v("printed", row.printed, "the printed value");
  v("unit", row.unit, "its unit");
}

void print_compared(const ComparedAnswers& compared, std::ostream& out) {
  std::size_t width = 24;
  for (const ComparedValue& row : compared.values) width = std::max(width, row.name.size());
  out << "\n  beside " << compared.scene << "\n";
  if (!compared.values.empty())
    out << fmt::format("  {:<{}} {:>14} {:>14} {:<5} {:>12}\n", "", width, "here", "there", "",
                       "here/there");
  for (const ComparedValue& row : compared.values) {
    const std::string ratio = row.ratio
                                  ? fmt::format("{:>12.6g} +- {:.1e}", *row.ratio, row.ratio_error)
                                  : fmt::format("{:>12}", "-");
    out << fmt::format("  {:<{}} {:>14.7g} {:>14.7g} {:<5} {}\n", row.name, width, row.value,
                       row.other, row.unit, ratio);
  }
  for (const ComparedProfile& profile : compared.profiles) {
    out << fmt::format("  {} along x: from one electrode to the next, {:.4g} um apart, up to ",
                       profile.here.name, 1e6 * profile.pitch_m);
    if (profile.contrast)
      out << fmt::format("{:.3g} % of the largest here", 100.0 * *profile.contrast);
    if (profile.contrast && profile.other_contrast) {
      out << fmt::format(" and {:.3g} % there: {:.3g} times as sharp",
                         100.0 * *profile.other_contrast,
                         *profile.contrast / *profile.other_contrast);
    } else {
      out << "; there no electrodes have that distance";
    }
    out << "\n";
  }
}

std::string csv_of_compared(const ComparedAnswers& compared, const std::string& command) {
  std::string text =
      fmt::format("{}result,value,other,unit,ratio,error,other_error\n", head_of_table(command));
  for (const ComparedValue& row : compared.values) {
    text += fmt::format("{},{:.9g},{:.9g},{},{},{:.3g},{:.3g}\n", row.name, row.value, row.other,
                        row.unit, row.ratio ? fmt::format("{:.9g}", *row.ratio) : "", row.error,
                        row.other_error);
  }
  return text;
}

}  // namespace viscard
