#include "io/flow/scenes/array_sweep.h"

#include "io/basics/atomic_file.h"
#include "io/flow/scenes/wanted_results.h"
#include "models/scene/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace viscard {
namespace {

std::string line_from_row(std::size_t point, const SweepRow& row) {
  std::string line = std::to_string(point);
  for (const SceneResult& r : row) {
    line += fmt::format(",{},{:.17g},{},{:.17g}", r.name, r.value, r.unit, r.error_estimate);
  }
  return line + "\n";
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
      row.push_back({cells[i], std::stod(cells[i + 1]), cells[i + 2], std::stod(cells[i + 3])});
    }
  } catch (const std::exception&) {
    return false;
  }
  return true;
}

// Points finish in any order: the answer of a sweep holds each effect as it is at the point where
// leaving it out costs most.
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
  std::istringstream in(read_file(path_));
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
  sum.results = joined(file.sweep, points, store.done()).results;
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
    for (std::size_t i = line; i < line + per_line; ++i) {
      const auto deviation = std::find_if(rows.at(i).begin(), rows.at(i).end(), [](const auto& r) {
        return r.name.starts_with("deviation_percent");
      });
      if (deviation == rows.at(i).end() || std::abs(deviation->value) >= sweep.limit_percent) {
        continue;
      }
      const std::string& label = points[i].label;
      const std::size_t end = label.rfind(", spacing");
      answer.results.push_back(
          {"first_spacing" +
               (end == std::string::npos ? std::string() : " at " + label.substr(0, end)),
           points[i].scene.geometry.spacing_m, "m", 0.0});
      break;
    }
  }
  return answer;
}

std::string csv_from_sweep(const std::vector<SweepPoint>& points,
                           const std::map<std::size_t, SweepRow>& rows,
                           const std::string& command) {
  std::string text = fmt::format("# {} (viscard {})\n", command, VISCARD_VERSION);
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
