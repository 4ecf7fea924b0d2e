#include "io/basics/words_file.h"

#include "io/basics/atomic_file.h"
#include "models/maths/text_of_number.h"

namespace viscard {

std::vector<std::string> words_of_file(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  std::vector<std::string> words;
  for (const std::string_view line : split(text, '\n')) {
    const std::string_view word = trimmed(line);
    if (!word.empty() && word.front() != '#') words.emplace_back(word);
  }
  return words;
}

std::vector<std::string> with_words_of_files(const std::vector<std::string>& words) {
  std::vector<std::string> all;
  for (const std::string& word : words) {
    if (word.size() < 2 || word.front() != '@') {
      all.push_back(word);
      continue;
    }
    for (std::string& one : words_of_file(word.substr(1))) all.push_back(std::move(one));
  }
  return all;
}

}  // namespace viscard
