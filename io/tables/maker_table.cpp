#include "io/tables/maker_table.h"

#include "io/basics/number_text.h"
#include "io/tables/table_parts.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

using Words = std::vector<std::string>;

Words copies(const std::vector<std::string_view>& views) {
  return {views.begin(), views.end()};
}

bool starts(std::string_view text, std::string_view with) {
  return text.substr(0, with.size()) == with;
}

bool has(const Words& names, const char* name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The lines of a file with their numbers.
template <typename Take>
void for_each_line(std::string_view text, Take take) {
  for (std::size_t number = 1; !text.empty(); ++number) take(number, take_line(text));
}

// --- JPK (Bruker) force curves: text with the names of the columns in comments -------------------

struct JpkHeader {
  Words names, units;
  std::string segment;
};

// The piezo moves the tip down, so the tip's distance from the sample falls.
std::map<std::string, std::string> jpk_columns(const Words& names) {
  std::map<std::string, std::string> columns;
  for (const char* time : {"seriesTime", "time"}) {
    if (has(names, time) && columns.count("time_s") == 0) columns["time_s"] = time;
  }
  if (has(names, "vDeflection")) columns["force_N"] = "vDeflection";
  if (has(names, "tipSampleSeparation")) columns["depth_m"] = "-tipSampleSeparation";
  return columns;
}

MakerTable jpk_table(std::string_view text) {
  TableParts parts;
  JpkHeader header;
  bool is_new = false;
  MakerTable table{"JPK force curve", "", {}, {}};
  for_each_line(text, [&](std::size_t number, std::string_view whole) {
    const std::string_view line = trimmed(whole);
    if (line.empty() || line.front() == '#') {
      const std::string_view note = line.empty() ? line : trimmed(line.substr(1));
      if (starts(note, "columns:")) header.names = copies(plain_words(note.substr(8)));
      if (starts(note, "units:")) header.units = copies(plain_words(note.substr(6)));
      if (starts(note, "segment:")) header.segment = trimmed(note.substr(8));
      is_new = is_new || starts(note, "columns:");
      parts.other_line();
      return;
    }
    if (header.names.empty()) {
      throw std::runtime_error("line " + std::to_string(number) +
                               ": a row before '# columns:', so its columns are not known");
    }
    if (is_new) {
      parts.begin(header.segment, header.names, header.units);
      if (table.columns.empty()) table.columns = jpk_columns(header.names);
    }
    is_new = false;
    parts.row(plain_words(line));
  });
  table.text = parts.text();
  return table;
}

// --- TA Instruments TRIOS, "Export to LIMS": one block [Step] for each step ----------------------

MakerTable trios_table(std::string_view text) {
  const std::string_view all = text;
  TableParts parts;
  std::string step;
  Words names, units;
  bool is_new = false;
  for_each_line(text, [&](std::size_t, std::string_view line) {
    std::vector<std::string_view> cells = plain_cells(line, '\t');
    const std::string_view first = cells.front();
    cells.erase(cells.begin());
    if (first == "Data point") {
      if (is_new) parts.begin(step, names, units);
      is_new = false;
      parts.row(cells);
      return;
    }
    if (first == "Step name" && !cells.empty()) step = cells.front();
    if (first == "Units") units = copies(cells);
    if (first == "Variables") {
      names = copies(cells);
      is_new = true;
    }
    parts.other_line();
  });
  return {"TA Instruments TRIOS", parts.text(), {}, kind_of_instrument(all)};
}

// --- Anton Paar RheoCompass: tests of several intervals ------------------------------------------

constexpr std::string_view kIntervalData = "Interval data:";

class AntonPaarReader {
 public:
  MakerTable read(std::string_view text) {
    for_each_line(text, [&](std::size_t, std::string_view line) { take(line); });
    return {"Anton Paar RheoCompass", parts_.text(), {}, ModulusKind::kShear};
  }

 private:
  void take(std::string_view line) {
    const std::string_view bare = trimmed(line);
    if (starts(bare, "Result:"))
      result_ = trimmed(bare.substr(std::min(bare.size(), std::size_t{8})));
    if (starts(bare, "Interval and data points:")) {
      const auto cells = plain_cells(bare, bare.size() > 25 ? bare[25] : '\t');
      interval_ = cells.size() > 1 ? std::string(cells[1]) : "";
    }
    if (starts(bare, kIntervalData)) {
      separator_ = bare.size() > kIntervalData.size() ? bare[kIntervalData.size()] : '\t';
      names_ = copies(plain_cells(bare, separator_));
      names_.erase(names_.begin());
      while (!names_.empty() && names_.back().empty()) names_.pop_back();
      units_.assign(names_.size(), "");
      is_data_ = !names_.empty();
      is_new_ = true;
      parts_.other_line();
      return;
    }
    for (const char* word : {"Project:", "Test:", "Result:", "Interval and data points:"}) {
      is_data_ = is_data_ && !starts(bare, word);
    }
    if (!is_data_ || bare.empty() || !take_cells(line)) parts_.other_line();
  }

  // A row of units or numbers. Returns false for any other line, which ends the interval.
  bool take_cells(std::string_view line) {
    std::vector<std::string_view> cells = plain_cells(line, separator_);
    while (cells.size() > names_.size() + 1 && cells.back().empty()) cells.pop_back();
    if (cells.size() == names_.size() + 1 && cells.front().empty()) cells.erase(cells.begin());
    cells.resize(std::max(cells.size(), names_.size()));
    const bool is_empty = std::all_of(cells.begin(), cells.end(), [](auto c) { return c.empty(); });
    if (is_empty) return false;
    const bool is_units = std::all_of(cells.begin(), cells.end(), [](std::string_view c) {
      return c.empty() || (c.front() == '[' && c.back() == ']');
    });
    if (is_units) {
      for (std::size_t i = 0; i < units_.size(); ++i) {
        if (cells[i].size() > 2) units_[i] = cells[i].substr(1, cells[i].size() - 2);
      }
      return false;
    }
    const bool has_digit = std::any_of(cells.begin(), cells.end(), [](std::string_view c) {
      return !c.empty() &&
             (std::isdigit(static_cast<unsigned char>(c.front())) || c.front() == '-');
    });
    if (!has_digit || cells.size() != names_.size()) {
      is_data_ = false;
      return false;
    }
    if (is_new_) {
      const std::string of = interval_.empty() ? "" : "interval " + interval_;
      parts_.begin(result_.empty() || of.empty() ? result_ + of : result_ + ", " + of, names_,
                   units_);
    }
    is_new_ = false;
    parts_.row(cells);
    return true;
  }

  TableParts parts_;
  std::string result_, interval_;
  Words names_, units_;
  char separator_ = '\t';
  bool is_data_ = false, is_new_ = false;
};

// --- RepTate: parameters in the first line, then columns in fixed order --------------------------

struct RepTateKind {
  std::string_view ending;
  const char* header;
  std::size_t n_columns;
};
constexpr RepTateKind kRepTate[] = {{".gt", "t [s]\tG(t) [Pa]", 2},
                                    {".osc", "w [rad/s]\tG' [Pa]\tG'' [Pa]", 3},
                                    {".tts", "w [rad/s]\tG' [Pa]\tG'' [Pa]", 3},
                                    {".creep", "t [s]\tstrain", 2}};

// "gamma=1;T=20" has the parameter gamma. 0 without it.
double parameter(std::string_view line, std::string_view name) {
  while (!line.empty()) {
    const std::size_t end = std::min(line.size(), line.find_first_of(";,"));
    const std::string_view pair = trimmed(line.substr(0, end));
    line.remove_prefix(std::min(line.size(), end + 1));
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos || trimmed(pair.substr(0, equals)) != name) continue;
    const std::string_view number = trimmed(pair.substr(equals + 1));
    double value = 0.0;
    std::from_chars(number.data(), number.data() + number.size(), value);
    return value;
  }
  return 0.0;
}

MakerTable reptate_table(std::string_view text, const RepTateKind& kind) {
  MakerTable table{"RepTate", "", {}, ModulusKind::kShear};
  for_each_line(text, [&](std::size_t number, std::string_view line) {
    if (number == 1) {
      const double strain = parameter(line, "gamma"), stress_Pa = parameter(line, "stress");
      if (kind.ending == ".gt" && strain != 0.0) {
        table.columns["modulus_Pa"] = text_from_number(1.0 / strain) + "*2";
      }
      if (kind.ending == ".creep") {
        if (parameter(line, "rec") != 0.0) {
          throw std::runtime_error(
              "line 1: rec=1 is a recovery; only the creep before it can be fitted");
        }
        if (!(stress_Pa > 0.0)) {
          throw std::runtime_error(
              "line 1: no stress is stated (stress=10), so no compliance follows");
        }
        table.columns["compliance_1_Pa"] = text_from_number(1.0 / stress_Pa) + "*2";
        table.columns["time_s"] = "1";
      }
      table.text += std::string(kind.header) + "\n";
      return;
    }
    std::vector<std::string_view> cells = plain_words(line);
    if (cells.size() == 1) cells = plain_cells(line, ',');
    const bool is_row =
        cells.size() >= kind.n_columns && !cells.front().empty() &&
        std::string_view("0123456789.+-").find(cells.front().front()) != std::string_view::npos;
    if (!is_row) {
      table.text += "#\n";
      return;
    }
    for (std::size_t i = 0; i < kind.n_columns; ++i) {
      table.text += std::string(i == 0 ? "" : "\t") + std::string(cells[i]);
    }
    table.text += "\n";
  });
  return table;
}

}  // namespace

std::optional<MakerTable> maker_table(std::string_view text, const std::string& name) {
  const std::string_view head = text.substr(0, 20000);
  if (starts(head, "#") && head.find("\n# columns:") != std::string_view::npos &&
      head.find("\n# segment") != std::string_view::npos) {
    return jpk_table(text);
  }
  if (head.find("TA Instruments LIMS export format") != std::string_view::npos) {
    return trios_table(text);
  }
  if (head.find("Interval and data points:") != std::string_view::npos &&
      head.find(kIntervalData) != std::string_view::npos) {
    return AntonPaarReader().read(text);
  }
  for (const RepTateKind& kind : kRepTate) {
    const bool has_ending =
        name.size() > kind.ending.size() &&
        name.compare(name.size() - kind.ending.size(), kind.ending.size(), kind.ending) == 0;
    const std::string_view first = head.substr(0, head.find_first_of("\r\n"));
    if (has_ending && first.find('=') != std::string_view::npos) return reptate_table(text, kind);
  }
  return std::nullopt;
}

std::optional<ModulusKind> kind_of_instrument(std::string_view text) {
  const std::string_view head = text.substr(0, 20000);
  for (const char* name : {"heometer", "RHEOMETER", "ARES", "Discovery HR", "DHR", "AR-G2",
                           "AR2000", "AR 2000", "MCR ", "Kinexus", "HAAKE MARS"}) {
    if (head.find(name) != std::string_view::npos) return ModulusKind::kShear;
  }
  // Headings of Anton Paar's tables without their notes.
  const auto has = [&](const char* words) { return head.find(words) != std::string_view::npos; };
  const bool is_rheoplus = has("Meas. Pts.") || (has("Point No.") && has("Damping Factor"));
  return is_rheoplus ? std::optional(ModulusKind::kShear) : std::nullopt;
}

std::string maker_of_header(std::string_view line) {
  const auto says = [&](std::string_view word) {
    return line.find(word) != std::string_view::npos;
  };
  if (says("Cantilever (nm)") && says("Piezo (nm)")) return "Optics11";
  if (says("Prüfzeit") && says("Standardkraft")) return "ZwickRoell testXpert";
  return "";
}

}  // namespace viscard
