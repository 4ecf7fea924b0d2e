#pragma once

#include <nlohmann/json.hpp>

#include <string>

// JSON to text and back, compiled once: the library's parse() and dump() are templates, which each unit
// that calls them compiles again.
namespace viscard {

// As parse() of the library: throws its parse_error.
nlohmann::json json_from_text(const std::string& text);
// Discarded (is_discarded()) where the text is not JSON.
nlohmann::json json_or_discarded(const std::string& text);
// The keys stay in their order.
nlohmann::ordered_json ordered_json_from_text(const std::string& text);

// On one line where the indent is negative. Throws the library's type_error for strings that are not UTF-8.
std::string text_from_json(const nlohmann::json& json, int indent = -1);
std::string text_from_json(const nlohmann::ordered_json& json, int indent = -1);
// The same with U+FFFD for bytes that are not UTF-8.
std::string printable_text_from_json(const nlohmann::json& json, int indent = -1);
std::string printable_text_from_json(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace viscard
