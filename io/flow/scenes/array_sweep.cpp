#include "io/flow/scenes/array_sweep.h"

#include "io/basics/atomic_file.h"
#include "io/basics/inputs.h"
#include "io/flow/scenes/wanted_results.h"
#include "models/maths/leading_number.h"
#include "models/scene/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

std::string line_from_row(std::size_t point, const SweepRow& row) {
  std::string line = std::to_string(point);
  for (const SceneResult& r : row) {
    line += fmt::format(",{},{:.17g},{},{:.17g}", r.name, r.value, r.unit, r.error_estimate);
  }
  return line + "\n";
}

bool is_number(const std::string& cell) {
  std::string_view rest;
  leading_number(cell, &rest);
  return !cell.empty() && rest.empty();
}

// A line that was cut off by a crash is not a row.
bool read_line(const std::string& line, std::size_t& point, SweepRow& row) {
  std::vector<std::string> cells;
  std::stringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  if (cells.size() < 5 || cells.size() % 4 != 1) return false;
  try {
    point = std::stoul(cells[0]);
    for (std::size_t i = 1; i + 3 < cells.size(); i += 4) {
      if (!is_number(cells[i + 1]) || !is_number(cells[i + 3])) return false;
      row.push_back(
          {cells[i], leading_number(cells[i + 1]), cells[i + 2], leading_number(cells[i + 3])});
    }
  } catch (const std::exception&) {
    return false;
  }
  return true;
}

// Points finish in any order. The answer of a sweep holds the estimate of each effect at the point
// where leaving it out costs most.
void keep_largest(const std::vector<SceneEffect>& point, std::vector<SceneEffect>& sum) {
  if (sum.empty()) sum = point;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (point[i].estimate > sum[i].estimate) sum[i] = point[i];
  }
}

}  // namespace

SweepStore::SweepStore(const std::filesystem::path& folder, const std::string& key) {
  if (folder.empty()) return;
  std::filesystem::create_directories(folder);
  path_ = folder / "sweep.part.csv";
  if (std::filesystem::exists(path_)) read(key);
  if (!done_.empty()) return;
  write_file(path_, "# " + key + "\n", true);
}

void SweepStore::read(const std::string& key) {
  std::istringstream in(read_own_file(path_));
  std::string line;
  if (!std::getline(in, line) || line != "# " + key) {
    throw std::runtime_error(
        path_.string() + " holds the points of another sweep; remove it, or choose another folder");
  }
  std::string kept = line + "\n";
  while (std::getline(in, line)) {
    std::size_t point = 0;
    SweepRow row;
    if (in.eof() || !read_line(line, point, row)) continue;  // without its end: cut off
    done_[point] = std::move(row);
    kept += line + "\n";
  }
  write_file(path_, kept, true);
}

void SweepStore::add(std::size_t point, const SweepRow& row) {
  done_[point] = row;
  if (path_.empty()) return;
  std::ofstream out(path_, std::ios::app);
  out << line_from_row(point, row) << std::flush;
  if (!out) throw std::runtime_error("cannot write to " + path_.string() + "; is the disk full?");
}

void SweepStore::remove() {
  if (!path_.empty()) std::filesystem::remove(path_);
}

namespace {

// The deviation at one spacing, against the limit.
struct Deviation {
  double spacing_m = 0.0;
  double percent = 0.0, error = 0.0;
};

// Spacings of a table against a limit that their deviations fall below.
class SpacingLimit {
 public:
  SpacingLimit(std::vector<Deviation> all, double limit_percent)
      : all_(std::move(all)), limit_percent_(limit_percent) {}

  // Adds the first spacing below the limit and, where a larger one lies above it again, the one from
  // which on all lie below.
  void add_to(SceneAnswer& answer, const std::string& at) const {
    const auto first = static_cast<std::size_t>(
        std::find_if(all_.begin(), all_.end(), [&](const Deviation& d) { return is_below(d); }) -
        all_.begin());
    if (first == all_.size()) return;
    answer.results.push_back(
        {"first_spacing" + at, all_[first].spacing_m, "m", uncertainty_m(first)});
    std::size_t settled = all_.size();
    while (settled > first && is_below(all_[settled - 1])) --settled;
    if (settled == first) return;
    const Deviation& again = all_[settled - 1];
    std::string note = fmt::format(
        "the deviation{} is below {:g} % at {:.4g} um only because it changes sign there; it is "
        "{:.2g} % at {:.4g} um",
        at, limit_percent_, 1e6 * all_[first].spacing_m, again.percent, 1e6 * again.spacing_m);
    if (settled == all_.size()) {
      note += ", and no spacing of the sweep is known to be wide enough";
    } else {
      note += fmt::format(", and stays below from {:.4g} um on", 1e6 * all_[settled].spacing_m);
      answer.results.push_back(
          {"settled_spacing" + at, all_[settled].spacing_m, "m", uncertainty_m(settled)});
    }
    answer.notes.push_back(note);
  }

 private:
  bool is_below(const Deviation& d) const { return std::abs(d.percent) < limit_percent_; }
  // Down to the next smaller spacing that lies above the limit with any error within the estimates,
  // because the limit is crossed between; up to the next larger one that lies below it likewise.
  double uncertainty_m(std::size_t i) const {
    const auto is_sure = [&](const Deviation& d) {
      return std::abs(std::abs(d.percent) - limit_percent_) > d.error;
    };
    std::size_t low = i, high = i;
    while (low > 0 && !(is_sure(all_[low - 1]) && !is_below(all_[low - 1]))) --low;
    while (high + 1 < all_.size() && !(is_sure(all_[high]) && is_below(all_[high]))) ++high;
    const double lower_m = low > 0 ? all_[low - 1].spacing_m : 0.0;
    return std::max(all_[i].spacing_m - lower_m, all_[high].spacing_m - all_[i].spacing_m);
  }

  std::vector<Deviation> all_;
  double limit_percent_;
};

}  // namespace

SceneAnswer solve_sweep(const SceneFile& file, SweepStore& store,
                        const std::function<void(double, const std::string&)>& progress) {
  const auto& scene = std::get<ArrayScene>(file.scene);
  const std::vector<SweepPoint> points = points_of(scene, file.sweep);
  std::vector<Scene> left;
  std::vector<std::size_t> number;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (store.done().count(i) > 0) continue;
    left.push_back(points[i].scene);
    number.push_back(i);
  }
  SceneAnswer sum;
  simulate_all(left, [&](std::size_t i, const SceneAnswer& answer) {
    SceneAnswer kept = answer;
    keep_wanted(scene.wanted, kept);
    store.add(number[i], kept.results);
    if (answer.unknowns > sum.unknowns) {
      sum.unknowns = answer.unknowns;
      sum.discretisation = answer.discretisation;
    }
    keep_largest(answer.effects, sum.effects);
    const double done = static_cast<double>(store.done().size());
    if (progress) progress(done / static_cast<double>(points.size()), points[number[i]].label);
  });
  SceneAnswer all = joined(file.sweep, points, store.done());
  sum.results = std::move(all.results);
  sum.notes = std::move(all.notes);
  return sum;
}

SceneAnswer joined(const ArraySweep& sweep, const std::vector<SweepPoint>& points,
                   const std::map<std::size_t, SweepRow>& rows) {
  SceneAnswer answer;
  const std::size_t per_line = std::max<std::size_t>(1, sweep.spacing_m.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (SceneResult r : rows.at(i)) {
      r.name += " at " + points[i].label;
      answer.results.push_back(std::move(r));
    }
  }
  if (!(sweep.limit_percent > 0.0)) return answer;
  for (std::size_t line = 0; line < points.size(); line += per_line) {
    std::vector<Deviation> all;
    for (std::size_t i = line; i < line + per_line; ++i) {
      for (const SceneResult& r : rows.at(i)) {
        if (!r.name.starts_with("deviation_percent")) continue;
        all.push_back({points[i].scene.geometry.spacing_m, r.value, r.error_estimate});
        break;
      }
    }
    const std::string& label = points[line].label;
    const std::size_t end = label.rfind(", spacing");
    SpacingLimit(all, sweep.limit_percent)
        .add_to(answer, end == std::string::npos ? "" : " at " + label.substr(0, end));
  }
  return answer;
}

std::string csv_from_sweep(const std::vector<SweepPoint>& points,
                           const std::map<std::size_t, SweepRow>& rows,
                           const std::string& command) {
  std::string text = head_of_table(command);
  text += "diameter_m,spacing_m,thickness_m";
  const auto unit = [](const std::string& u) { return u == "%" ? std::string() : "_" + u; };
  for (const SceneResult& r : rows.begin()->second) {
    text += fmt::format(",{}{},{}_error", r.name, unit(r.unit), r.name);
  }
  for (const auto& [i, row] : rows) {
    const ArrayGeometry& g = points[i].scene.geometry;
    text += fmt::format("\n{:.9g},{:.9g},{:.9g}", g.diameter_m, g.spacing_m, g.film_thickness_m);
    for (const SceneResult& r : row)
      text += fmt::format(",{:.9g},{:.3g}", r.value, r.error_estimate);
  }
  return text + "\n";
}

}  // namespace viscard
