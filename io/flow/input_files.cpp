#include "io/flow/input_files.h"

#include "io/basics/atomic_file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>

namespace viscard {
namespace {

[[noreturn]] void refuse_second(const std::string& first, const std::string& second) {
  const std::string what =
      first == second ? second + " is given twice" : second + " has the same contents as " + first;
  throw std::runtime_error(what + "; each record counts once. Remove one of the two");
}

}  // namespace

void refuse_repeated_files(const std::vector<std::string>& files) {
  std::map<std::uintmax_t, std::vector<std::size_t>> by_size;  // only equal sizes need a hash
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(files[i], error);
    if (error) continue;  // a pipe, or no file: the reader reports it
    by_size[size].push_back(i);
  }
  for (const auto& [size, members] : by_size) {
    if (members.size() < 2) continue;
    std::map<std::string, std::size_t> first_with;
    for (const std::size_t i : members) {
      const auto [first, is_new] = first_with.emplace(sha256_of_file(files[i]), i);
      if (!is_new) refuse_second(files[first->second], files[i]);
    }
  }
}

}  // namespace viscard
