#include "io/cli/words/json_output.h"

#include "io/basics/json_string.h"
#include "io/flow/command_error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace viscard {
namespace {

CommandError error_of(const std::exception& error) {
  const bool is_usage = dynamic_cast<const UsageError*>(&error) != nullptr;
  return is_usage ? command_error("usage", error.what()) : command_error(error);
}

// Messages and names may hold bytes that are not UTF-8.
template <typename Json>
void print_line(const Json& object, Streams& streams, int indent) {
  streams.out << printable_text_from_json(object, indent) << "\n";
  streams.has_printed_json = true;
}

}  // namespace

template <typename Json>
Json with_head(const JsonHead& head, Json object) {
  Json out;
  out["schema"] = head.schema;
  out["version"] = VISCARD_VERSION;
  out["inputs"] = head.inputs;
  if (head.accepts_implausible) out["plausible"] = "off";
  for (auto& [key, value] : object.items()) out[key] = std::move(value);
  return out;
}

template <typename Json>
void print_json(const JsonHead& head, Json object, Streams& streams, int indent) {
  const JsonHead of_command{head.schema, head.inputs, streams.accepts_implausible};
  print_line(with_head(of_command, std::move(object)), streams, indent);
}

template nlohmann::json with_head(const JsonHead&, nlohmann::json);
template nlohmann::ordered_json with_head(const JsonHead&, nlohmann::ordered_json);
template void print_json(const JsonHead&, nlohmann::json, Streams&, int);
template void print_json(const JsonHead&, nlohmann::ordered_json, Streams&, int);

int with_json_errors(const Words& words, Streams& streams, const std::function<int()>& command) {
  try {
    return command();
  } catch (const std::exception& error) {
    const bool is_asked = std::find(words.begin(), words.end(), "--json") != words.end();
    if (is_asked && !streams.has_printed_json) {
      const nlohmann::ordered_json json = {{"schema", "viscard-error/1"},
                                           {"version", VISCARD_VERSION},
                                           {"error", json_from_error(error_of(error))}};
      print_line(json, streams, -1);
    }
    throw;
  }
}

}  // namespace viscard
