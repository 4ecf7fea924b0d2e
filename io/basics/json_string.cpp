#include "io/basics/json_string.h"

namespace viscard {
namespace {

template <typename Json>
std::string printable_text(const Json& json, int indent) {
  return json.dump(indent, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace);
}

}  // namespace

nlohmann::json json_from_text(const std::string& text) {
  return nlohmann::json::parse(text);
}

nlohmann::json json_or_discarded(const std::string& text) {
  return nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
}

nlohmann::ordered_json ordered_json_from_text(const std::string& text) {
  return nlohmann::ordered_json::parse(text);
}

std::string text_from_json(const nlohmann::json& json, int indent) {
  return json.dump(indent);
}

std::string text_from_json(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent);
}

std::string printable_text_from_json(const nlohmann::json& json, int indent) {
  return printable_text(json, indent);
}

std::string printable_text_from_json(const nlohmann::ordered_json& json, int indent) {
  return printable_text(json, indent);
}

}  // namespace viscard
