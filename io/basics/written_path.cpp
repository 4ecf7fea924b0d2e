#include "io/basics/written_path.h"

#include <atomic>
#include <cctype>
#include <cstdlib>
#include <mutex>
#include <set>

namespace viscard {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> paths_are_stripped{false};

std::mutex& folders_mutex() {
  static std::mutex the_mutex;
  return the_mutex;
}

struct LongestFirst {
  bool operator()(const std::string& a, const std::string& b) const {
    return a.size() != b.size() ? a.size() > b.size() : a < b;
  }
};

// Without a slash at their ends.
std::set<std::string, LongestFirst>& folders() {
  static std::set<std::string, LongestFirst> all;
  return all;
}

bool leaves_folder(const std::string& path) {
  return path.starts_with('/') || path.starts_with("../") || path.find("/../") != std::string::npos;
}

void remember(const fs::path& folder) {
  std::string text = folder.string();
  while (text.size() > 1 && text.back() == '/') text.pop_back();
  if (text.size() > 1 && leaves_folder(text + "/")) folders().insert(text);
}

// A file of a list: its name and the folders above it that may be written, the nearest first.
struct ListedFile {
  std::vector<std::string> parts;
  std::size_t n_written = 1;  // parts

  std::string text() const {
    std::string all = parts.front();
    for (std::size_t i = 1; i < n_written; ++i) all = parts[i] + "/" + all;
    return all;
  }
};

// Folders that have the name of the user, or lie beside the homes of users.
bool is_home(const std::string& folder, const std::string& above) {
  if (above == "home" || above == "Users" || above == "users") return true;
  for (const char* const name : {"HOME", "USER", "LOGNAME"}) {
    const char* const value = std::getenv(name);
    if (value != nullptr && fs::path(value).filename() == folder) return true;
  }
  return folder == "home" || folder == "Users" || folder == "users";
}

// file: absolute and without "..".
ListedFile listed_file(const fs::path& file) {
  std::vector<std::string> all;
  for (const fs::path& part : file.relative_path()) {
    if (!part.empty()) all.push_back(part.string());
  }
  ListedFile listed;
  std::size_t begin = 0;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    if (is_home(all[i], i == 0 ? "" : all[i - 1])) begin = i + 1;
  }
  listed.parts.assign(all.rbegin(), all.rend() - static_cast<std::ptrdiff_t>(begin));
  return listed;
}

using ListedFiles = std::map<std::string, ListedFile>;  // by their full path

std::map<std::string, std::vector<std::string>> files_by_text(const ListedFiles& files) {
  std::map<std::string, std::vector<std::string>> of_text;
  for (const auto& [path, file] : files) of_text[file.text()].push_back(path);
  return of_text;
}

// Adds folders to the files whose text others have, too: other files, or values that are written as they stand.
void keep_apart(const std::set<std::string>& as_they_stand, ListedFiles& files) {
  for (bool is_longer = true; is_longer;) {
    is_longer = false;
    for (const auto& [text, same] : files_by_text(files)) {
      if (same.size() == 1 && as_they_stand.count(text) == 0) continue;
      for (const std::string& path : same) {
        ListedFile& file = files.at(path);
        if (file.n_written == file.parts.size()) continue;
        ++file.n_written;
        is_longer = true;
      }
    }
  }
}

bool is_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' || c == '-';
}

// Takes a folder out in front of a name, and shows it as "." where it stands alone.
void take_out(const std::string& folder, std::string& text) {
  for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) {
    const bool is_begin = at == 0 || (!is_of_name(text[at - 1]) && text[at - 1] != '/' &&
                                      text[at - 1] != '<');  // no tag
    const std::size_t end = at + folder.size();
    if (is_begin && end < text.size() && text[end] == '/') {
      text.erase(at, folder.size() + 1);
    } else if (is_begin && (end == text.size() || !is_of_name(text[end]))) {
      text.replace(at, folder.size(), ".");
    } else {
      ++at;
    }
  }
}

}  // namespace

void strip_written_paths(bool strips) {
  const std::lock_guard<std::mutex> lock(folders_mutex());
  paths_are_stripped = strips;
  if (!strips) return folders().clear();
  std::error_code none;
  remember(fs::current_path(none));
  if (const char* home = std::getenv("HOME")) remember(home);
}

std::string written_path(const std::string& path) {
  if (!paths_are_stripped || !leaves_folder(path)) return path;
  const std::size_t end = path.find_last_not_of('/');
  if (end == std::string::npos) return path;
  const std::size_t slash = path.rfind('/', end);
  const std::size_t begin = slash == std::string::npos ? 0 : slash + 1;
  return path.substr(begin, end + 1 - begin);
}

std::string written_word(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos) return written_path(word);
  return word.substr(0, equals + 1) + written_path(word.substr(equals + 1));
}

WrittenValues::WrittenValues(const std::vector<std::string>& values, const fs::path& folder) {
  if (!paths_are_stripped) return;
  const auto full_path = [&](const std::string& value) {
    std::error_code none;
    const fs::path path = fs::absolute(folder / value, none).lexically_normal();
    return path.has_filename() ? path : path.parent_path();
  };
  std::set<std::string> as_they_stand;
  std::map<std::string, std::string> standing;  // the same by path
  for (const std::string& value : values) {
    if (written_path(value) != value || !as_they_stand.insert(value).second) continue;
    standing[full_path(value).string()] = value;
  }
  ListedFiles files;
  std::map<std::string, std::string> path_of;  // by value
  std::vector<std::string> paths;              // in the order of the values
  for (const std::string& value : values) {
    const fs::path path = full_path(value);
    if (as_they_stand.count(value) > 0 || !path.has_filename()) continue;
    if (const auto same = standing.find(path.string()); same != standing.end()) {
      written_[value] = same->second;
      continue;
    }
    path_of[value] = path.string();
    if (files.try_emplace(path.string(), listed_file(path)).second) paths.push_back(path.string());
  }
  keep_apart(as_they_stand, files);
  const auto of_text = files_by_text(files);
  std::map<std::string, std::size_t> n_of_text;
  std::map<std::string, std::string> text_of;  // by path
  for (const std::string& path : paths) {
    const std::string text = text_of[path] = files.at(path).text();
    if (of_text.at(text).size() > 1 || as_they_stand.count(text) > 0)
      text_of[path] += " (" + std::to_string(++n_of_text[text]) + ")";
  }
  for (const auto& [value, path] : path_of) written_[value] = text_of[path];
}

std::string WrittenValues::operator()(const std::string& value) const {
  const auto found = written_.find(value);
  return found == written_.end() ? written_path(value) : found->second;
}

void remember_folder_of(const fs::path& file) {
  if (!paths_are_stripped || !file.has_parent_path()) return;
  const std::lock_guard<std::mutex> lock(folders_mutex());
  std::error_code none;
  const std::string folder = file.parent_path().string() + "/";
  remember(folder);
  // Of a name in a file, such as "../x/m.json", which was looked for from the folder of that file.
  if (const std::size_t up = folder.find("/../"); up != std::string::npos)
    remember(folder.substr(up + 1));
  remember(fs::absolute(file, none).lexically_normal().parent_path());
  remember(fs::weakly_canonical(file, none).parent_path());
}

std::string written_text(const std::string& text) {
  if (!paths_are_stripped || text.find('/') == std::string::npos) return text;
  const std::lock_guard<std::mutex> lock(folders_mutex());
  std::string written = text;
  for (const std::string& folder : folders()) take_out(folder, written);
  return written;
}

}  // namespace viscard
