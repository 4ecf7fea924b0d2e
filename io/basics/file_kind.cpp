#include "io/basics/file_kind.h"

#include "io/basics/data_folder.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

using namespace std::string_view_literals;

struct KindRow {
  FileKind kind;
  const char* what;
  const char* use;      // commands for a file of this kind
  const char* example;  // how a file of this kind looks, if one can be expected
};

constexpr std::array kKinds{
    KindRow{FileKind::kOther, "a text of no form that viscard knows", "", ""},
    KindRow{FileKind::kEmpty, "empty", "", ""},
    KindRow{FileKind::kBinary, "a binary file", "", ""},
    KindRow{FileKind::kCapture, "a capture", "viscard fit, export and report take it", ""},
    KindRow{FileKind::kStudyAnswers, "an SQLite database", "viscard sweep --out continues it", ""},
    KindRow{FileKind::kTable, "a table of numbers",
            "viscard fit, predict --against and report take it", "CSV with a header"},
    KindRow{FileKind::kRig, "a rig", "pass it with --rig to viscard rig, capture or serve",
            "TOML such as data/demo/01_rig.toml"},
    KindRow{FileKind::kRigTest, "a test of the rig", "pass it with --test to viscard capture",
            "TOML such as data/demo/02_test.toml"},
    KindRow{FileKind::kSpecimen, "a specimen", "pass it with --specimen to viscard capture or fit",
            "TOML such as data/demo/03_pdms_1to10.toml"},
    KindRow{FileKind::kTruth, "the truth of an emulated specimen",
            "pass it with --truth to viscard capture --emulate",
            "TOML such as data/demo/03_pdms_1to10.truth.toml"},
    KindRow{FileKind::kCalibration, "a calibration record",
            "a rig file names it by file = \"...\" in [calibration] or [frame]",
            "TOML as viscard calibrate --out writes it"},
    KindRow{FileKind::kScene, "a scene",
            "viscard scene check, plan, simulate, cost and design --require take it",
            "TOML such as data/scenes/pillar_sensor.toml"},
    KindRow{FileKind::kStudy, "a study", "viscard sweep takes it",
            "TOML such as data/studies/pillar.toml"},
    KindRow{FileKind::kDesignTask, "a design task", "viscard design takes it, without --require",
            "TOML such as data/designs/pillar_sensor.toml"},
    KindRow{FileKind::kRequirements, "a list of requirements",
            "pass it to viscard design SCENE.toml --require",
            "TOML such as data/requirements/human_hand.toml"},
    KindRow{FileKind::kOtherToml, "a TOML file of another kind", "", ""},
    KindRow{FileKind::kMaterial, "a material",
            "viscard card, predict, validate and report take it, and a scene names it under "
            "[materials]",
            "JSON as viscard fit --out writes it, or data/materials/pdms_1to10_seed.json"},
    KindRow{FileKind::kMedium, "the medium of a film", "a scene names it under [materials]",
            "JSON such as data/materials/pvdf_seed.json"},
    KindRow{FileKind::kJointFit, "a joint fit over mixing ratios", "viscard card --ratio takes it",
            "JSON as viscard fit --joint --out writes it"},
    KindRow{FileKind::kRubberLaw, "a law of rubber", "viscard card takes it",
            "JSON as viscard fit uniaxial=FILE --out writes it"},
    KindRow{FileKind::kOtherJson, "a JSON file of another kind", "", ""},
    KindRow{FileKind::kCard, "a material card", "viscard card --check takes it",
            "a text as viscard card --out writes it"},
    KindRow{FileKind::kPage, "an HTML page",
            "a browser shows it; viscard fit and report take the files that it was made from", ""},
};

const KindRow& row_of(FileKind kind) {
  return *std::find_if(kKinds.begin(), kKinds.end(),
                       [&](const KindRow& row) { return row.kind == kind; });
}

bool is_key(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
}

bool is_page(std::string_view text) {
  constexpr std::array<std::string_view, 2> kBegins{"<!doctype html", "<html"};
  return std::any_of(kBegins.begin(), kBegins.end(), [&](std::string_view begin) {
    return std::equal(
        begin.begin(), begin.end(), text.begin(),
        text.begin() + static_cast<std::ptrdiff_t>(std::min(begin.size(), text.size())),
        [](char wanted, char found) {
          return wanted == (found >= 'A' && found <= 'Z' ? found + 32 : found);
        });
  });
}

// The next line without blanks at its ends, and removes it from the text.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.size(), text.find('\n'));
  const std::string_view line = trimmed(text.substr(0, end));
  text.remove_prefix(std::min(text.size(), end + 1));
  return line;
}

FileKind json_kind(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, FileKind>, 5> kMarks{
      {{"\"viscard-material/", FileKind::kMaterial},
       {"\"viscard-medium/", FileKind::kMedium},
       {"\"viscard-joint/", FileKind::kJointFit},
       {"\"viscard-hyperelastic/", FileKind::kRubberLaw},
       {"\"E0_Pa\"", FileKind::kMaterial}}};
  const std::size_t schema = text.find("\"schema\"");
  for (const auto& [mark, kind] : kMarks) {
    const bool is_schema = mark.find('/') != std::string_view::npos;
    const std::size_t at = text.find(mark);
    if (at == std::string_view::npos) continue;
    if (is_schema ? schema < at && at - schema < 16 : schema == std::string_view::npos) return kind;
  }
  return FileKind::kOtherJson;
}

// Sections and keys of the top level.
FileKind toml_kind(std::string_view text) {
  std::set<std::string, std::less<>> names;
  bool is_top = true;
  while (!text.empty()) {
    const std::string_view line = take_line(text);
    if (!line.empty() && line.front() == '[') {
      const std::size_t from = line.find_first_not_of('[');
      if (from != std::string_view::npos) names.emplace(line.substr(from, line.find(']') - from));
      is_top = false;
    } else if (const std::size_t equals = line.find('=');
               is_top && equals != std::string_view::npos) {
      names.emplace(trimmed(line.substr(0, equals)));
    }
  }
  constexpr std::array<std::pair<std::string_view, FileKind>, 22> kMarks{
      {{"geometry", FileKind::kScene},
       {"parameter", FileKind::kStudy},
       {"range", FileKind::kDesignTask},
       {"objective", FileKind::kDesignTask},
       {"require", FileKind::kRequirements},
       {"stage", FileKind::kRig},
       {"load_cell", FileKind::kRig},
       {"material.terms", FileKind::kTruth},
       {"rig", FileKind::kTruth},
       {"approach", FileKind::kRigTest},
       {"ramp", FileKind::kRigTest},
       {"creep", FileKind::kRigTest},
       {"cycles", FileKind::kRigTest},
       {"staircase", FileKind::kRigTest},
       {"levels", FileKind::kRigTest},
       {"protocol", FileKind::kRigTest},
       {"modulus_guess", FileKind::kSpecimen},
       {"tip", FileKind::kSpecimen},
       {"contact", FileKind::kSpecimen},
       {"calibration", FileKind::kCalibration},
       {"frame", FileKind::kCalibration},
       {"analysis", FileKind::kScene}}};
  for (const auto& [mark, kind] : kMarks) {
    if (names.contains(mark)) return kind;
  }
  return FileKind::kOtherToml;
}

// Some line holds two numbers or more and nothing else.
bool is_table(std::string_view text) {
  constexpr int kLines = 40;
  for (int i = 0; i < kLines && !text.empty(); ++i) {
    const std::string_view line = take_line(text);
    constexpr std::string_view kNumber = "0123456789+-.eE";
    if (line.find_first_of("0123456789") == std::string_view::npos ||
        line.find_first_not_of("0123456789+-.eE,;\t ") != std::string_view::npos) {
      continue;
    }
    const std::size_t gap = line.find_first_not_of(kNumber);
    if (gap != std::string_view::npos && gap > 0 && gap + 1 < line.size()) return true;
  }
  return false;
}

}  // namespace

bool is_json_kind(FileKind kind) {
  return kind == FileKind::kMaterial || kind == FileKind::kMedium || kind == FileKind::kJointFit ||
         kind == FileKind::kRubberLaw || kind == FileKind::kOtherJson;
}

bool is_toml(std::string_view text) {
  std::size_t n_keys = 0, n_lines = 0;
  constexpr std::size_t kEnough = 12;
  while (!text.empty() && n_lines < kEnough) {
    const std::string_view line = take_line(text);
    if (line.empty() || line.front() == '#') continue;
    ++n_lines;
    if (line.front() == '[' && is_key(line.substr(1, std::min(line.find(']'), line.size()) - 1))) {
      const bool closes = line.find(']') != std::string_view::npos;
      if (closes && line.find_first_of(",;\t") == std::string_view::npos) continue;
    }
    const std::size_t equals = line.find(" = ");
    if (equals == std::string_view::npos || !is_key(trimmed(line.substr(0, equals)))) return false;
    ++n_keys;
  }
  return n_keys > 0;
}

FileKind kind_of_file(std::string_view contents) {
  if (contents.starts_with("SQLite format 3\0"sv)) {
    constexpr std::string_view kApplication = "VCAP";  // io/capture sets it
    return contents.substr(0, 100).find(kApplication) == std::string_view::npos
               ? FileKind::kStudyAnswers
               : FileKind::kCapture;
  }
  const std::string_view head =
      contents.substr(0, std::min(contents.find("\"terms\""), std::size_t{65536}));
  const bool is_control = std::any_of(head.begin(), head.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && "\t\n\r\f\v"sv.find(c) == std::string_view::npos;
  });
  if (is_control) return FileKind::kBinary;
  const std::string_view text = trimmed(head.starts_with("\xef\xbb\xbf") ? head.substr(3) : head);
  if (text.find_first_not_of(" \t\r\n\f\v") == std::string_view::npos) return FileKind::kEmpty;
  if (is_page(text)) return FileKind::kPage;
  const std::size_t inside = text.find_first_not_of(" \t\r\n", 1);
  if (text.front() == '{' &&
      (inside == std::string_view::npos || text[inside] == '"' || text[inside] == '}')) {
    // The schema may be the last key, behind "terms".
    const bool has_schema = text.find("\"schema\"") != std::string_view::npos;
    return json_kind(has_schema ? text : contents);
  }
  const bool is_list =
      text.front() == '[' && inside != std::string_view::npos &&
      std::string_view("0123456789-{\"]").find(text[inside]) != std::string_view::npos;
  if (is_list) return FileKind::kOtherJson;
  if (is_toml(text)) return toml_kind(text);
  if (toml_kind(text) != FileKind::kOtherToml) return toml_kind(text);
  if (is_table(text)) return FileKind::kTable;
  const std::string_view first = text.substr(0, text.find('\n'));
  const bool is_card = first.find("viscard ") != std::string_view::npos &&
                       first.find(" for ") != std::string_view::npos;
  return is_card ? FileKind::kCard : FileKind::kOther;
}

std::string file_kind_in_words(FileKind kind) {
  return row_of(kind).what;
}

std::string use_of_file_kind(FileKind kind) {
  return row_of(kind).use;
}

std::string form_of_file_kind(FileKind kind) {
  return example_with_data(row_of(kind).example);
}

namespace {

// An incomplete file of the wanted kind may look like one of the found kind.
bool shares_sections(FileKind found, FileKind wanted) {
  constexpr std::array<std::pair<FileKind, FileKind>, 3> kShared{
      {{FileKind::kCalibration, FileKind::kRig},
       {FileKind::kSpecimen, FileKind::kTruth},
       {FileKind::kRequirements, FileKind::kDesignTask}}};
  return std::find(kShared.begin(), kShared.end(), std::pair(found, wanted)) != kShared.end();
}

}  // namespace

void refuse_other_kind(std::string_view contents, const std::string& name, FileKind wanted) {
  const FileKind kind = kind_of_file(contents);
  if (kind == wanted) return;
  const bool is_same_form =
      is_json_kind(wanted) ? kind == FileKind::kOtherJson : kind == FileKind::kOtherToml;
  if (is_same_form || shares_sections(kind, wanted)) return;
  // A text of no form that is known is most likely the wanted one with a mistake in its first lines,
  // unless another form begins differently.
  if (kind == FileKind::kOther && !is_json_kind(wanted)) return;
  const KindRow& found = row_of(kind);
  const KindRow& expected = row_of(wanted);
  const std::string use = found.use;
  throw std::runtime_error(
      name + ":1: is " + found.what + ", not " + expected.what + "; " +
      (use.empty() ? example_with_data(std::string("expected ") + expected.example) : use));
}

}  // namespace viscard
