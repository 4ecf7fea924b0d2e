#include "io/results/result_schema.h"

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

using Json = nlohmann::ordered_json;

bool holds(const Json& list, const Json& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

// Types that either allows.
Json union_of(const Json& a, const Json& b) {
  Json all = a.is_array() ? a : Json::array({a});
  for (const Json& one : b.is_array() ? b : Json::array({b})) {
    if (!holds(all, one)) all.push_back(one);
  }
  return all.size() == 1 ? all.front() : all;
}

// A schema of all that either describes; what only one of them requires is not always there.
Json merged(Json a, const Json& b) {
  if (a.is_null()) return b;
  if (b.is_null()) return a;
  if (a.contains("type") && b.contains("type")) a["type"] = union_of(a["type"], b["type"]);
  if (a.contains("enum") && b.contains("enum")) {
    for (const Json& word : b["enum"]) {
      if (!holds(a["enum"], word)) a["enum"].push_back(word);
    }
  }
  if (a.contains("properties") && b.contains("properties")) {
    for (const auto& [key, schema] : b["properties"].items()) {
      Json& mine = a["properties"][key];
      mine = merged(mine, schema);
    }
  }
  if (a.contains("required") && b.contains("required")) {
    Json both = Json::array();
    for (const Json& key : a["required"]) {
      if (holds(b["required"], key)) both.push_back(key);
    }
    a["required"] = std::move(both);
  }
  for (const char* key : {"items", "additionalProperties"}) {
    if (b.contains(key) && b[key].is_object()) {
      a[key] = merged(a.contains(key) && a[key].is_object() ? a[key] : Json(), b[key]);
    }
  }
  return a;
}

Json closed_object() {
  return {{"type", "object"},
          {"properties", Json::object()},
          {"required", Json::array()},
          {"additionalProperties", false}};
}

const Json kNumber = Json::array({"number", "null"});

class SchemaWriter : public ResultVisitor {
 public:
  SchemaWriter() { frames_.push_back({Part::kObject, "", closed_object()}); }
  Json schema() const { return frames_.front().schema; }

  void document(std::string_view key, const std::string& /*json*/, const char* what) override {
    add(key, {{"type", "object"}}, what);
  }
  void documents(std::string_view key, const std::vector<std::string>& /*json*/,
                 const char* what) override {
    add_list(key, {{"type", "object"}}, what);
  }

 protected:
  void number(std::string_view key, double /*value*/, const char* what) override {
    add(key, {{"type", kNumber}}, what);
  }
  void whole(std::string_view key, std::int64_t /*value*/, const char* what) override {
    add(key, {{"type", "integer"}}, what);
  }
  void flag(std::string_view key, bool /*value*/, const char* what) override {
    add(key, {{"type", "boolean"}}, what);
  }
  void text(std::string_view key, const std::string& /*value*/, const char* what,
            const std::vector<const char*>* words) override {
    Json schema{{"type", "string"}};
    if (words != nullptr) schema["enum"] = *words;
    add(key, schema, what);
  }
  void pair(std::string_view key, const Interval& /*value*/, const char* what) override {
    add(key, {{"type", "array"}, {"items", {{"type", kNumber}}}, {"minItems", 2}, {"maxItems", 2}},
        what);
  }
  void numbers(std::string_view key, const std::vector<double>& /*values*/,
               const char* what) override {
    add_list(key, {{"type", kNumber}}, what);
  }
  void wholes(std::string_view key, const std::vector<std::int64_t>& /*values*/,
              const char* what) override {
    add_list(key, {{"type", "integer"}}, what);
  }
  void texts(std::string_view key, const std::vector<std::string>& /*values*/,
             const char* what) override {
    add_list(key, {{"type", "string"}}, what);
  }
  void flags(std::string_view key, const std::vector<bool>& /*values*/, const char* what) override {
    add_list(key, {{"type", "boolean"}}, what);
  }
  void matrix(std::string_view key, const Eigen::MatrixXd& /*values*/, const char* what) override {
    add_list(key, {{"type", "array"}, {"items", {{"type", kNumber}}}}, what);
  }
  void null(std::string_view /*key*/) override {}
  void open(Part part, std::string_view key, const char* what) override {
    Json schema = closed_object();
    if (part == Part::kList) schema = {{"type", "array"}};
    if (part == Part::kMap) schema = {{"type", "object"}};
    if (part != Part::kEntry) schema["description"] = what;
    frames_.push_back(
        {part, std::string(key), std::move(schema), std::exchange(is_nullable_, false)});
  }
  void close() override {
    Frame done = std::move(frames_.back());
    frames_.pop_back();
    if (done.part == Part::kEntry) {
      Json& items = frames_.back().schema["items"];
      items = merged(items, done.schema);
    } else {
      is_nullable_ = done.is_nullable;
      put(done.key, std::move(done.schema));
    }
  }
  bool describes() const override { return true; }
  void sometimes(bool begins) override { frames_.back().sometimes += begins ? 1 : -1; }
  void may_be_null() override { is_nullable_ = true; }

 private:
  struct Frame {
    Part part;
    std::string key;
    Json schema;
    bool is_nullable = false;
    int sometimes = 0;
  };

  void add(std::string_view key, Json schema, const char* what) {
    schema["description"] = what;
    put(std::string(key), std::move(schema));
  }
  void add_list(std::string_view key, const Json& items, const char* what) {
    add(key, {{"type", "array"}, {"items", items}}, what);
  }
  void put(const std::string& key, Json schema) {
    if (std::exchange(is_nullable_, false)) {
      schema["type"] = union_of(schema["type"], "null");
      if (schema.contains("enum")) schema["enum"].push_back(nullptr);
    }
    Frame& in = frames_.back();
    if (in.part == Part::kMap) {
      Json& any = in.schema["additionalProperties"];
      any = merged(any, schema);
      return;
    }
    Json& mine = in.schema["properties"][key];
    mine = merged(mine, schema);
    Json& required = in.schema["required"];
    if (in.sometimes == 0 && !holds(required, key)) required.push_back(key);
  }

  std::vector<Frame> frames_;
  bool is_nullable_ = false;
};

Json schema_of_keys(const DescribedResult& result) {
  Json schema;
  for (const ShowKeys& show : result.examples) {
    SchemaWriter writer;
    show(writer);
    schema = merged(schema, writer.schema());
  }
  return schema;
}

// --- tables of keys ------------------------------------------------------------------------------------

std::string kind_of(const Json& schema) {
  if (!schema.contains("type")) return "any";
  const Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
  std::string text;
  if (schema.contains("enum") && schema["enum"].size() < 6) {
    for (const Json& word : schema["enum"]) {
      if (word.is_string()) text += (text.empty() ? "`" : " or `") + word.get<std::string>() + "`";
    }
  }
  for (const Json& type : types) {
    const auto name = type.get<std::string>();
    if (name == "null") {
      if (types.front() != "number") text += " or null";
    } else if (text.empty() || name != "string") {
      text += text.empty() ? "" : " or ";
      text += name == "string"    ? "text"
              : name == "boolean" ? "true or false"
              : name == "integer" ? "whole number"
              : name == "array"   ? "list"
                                  : name;
    }
  }
  return text;
}

// " {`a`, `b`}" of the keys of an object, or of the objects of a list.
std::string names_below(const Json& schema) {
  const Json& object = schema.contains("items") ? schema["items"] : schema;
  if (!object.contains("properties")) return "";
  std::string names;
  for (const auto& [key, unused] : object["properties"].items()) {
    names += (names.empty() ? "`" : ", `") + key + "`";
  }
  return " {" + names + "}";
}

void list_below(const Json& schema, const std::string& path, std::string& out) {
  if (schema.contains("items")) list_below(schema["items"], path + "[]", out);
  if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object()) {
    list_below(schema["additionalProperties"], path + ".*", out);
  }
  if (!schema.contains("properties")) return;
  const Json& required = schema["required"];
  for (const auto& [key, below] : schema["properties"].items()) {
    std::string at = path;
    at += (path.ends_with(' ') ? "" : ".") + key;
    out += at + (holds(required, key) ? ": " : "?: ") + kind_of(below) + "\n";
    list_below(below, at, out);
  }
}

}  // namespace

Json schema_of(const DescribedResult& result) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"$id", "urn:viscard:" + result.name + ":1"},
              {"title", result.title}};
  Json head = closed_object();
  head["properties"]["schema"] = {{"const", "viscard-" + result.name + "/1"},
                                  {"description", "name and version of this description"}};
  head["properties"]["version"] = {{"type", "string"}, {"description", "version of viscard"}};
  head["required"] = {"schema", "version"};
  if (result.has_inputs) {
    head["properties"]["inputs"] = {
        {"type", "array"},
        {"items", {{"type", "string"}}},
        {"description", "the files that were read, as they were named"}};
    head["required"].push_back("inputs");
    head["properties"]["plausible"] = {
        {"const", "off"},
        {"description", "the ranges of plausible values were switched off; missing otherwise"}};
  }
  Json file = closed_object();
  file["properties"]["path"] = {{"type", "string"}, {"description", "its name"}};
  file["properties"]["sha256"] = {{"type", "string"},
                                  {"description", "the SHA-256 of what was read"}};
  file["properties"]["note"] = {
      {"type", "string"}, {"description", "what must be known of it, such as that it was edited"}};
  file["required"] = {"path", "sha256"};
  head["properties"]["input_files"] = {
      {"type", "array"},
      {"items", file},
      {"description", "every file that was read, also those that the inputs name"}};
  Json keys = schema_of_keys(result);
  for (const auto& [key, below] : keys["properties"].items()) head["properties"][key] = below;
  for (const Json& key : keys["required"]) head["required"].push_back(key);
  schema.update(head);
  return schema;
}

std::string table_of_keys(const std::vector<DescribedResult>& results) {
  std::string text;
  for (const DescribedResult& result : results) {
    const Json schema = schema_of_keys(result);
    text += "\n**" + result.title + "**: `viscard-" + result.name + "/1`\n\n";
    text += "| key | value | what |\n|---|---|---|\n";
    for (const auto& [key, below] : schema["properties"].items()) {
      text += "| `" + key + "`" + (holds(schema["required"], key) ? "" : " (not always)") + " | " +
              kind_of(below) + " | " + below["description"].get<std::string>() +
              names_below(below) + " |\n";
    }
  }
  return text;
}

std::string list_of_keys(const std::vector<DescribedResult>& results) {
  std::string text;
  for (const DescribedResult& result : results) {
    list_below(schema_of_keys(result), result.name + " ", text);
  }
  return text;
}

}  // namespace viscard
