#pragma once

#include <random>
#include <string>
#include <vector>

namespace viscard::test {

// One random edit of a card, as a person's slip or another program would make it.
struct CardEdit {
  std::string kind;  // swap drop double scale unit sign keyword case separator
  std::string line;  // as it was
  std::string text;  // of the whole card after the edit
  std::string now;   // the line after the edit; "" if it was dropped
  bool is_comment = false;
};

inline const std::vector<std::string> kEditKinds{"swap", "drop",    "double", "scale",    "unit",
                                                 "sign", "keyword", "case",   "separator"};

// Which lines are edited: the comments of the header, or all others.
enum class EditPlace { kBody, kHeader };

// An edit of the kind at a random place. The text is unchanged if the place has nothing of that kind.
CardEdit random_edit(const std::string& text, const std::string& comment, const std::string& kind,
                     std::mt19937& random, EditPlace where = EditPlace::kBody);

// The card, and behind it all its lines but the comments once more with one number scaled, as if two
// cards were pasted into one file.
CardEdit with_second_element(const std::string& text, const std::string& comment,
                             std::mt19937& random);

}  // namespace viscard::test
