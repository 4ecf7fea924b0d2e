#include "io/cli/words/output_paths.h"

#include "io/basics/output_name.h"
#include "io/cli/words/streams.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace fs = std::filesystem;

namespace viscard {
namespace {

constexpr std::array<std::string_view, 7> kOutputs{"out", "csv",      "creep-csv", "svg",
                                                   "vtk", "pictures", "schemas"};

// Of viscard card, which checks the file by itself.
constexpr std::string_view kImport = "import";

struct NamedPath {
  std::string option;
  fs::path path;
  bool is_output = false;
};

std::vector<NamedPath> paths_among(const CommandSyntax& syntax) {
  std::vector<NamedPath> paths;
  for (const auto& [name, values] : syntax.given) {
    const bool is_output = std::find(kOutputs.begin(), kOutputs.end(), name) != kOutputs.end();
    for (const std::string& each : values) {
      if (!each.empty()) paths.push_back({name, each, is_output});
    }
  }
  return paths;
}

// Compares files, not names: links and other spellings of one file are the same. Two options may
// share a folder. A word that is not the name of a file ("relaxation") is never the same.
bool is_same_file(const fs::path& output, const NamedPath& other) {
  std::error_code error;
  if (fs::is_directory(output, error)) return false;
  if (fs::exists(output, error) && fs::exists(other.path, error)) {
    return fs::equivalent(output, other.path, error);
  }
  return other.is_output && fs::absolute(output, error).lexically_normal() ==
                                fs::absolute(other.path, error).lexically_normal();
}

void refuse_shared_file(const NamedPath& output, const std::vector<NamedPath>& all) {
  for (const NamedPath& other : all) {
    if (&other == &output || !is_same_file(output.path, other)) continue;
    throw UsageError("--" + output.option + " '" + output.path.string() + "' is also " +
                     (other.is_output ? "--" + other.option : "read by this command") +
                     "; choose another name for it");
  }
}

// The nearest existing parent must be a writable folder; some commands make the folders below it.
void refuse_unwritable_folder(const NamedPath& output) {
  std::error_code error;
  fs::path folder = fs::absolute(output.path, error).lexically_normal().parent_path();
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  const std::string where = "cannot write --" + output.option + " '" + output.path.string() + "': ";
  if (!fs::is_directory(folder, error)) {
    throw std::runtime_error(where + "'" + folder.string() +
                             "' is not a folder; choose another place");
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw std::runtime_error(where + std::strerror(errno) + " in '" + folder.string() +
                             "'; choose a folder with write permission");
  }
}

// "-" would make a file or folder of that name, which nobody wants who types it.
void refuse_standard_output(const NamedPath& path) {
  if (path.path != "-" || !(path.is_output || path.option == kImport)) return;
  throw UsageError(
      "--" + path.option +
      " '-': is standard output, and this option writes a file or folder; write ./- for "
      "one of that name");
}

// The ending of the one file that --out of a command is; "" for folders, and for cards, whose solver decides.
std::string_view ending_of_out(std::string_view command) {
  struct Output {
    std::string_view command, ending;
  };
  constexpr Output kWritten[]{{"viscard report", ".html"},    {"viscard export", ".csv"},
                              {"viscard fit", ".json"},       {"viscard sweep", ".sqlite"},
                              {"viscard calibrate", ".toml"}, {"viscard capture", ".viscap"}};
  const auto* const found = std::find_if(std::begin(kWritten), std::end(kWritten),
                                         [&](const Output& one) { return one.command == command; });
  return found == std::end(kWritten) ? "" : found->ending;
}

// Endings of formats that no command writes, and those of viscard's own formats at outputs of another.
void refuse_foreign_ending(const NamedPath& output, const std::string& command) {
  constexpr std::array<std::string_view, 19> kForeign{
      ".png", ".jpg", ".jpeg", ".gif", ".bmp", ".webp", ".tif", ".tiff", ".eps", ".ps",
      ".pdf", ".doc", ".docx", ".odt", ".xls", ".xlsx", ".ods", ".ppt",  ".pptx"};
  constexpr std::array<std::string_view, 4> kOwn{".svg", ".csv", ".html", ".json"};
  std::string ending = output.path.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  const std::string_view written = output.option == "svg"           ? ".svg"
                                   : output.option == "out"         ? ending_of_out(command)
                                   : output.option.ends_with("csv") ? ".csv"
                                                                    : "";
  const bool is_foreign = std::find(kForeign.begin(), kForeign.end(), ending) != kForeign.end();
  const bool is_of_other = !written.empty() && ending != written &&
                           std::find(kOwn.begin(), kOwn.end(), ending) != kOwn.end();
  if (!is_foreign && !is_of_other) return;
  const std::string name = "--" + output.option + " '" + output.path.string() + "'";
  if (written.empty()) {
    throw UsageError(name + ": no command writes " + ending + "; choose another ending");
  }
  throw UsageError(name + ": what is written is " + std::string(written).substr(1) + ", and " +
                   ending + " is another format; end its name with " + std::string(written));
}

// A folder, device or pipe is no file that anything can replace. where: begins the message.
void refuse_other_than_file(const std::string& where, const fs::path& output) {
  std::error_code error;
  switch (fs::status(output, error).type()) {
    case fs::file_type::character:
    case fs::file_type::block:
    case fs::file_type::fifo:
    case fs::file_type::socket:
      throw std::runtime_error(where +
                               "it is a device or pipe, not a file; name a file, and read that");
    case fs::file_type::directory:
      throw std::runtime_error(where + "it is a folder; name a file in it, such as '" +
                               (output / "result").string() + "'");
    default:
      return;
  }
}

}  // namespace

void refuse_folder_as_file(const std::string& option, const fs::path& output) {
  std::error_code error;
  const std::string where = "cannot write --" + option + " '" + output.string() + "': ";
  refuse_other_than_file(where, output);
  if (!output.has_filename()) {
    throw std::runtime_error(where + "it is a folder; name a file in it, such as '" +
                             (output / "result").string() + "'");
  }
  const fs::path folder = output.parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    throw std::runtime_error(where + "there is no folder '" + folder.string() +
                             "'; make it first, such as with mkdir -p");
  }
}

void check_output_paths(const CommandSyntax& syntax) {
  const std::vector<NamedPath> paths = paths_among(syntax);
  for (const NamedPath& path : paths) {
    refuse_standard_output(path);
    if (!path.is_output) continue;
    const std::string usage = syntax.usage;  // "viscard report FILE..."
    refuse_shared_file(path, paths);
    refuse_foreign_ending(path, usage.substr(0, usage.find(' ', usage.find(' ') + 1)));
    refuse_unwritable_folder(path);
    refuse_output_name(path.path);
    const auto& may_exist = syntax.may_exist;
    if (std::find(may_exist.begin(), may_exist.end(), path.option) != may_exist.end()) continue;
    refuse_folder_as_file(path.option, path.path);
    refuse_existing(path.path, syntax.given.count("force") > 0);
  }
}

void refuse_existing(const fs::path& output, bool overwrite) {
  refuse_other_than_file("cannot write '" + output.string() + "': ", output);
  if (overwrite || !fs::exists(output)) return;
  throw std::runtime_error("'" + output.string() +
                           "' exists already; pass --force to replace it, or choose another name");
}

}  // namespace viscard
