#pragma once

#include "models/material/material.h"

#include <nlohmann/json.hpp>

#include <string>

namespace viscard {

// Conversions between a Material and its JSON, for the files of this room. Keys keep their order.
using Json = nlohmann::ordered_json;

// Why nlohmann::json refused a value, without the tag in front.
std::string reason_of(const Json::exception& error);

// Throws std::runtime_error naming the file (name), line and column of a fault, or a duplicate key.
Json parse_json(const std::string& text, const std::string& name);

// Throws std::runtime_error naming the file (name) and the key.
Material material_from(const Json& json, const std::string& name);

Json json_from(const Material& material);
// [low, high]; null for an end without bound, because JSON has no infinity.
Json json_from(const Interval& interval);

// Throws std::runtime_error unless it is a whole number that an int can hold.
int whole_number(const Json& json);

// Adds the key body_sha256: the SHA-256 of all other keys and values, so that a change by hand or by a
// worn disk is noticed. Spaces and line breaks do not count.
void add_body_sum(Json& json);
// True if the file of this text has that key, with the right sum: it is as viscard wrote it. Throws
// std::runtime_error if the text is not JSON.
bool has_own_sum(const std::string& text);
// Name and text of the flag of what was changed since. A file without the key was written by hand, or by
// an earlier version, and is not known to be changed.
inline constexpr const char* kEdited = "edited";
inline constexpr const char* kEditedText =
    "the file was edited since it was written by viscard fit";
// Name of the flag of what was read from a card by viscard that states no sum of its text.
inline constexpr const char* kUncheckedCardFlag = "card-unchecked";
// Whether a flag states that the record behind a material may not be what was written: edited, or fitted from a
// damaged capture (integrity_notes()). Such a flag goes into whatever is made of the material.
bool is_doubt_of_record(const MaterialFlag& flag);
// The same of a file that was just read, whose doubts are noted (note_input()): edited, or written by viscard
// and without the key.
bool is_edited(const Json& json, const std::string& name);

// Copies to `fresh` the values in `original` whose keys viscard does not know.
void carry_unknown_keys(const Json& original, Json& fresh);

}  // namespace viscard
