// What solvers print: time, and the stress, force or displacement of the unit cube.
#include "io/basics/atomic_file.h"
#include "io/cards/card_lines.h"
#include "io/cards/proof/solvers.h"
#include "models/maths/leading_number.h"

#include <fmt/format.h>

#include <sstream>

namespace viscard {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  return fs::exists(path) ? read_own_file(path) : "";
}

std::vector<double> numbers_in(const std::string& line) {
  std::vector<double> out;
  std::istringstream stream(line);
  for (std::string word; stream >> word;) out.push_back(leading_number(word));
  return out;
}

// The columns of a table of blank-separated numbers.
std::vector<SolverSample> columns_of(const std::string& table, std::size_t value_column) {
  std::vector<SolverSample> samples;
  std::istringstream stream(table);
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::vector<double> row = numbers_in(line);
    if (row.size() > value_column) samples.push_back({row[0], row[value_column]});
  }
  return samples;
}

}  // namespace

// "... and time  0.1E+00", a blank line, then rows: z force of the base, or z of a top node, last.
std::vector<SolverSample> calculix_samples(const fs::path& folder, const DeckInput&, std::size_t) {
  std::vector<SolverSample> samples;
  std::istringstream stream(text_of(folder / "deck.dat"));
  for (std::string line; std::getline(stream, line);) {
    const std::size_t at = line.find("and time");
    if (at != std::string::npos) {
      samples.push_back({leading_number(line.substr(at + 8)), 0.0});
    } else if (!trimmed(line).empty() && !samples.empty()) {
      samples.back().value = leading_number(line.substr(line.find_last_of(' ')));
    }
  }
  return samples;
}

// FECore/DataRecord.cpp: "*Step  = 1", "*Time  = 0.1", "*Data  = sz", then "1 -0.25" of the item.
std::vector<SolverSample> febio_samples(const fs::path& folder, const DeckInput& input,
                                        std::size_t) {
  std::vector<SolverSample> samples;
  std::istringstream stream(text_of(folder / (input.is_creep() ? "uz.txt" : "sz.txt")));
  for (std::string line; std::getline(stream, line);) {
    const std::size_t equals = line.find('=');
    if (line.rfind("*Time", 0) == 0 && equals != std::string::npos) {
      samples.push_back({leading_number(line.substr(equals + 1)), 0.0});
    } else if (!line.empty() && line[0] != '*' && !samples.empty()) {
      const std::vector<double> row = numbers_in(line);
      if (row.size() > 1) samples.back().value = row[1];
    }
  }
  // The state before the first step has no response.
  if (!samples.empty() && samples.front().time_s == 0.0) samples.erase(samples.begin());
  return samples;
}

// MTest.cxx: time, six strains, six stresses (xx yy zz xy xz yz), then state variables.
std::vector<SolverSample> mtest_samples(const fs::path& folder, const DeckInput& input,
                                        std::size_t) {
  std::vector<SolverSample> samples =
      columns_of(text_of(folder / "deck.res"), input.is_creep() ? 3 : 9);
  if (!samples.empty() && samples.front().time_s == 0.0) samples.erase(samples.begin());
  return samples;
}

std::vector<SolverSample> python_samples(const fs::path& folder, const DeckInput&,
                                         std::size_t number) {
  return columns_of(text_of(folder / fmt::format("result_{}.txt", number)), 1);
}

namespace {

// The labels of a group of results with the columns that each of them has.
struct Labels {
  std::vector<std::string> names;
  std::vector<std::size_t> widths;

  // Of the first column; npos if there is no such label.
  std::size_t column_of(const std::string& name) const {
    std::size_t column = 0;
    for (std::size_t i = 0; i < names.size(); column += widths[i++]) {
      if (names[i] == name) return column;
    }
    return std::string::npos;
  }
  std::size_t width() const {
    std::size_t sum = 0;
    for (const std::size_t each : widths) sum += each;
    return sum;
  }
};

Labels labels_in(std::istream& stream, std::size_t count) {
  Labels labels{std::vector<std::string>(count), std::vector<std::size_t>(count)};
  for (std::size_t& width : labels.widths) stream >> width;
  for (std::string& name : labels.names) stream >> name;
  return labels;
}

std::vector<double> values_in(std::istream& stream, std::size_t count) {
  std::vector<double> values(count);
  for (double& value : values) stream >> value;
  return values;
}

// The result of one increment (hecmw_result_io_txt.c): "*global", the number of labels, their widths,
// the labels, the values; "*data", nodes and elements, the numbers of labels of each, then the same
// for all nodes, each behind its number. Node 7 is a corner of the top.
bool read_frontistr_step(const std::string& text, bool is_creep, SolverSample& sample) {
  std::istringstream stream(text);
  std::string word;
  while (stream >> word && word != "*global") {
  }
  std::size_t count = 0, nodes = 0, elements = 0, of_elements = 0;
  stream >> count;
  const Labels global = labels_in(stream, count);
  const std::vector<double> values = values_in(stream, global.width());
  const std::size_t time = global.column_of("TOTALTIME");
  stream >> word >> nodes >> elements >> count >> of_elements;
  if (!stream || word != "*data" || time == std::string::npos || count > 100) return false;
  const Labels labels = labels_in(stream, count);
  const std::size_t column = labels.column_of(is_creep ? "DISPLACEMENT" : "NodalSTRESS");
  if (column == std::string::npos) return false;
  for (std::size_t node = 0; node < nodes; ++node) {
    int id = 0;
    stream >> id;
    const std::vector<double> row = values_in(stream, labels.width());
    if (stream && id == 7) sample = {values[time], row[column + 2]};
  }
  return static_cast<bool>(stream) && sample.time_s > 0.0;
}

}  // namespace

std::vector<SolverSample> frontistr_samples(const fs::path& folder, const DeckInput& input,
                                            std::size_t) {
  std::vector<SolverSample> samples;
  for (int step = 1;; ++step) {
    const fs::path path = folder / fmt::format("deck.res.0.{}", step);
    if (!fs::exists(path)) return samples;
    SolverSample sample;
    if (read_frontistr_step(read_own_file(path), input.is_creep(), sample))
      samples.push_back(sample);
  }
}

}  // namespace viscard
