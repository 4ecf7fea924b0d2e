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
