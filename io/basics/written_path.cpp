#include "io/basics/written_path.h"

#include <atomic>

namespace viscard {
namespace {

std::atomic<bool> paths_are_stripped{false};

}  // namespace

void strip_written_paths(bool strips) {
  paths_are_stripped = strips;
}

std::string written_path(const std::string& path) {
  if (!paths_are_stripped || path.empty() || path.front() != '/') return path;
  const std::size_t end = path.find_last_not_of('/');
  if (end == std::string::npos) return path;
  return path.substr(path.rfind('/', end) + 1, end - path.rfind('/', end));
}

std::string written_word(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos) return written_path(word);
  return word.substr(0, equals + 1) + written_path(word.substr(equals + 1));
}

}  // namespace viscard
