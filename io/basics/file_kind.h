#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <string_view>

namespace viscard {

// Recognises a file by its contents, for messages about a file that is given in place of another
// kind.
enum class FileKind : std::uint8_t {
  kOther,
  kEmpty,
  kBinary,
  kCapture,
  kStudyAnswers,
  kTable,
  kRig,
  kRigTest,
  kSpecimen,
  kTruth,
  kCalibration,
  kScene,
  kStudy,
  kDesignTask,
  kRequirements,
  kOtherToml,
  kMaterial,
  kMedium,
  kJointFit,
  kRubberLaw,
  kOtherJson,
  kCard,
  kPage
};

// From the first lines alone; a file with mistakes is still of its kind.
FileKind kind_of_file(std::string_view contents);

// "a scene", "a table of numbers"; and what to do with it: "viscard fit, predict --against and report take it".
std::string file_kind_in_words(FileKind kind);
std::string use_of_file_kind(FileKind kind);
// "JSON as viscard fit --out writes it": how a file of a kind that can be expected looks.
std::string form_of_file_kind(FileKind kind);

// True for the kinds that are written as JSON.
bool is_json_kind(FileKind kind);

// Throws std::runtime_error "m.json:1: is a material, not a scene; viscard card ... take it" if the contents
// are certainly of another kind than wanted. `wanted` is a kind of TOML or JSON files.
void refuse_other_kind(std::string_view contents, const std::string& name, FileKind wanted);

// Calls read(). If it throws because the file is of another kind, throws what refuse_other_kind() does.
template <typename Read>
auto read_as(FileKind wanted, std::string_view contents, const std::string& name,
             const Read& read) {
  try {
    return read();
  } catch (const std::exception&) {
    refuse_other_kind(contents, name, wanted);
    throw;
  }
}

// True if all lines are [section], key = value or comments.
bool is_toml(std::string_view text);

}  // namespace viscard
