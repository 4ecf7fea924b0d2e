#pragma once

#include "io/cli/words/command_syntax.h"
#include "io/cli/words/streams.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>

namespace viscard {

// Every object of --json begins with "schema" (the file in io/schemas that describes its keys),
// "version" (of viscard) and "inputs" (the files that were read, as the user named them).
struct JsonHead {
  const char* schema;  // "viscard-fit/1"
  Words inputs;
  bool accepts_implausible = false;  // "plausible": "off"
};

// The object with its head in front. A schema of its own stays. Json: json or ordered_json.
template <typename Json>
Json with_head(const JsonHead& head, Json object);

// Prints the object with its head on stdout. indent -1: in one line.
template <typename Json>
void print_json(const JsonHead& head, Json object, Streams& streams, int indent = 2);

// The same if --json was given; returns whether it was.
template <typename Json>
bool print_json(const CommandSyntax& syntax, const JsonHead& head, const Json& object,
                Streams& streams) {
  if (!syntax.as_json) return false;
  print_json(head, object, streams);
  return true;
}

// Runs a command. If it throws, --json is among its words, and no object has been printed, prints
// {"error": {"code", "message", "where", "hint"}} with schema and version as one line on stdout; the
// exception goes on in any case.
int with_json_errors(const Words& words, Streams& streams, const std::function<int()>& command);

}  // namespace viscard
