// Files that commands read besides tables, scenes and cards, each read or refused by one exception with a
// text. The environment variable VISCARD_FUZZ_TARGET names the kind, else the first byte picks it:
//   workbook  the input is a sheet within an .xlsx file; its first byte decides which of its parts
//   npy mat   the input is the file
//   study requirements design heights positions quadrants calibration   likewise, as text
//   store     the input overwrites bytes of a store of answers (two bytes of position, one of value)
//   material  the input overwrites bytes of a material file with a sum
#include "io/basics/atomic_file.h"
#include "io/config/config_file.h"
#include "io/flow/design/requirement_kinds.h"
#include "io/flow/optimise/design_spec.h"
#include "io/flow/sweep/study_store.h"
#include "io/materials/material_file.h"
#include "io/scenes/pillar_positions.h"
#include "io/tables/csv_table.h"
#include "tests/fuzz/fuzz_folder.h"

#include <zip.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

using namespace viscard;

// A workbook of one sheet; replaced names the part that holds bytes instead of what belongs there.
void write_workbook(const std::filesystem::path& path, std::size_t replaced,
                    const std::string& bytes) {
  constexpr std::array<std::array<std::string_view, 2>, 4> kParts{{
      {"xl/worksheets/sheet1.xml",
       R"(<worksheet><sheetData><row r="1"><c r="A1" t="s"><v>0</v></c><c r="B1" t="s"><v>1</v></c></row>)"
       R"(<row r="2"><c r="A2"><v>0</v></c><c r="B2"><v>1</v></c></row></sheetData></worksheet>)"},
      {"xl/sharedStrings.xml", R"(<sst><si><t>time_s</t></si><si><t>modulus_Pa</t></si></sst>)"},
      {"xl/workbook.xml",
       R"(<workbook xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships">)"
       R"(<sheets><sheet name="one" sheetId="1" r:id="rId1"/></sheets></workbook>)"},
      {"xl/_rels/workbook.xml.rels",
       R"(<Relationships><Relationship Id="rId1" Target="worksheets/sheet1.xml"/></Relationships>)"},
  }};
  int error = 0;
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
  if (archive == nullptr) std::abort();
  for (std::size_t part = 0; part < kParts.size(); ++part) {
    const std::string_view content = part == replaced % kParts.size() ? bytes : kParts[part][1];
    zip_source_t* source = zip_source_buffer(archive, content.data(), content.size(), 0);
    (void)zip_file_add(archive, std::string(kParts[part][0]).c_str(), source, ZIP_FL_OVERWRITE);
  }
  if (zip_close(archive) != 0) std::abort();
}

std::string overwritten(std::string whole, const std::string& bytes) {
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
    const std::size_t place =
        static_cast<std::uint8_t>(bytes[i]) << 8U | static_cast<std::uint8_t>(bytes[i + 1]);
    whole[place % whole.size()] = bytes[i + 2];
  }
  return whole;
}

const Study& study() {
  static const Study one = [] {
    std::filesystem::copy_file(VISCARD_FUZZ_DATA "/scenes/pillar_press.toml",
                               fuzz_folder() / "scene.toml");
    write_file(fuzz_folder() / "study.toml",
               "scene = \"scene.toml\"\n[[parameter]]\nkey = \"geometry.diameter\"\nvalues = [\"20 "
               "um\", \"30 um\"]\n",
               true);
    return read_study(fuzz_folder() / "study.toml");
  }();
  return one;
}

const std::string& whole_store() {
  static const std::string bytes = [] {
    const auto path = fuzz_folder() / "whole.sqlite";
    {
      StudyStore store(path, study());
      store.add(StudyPoint{.point = 0,
                           .values = {},
                           .results = {{"voltage_V", 1.0, "V", 0.0}},
                           .failure = "",
                           .kind = {}});
    }
    return read_file(path);
  }();
  return bytes;
}

void read_store(const std::string& bytes) {
  const auto path = fuzz_folder() / "fuzz.sqlite";
  write_file(path, overwritten(whole_store(), bytes), true);
  StudyStore store(path, study());
  (void)store.done();
}

struct Kind {
  std::string_view name;
  std::function<void(const std::string&)> read;
};

// A file of this name with the input in it.
template <class Read>
std::function<void(const std::string&)> as_file(const char* name, Read read) {
  return [name, read](const std::string& bytes) {
    write_file(fuzz_folder() / name, bytes, true);
    (void)read(fuzz_folder() / name);
  };
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"workbook",
       [](const std::string& bytes) {
         write_workbook(fuzz_folder() / "fuzz.xlsx",
                        bytes.empty() ? 0 : static_cast<std::uint8_t>(bytes[0]),
                        bytes.substr(bytes.empty() ? 0 : 1));
         (void)read_csv(fuzz_folder() / "fuzz.xlsx");
       }},
      {"npy", as_file("fuzz.npy", [](const auto& path) { return read_csv(path); })},
      {"mat", as_file("fuzz.mat", [](const auto& path) { return read_csv(path); })},
      {"study", as_file("fuzz_study.toml", [](const auto& path) { return read_study(path); })},
      {"requirements",
       as_file("fuzz_want.toml", [](const auto& path) { return read_requirements(path); })},
      {"design",
       as_file("fuzz_design.toml", [](const auto& path) { return read_design_spec(path); })},
      {"heights", as_file("fuzz_heights.csv", [](const auto& path) { return read_heights(path); })},
      {"positions",
       as_file("fuzz_positions.csv", [](const auto& path) { return read_positions(path); })},
      {"quadrants",
       as_file("fuzz_volts.csv", [](const auto& path) { return read_quadrant_voltages(path); })},
      {"calibration",
       as_file("fuzz_cell.toml", [](const auto& path) { return read_calibration(path); })},
      {"store", read_store},
      {"material",
       [](const std::string& bytes) {
         static const std::string whole =
             read_file(VISCARD_FUZZ_DATA "/materials/pdms_1to10_seed.json");
         write_file(fuzz_folder() / "fuzz.json", overwritten(whole, bytes), true);
         (void)read_material(fuzz_folder() / "fuzz.json");
       }},
  };
  return all;
}

const Kind& kind_of(std::uint8_t first) {
  static const char* const name = std::getenv("VISCARD_FUZZ_TARGET");
  if (name == nullptr) return kinds()[first % kinds().size()];
  for (const Kind& kind : kinds()) {
    if (kind.name == name) return kind;
  }
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    kind_of(data[0]).read(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  } catch (const std::runtime_error& error) {
    if (std::string(error.what()).empty()) __builtin_trap();
  } catch (const std::invalid_argument& error) {
    if (std::string(error.what()).empty()) __builtin_trap();
  }
  return 0;
}
