#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Words and characters in messages, tables and pictures.

// "a, b, c".
std::string listed(const std::vector<std::string>& words);

// Returns the entry of `known` with the smallest edit distance (insertions, deletions, substitutions, swaps of
// neighbours; case does not count) to `word`, or "" if every distance exceeds a third of its length (at least 2, at most half).
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

// "; did you mean 'grbl'?" with the nearest known word, or `otherwise` if none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known,
                         const char* otherwise = ".");

// "there is no card target 'abaqu'; did you mean 'abaqus'? There are: abaqus, ansys"; kind: "card target".
std::string no_such_word(const std::string& kind, const std::string& word,
                         const std::vector<std::string>& known);

// The words with blanks between them, quoted for a shell where it needs that.
std::string quoted_for_shell(const std::vector<std::string>& words);

// The length in bytes of the UTF-8 character that begins at `at`; 0 if none does.
std::size_t utf8_length(std::string_view text, std::size_t at);

// The text on one line and as UTF-8, for any bytes it came with: control characters become blanks,
// bytes that are part of no character become \xHH.
std::string utf8_on_one_line(std::string_view text);

// The text for a terminal: control characters other than line feeds and tabs, and bytes that are part of no character,
// become \xHH.
std::string with_shown_controls(std::string_view text);

// The number of characters of UTF-8 text, which is what a reader sees; size() counts bytes.
std::size_t length_in_characters(std::string_view text);

// "⁻³".
std::string superscript(int exponent);

}  // namespace viscard
