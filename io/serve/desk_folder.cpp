#include "io/serve/desk_folder.h"

#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/basics/words.h"
#include "io/basics/words_file.h"
#include "io/serve/api_error.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace viscard {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestFileName = 100;  // bytes

constexpr std::size_t kBeginning_B = 16 * 1024;  // that tells the kind of a file

constexpr const char* kKeptEnding = ".options";
constexpr const char* kKeptHead = "# Options kept by viscard desk";

// Endings of files that hold tables although their contents do not look like one at once.
constexpr const char* kTableEndings[] = {".csv", ".tsv",  ".txt", ".dat", ".asc", ".xlsx", ".mat",
                                         ".npy", ".hdf5", ".h5",  ".xls", ".out", ".prn"};

FileKind kind_of_beginning(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(kBeginning_B, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  return kind_of_file(begin);
}

// In letters of any case: some file systems know no difference.
bool has_ending(const std::string& name, const std::string& ending) {
  if (name.size() < ending.size()) return false;
  return std::equal(ending.rbegin(), ending.rend(), name.rbegin(), [](char lower, char c) {
    return lower == (c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c);
  });
}

bool has_table_ending(const fs::path& path) {
  const std::string name = path.filename().string();
  return std::any_of(std::begin(kTableEndings), std::end(kTableEndings),
                     [&](const char* ending) { return has_ending(name, ending); });
}

// By its contents, and by its ending where they do not tell.
bool is_table(const fs::path& path, FileKind kind) {
  if (kind == FileKind::kTable || kind == FileKind::kCapture) return true;
  const bool is_unclear =
      kind == FileKind::kOther || kind == FileKind::kBinary || kind == FileKind::kEmpty;
  return is_unclear && has_table_ending(path);
}

// The first of name.csv, name.2.csv ... that is free.
fs::path free_path(const fs::path& first) {
  fs::path path = first;
  for (int n = 2; fs::exists(fs::symlink_status(path)); ++n) {
    path = first.parent_path() /
           (first.stem().string() + "." + std::to_string(n) + first.extension().string());
  }
  return path;
}

// All that are not hidden, by name.
std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    const std::string name = entry->path().filename().string();
    if (name.front() != '.' && entry->is_regular_file(ignored)) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// True for a file of the folder itself. Only the name decides: a path would have to be the last part of itself.
bool is_file_of(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  return !name.empty() && name.front() != '.' && fs::path(name).filename() == name &&
         name.find('\0') == std::string::npos && fs::is_regular_file(folder / name, ignored);
}

}  // namespace

std::string plain_file_name(const std::string& name) {
  const std::size_t slash = name.find_last_of("/\\");
  std::string plain = slash == std::string::npos ? name : name.substr(slash + 1);
  for (char& c : plain) {
    const auto byte = static_cast<unsigned char>(c);
    // Bytes of UTF-8 stay.
    const bool is_kept =
        byte >= 0x80 || std::isalnum(byte) != 0 || std::strchr("._-+() ,", c) != nullptr;
    if (!is_kept || c == '\0') c = '_';
  }
  const std::size_t begin = plain.find_first_not_of(" .-_");
  if (begin == std::string::npos) return "";
  plain.erase(0, begin);
  plain.erase(plain.find_last_not_of(" .") + 1);
  if (plain.size() > kLongestFileName) {
    const std::string ending = fs::path(plain).extension().string().substr(0, 10);
    std::size_t end = kLongestFileName - ending.size();
    // Not within a character of UTF-8.
    while (end > 0 && (static_cast<unsigned char>(plain[end]) & 0xc0u) == 0x80u) --end;
    plain = plain.substr(0, end) + ending;
    plain.erase(plain.find_last_not_of(" .") + 1);
  }
  // What the desk keeps beside a table must not come from elsewhere; last, of the name as it will stand there.
  if (has_ending(plain, kKeptEnding)) plain[plain.size() - std::strlen(kKeptEnding)] = '_';
  // What is chosen for a table of this name would be the words of every report.
  if (plain.size() == std::strlen("report") && has_ending(plain, "report")) plain += "_1";
  return plain;
}

DeskFolder::DeskFolder(fs::path path) : path_(fs::absolute(path)) {
  if (fs::exists(path_) && !fs::is_directory(path_)) {
    throw std::runtime_error(path_.string() + " is a file; name the folder that holds the tables");
  }
  std::error_code error;
  fs::create_directory(path_, error);
  if (error) {
    throw std::runtime_error(path_.string() + ": cannot create this folder: " + error.message() +
                             ". Name one that you may write to");
  }
}

std::string DeskFolder::trouble() const {
  if (!fs::is_directory(path_)) return path_.string() + " is gone";
  if (::access(path_.c_str(), W_OK | X_OK) == 0) return "";
  return path_.string() + " cannot be written to: " + std::strerror(errno);
}

std::vector<DeskTable> DeskFolder::tables() const {
  std::vector<DeskTable> tables;
  for (const fs::path& file : files_of(path_)) {
    if (tables.size() == kMostDeskFiles) break;
    const FileKind kind = kind_of_beginning(file);
    if (!is_table(file, kind)) continue;
    std::error_code ignored;
    tables.push_back(
        {file.filename().string(), fs::file_size(file, ignored), kind == FileKind::kCapture});
  }
  return tables;
}

void DeskFolder::require_table(const std::string& name) const {
  const fs::path file = path_ / name;
  if (is_file_of(path_, name) && is_table(file, kind_of_beginning(file))) return;
  throw ApiError(404, "no-such-file",
                 "there is no table '" + name + "' in " + path_.string() +
                     ". Choose one of the list, or drop it");
}

std::string DeskFolder::drop(const std::string& name, const std::string& bytes) const {
  const std::string plain = plain_file_name(name);
  if (plain.empty()) {
    throw ApiError(400, "bad-value", "'" + name + "' is no name of a file; give it another one");
  }
  if (bytes.empty()) throw ApiError(400, "bad-value", plain + " is empty; choose another file");
  const FileKind kind = kind_of_file(std::string_view(bytes).substr(0, kBeginning_B));
  if (!is_table(plain, kind) && kind != FileKind::kScene) {
    throw ApiError(422, "input",
                   plain + " is " + file_kind_in_words(kind) +
                       "; the desk takes tables, captures and scenes. " + use_of_file_kind(kind));
  }
  return keep_new(plain, bytes);
}

std::string DeskFolder::free_name(const std::string& name) const {
  return free_path(path_ / name).filename().string();
}

std::string DeskFolder::keep_new(const std::string& name, const std::string& bytes) const {
  std::error_code ignored;
  std::size_t count = 0;
  for (fs::directory_iterator entry(path_, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    ++count;
  }
  if (count >= 4 * kMostDeskFiles) {
    throw ApiError(409, "full",
                   path_.string() + " holds " + std::to_string(count) +
                       " files. Move some to another folder, or start viscard desk on another one");
  }
  // Another page may take the name meanwhile; then the next one.
  for (int tries = 0;; ++tries) {
    const fs::path path = free_path(path_ / name);
    try {
      write_file(path, bytes, false);
      return path.filename().string();
    } catch (const std::exception&) {
      if (tries >= 20 || !fs::exists(fs::symlink_status(path))) throw;
    }
  }
}

std::vector<std::string> DeskFolder::scenes() const {
  std::vector<std::string> names;
  for (const fs::path& file : files_of(path_)) {
    if (names.size() == kMostDeskFiles) break;
    if (kind_of_beginning(file) == FileKind::kScene) names.push_back(file.filename().string());
  }
  return names;
}

void DeskFolder::require_scene(const std::string& name) const {
  if (is_file_of(path_, name) && kind_of_beginning(path_ / name) == FileKind::kScene) return;
  throw ApiError(404, "no-such-file",
                 "there is no scene '" + name + "' in " + path_.string() +
                     ". Choose one of the list, or begin with an example");
}

std::string DeskFolder::keep_scene(const std::string& name, const std::string& text) const {
  require_scene(name);
  const bool has_head = text.starts_with(kSceneHead);
  const std::string all = has_head ? text : std::string(kSceneHead) + ", of " + name + "\n" + text;
  if (!read_own_file(path_ / name).starts_with(kSceneHead)) return keep_new(name, all);
  rewrite_file(path_ / name, all);
  return name;
}

std::vector<std::string> DeskFolder::kept_words(const std::string& table) const {
  const fs::path file = path_ / (table + kKeptEnding);
  if (!fs::exists(file)) return {};
  return words_of_file(file);
}

void DeskFolder::keep_words(const std::string& table, const std::vector<std::string>& words) const {
  const fs::path file = path_ / (table + kKeptEnding);
  const bool is_there = fs::exists(fs::symlink_status(file));
  if (is_there && !read_own_file(file).starts_with(kKeptHead)) {
    throw ApiError(409, "exists",
                   file.filename().string() +
                       " was not written by the desk, so it is not replaced. Rename it, and what "
                       "you choose is kept");
  }
  if (words.empty()) {
    std::error_code ignored;
    if (is_there) fs::remove(file, ignored);
    return;
  }
  std::vector<std::string> command{"viscard", "fit", "@" + file.filename().string()};
  if (words.front().starts_with("--"))
    command.insert(command.begin() + 2, table.starts_with("-") ? "./" + table : table);
  std::string text = utf8_on_one_line(std::string(kKeptHead) + " for " + table +
                                      ", one a line: " + quoted_for_shell(command)) +
                     "\n";
  for (const std::string& word : words) text += word + "\n";
  if (is_there) {
    rewrite_file(file, text);
  } else {
    write_file(file, text, false);
  }
}

}  // namespace viscard
