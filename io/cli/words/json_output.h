#pragma once

#include "io/cli/words/command_syntax.h"
#include "io/cli/words/streams.h"
#include "io/results/result_json.h"

#include <functional>

namespace viscard {

// Every object of --json begins with "schema" (the name of the schema that describes its keys),
// "version" (of viscard) and "inputs" (the files that were read, as the user named them).
struct JsonHead {
  const char* schema;  // "viscard-fit/1"
  Words inputs;
  bool accepts_implausible = false;  // "plausible": "off"
};

// The head as keys, of an object within another one.
void show_head(ResultVisitor& v, const JsonHead& head);

// "command" and "created_by" of a file that a command writes; an empty command: none.
void show_origin(ResultVisitor& v, const std::string& command);

// The object with its head in front.
nlohmann::ordered_json with_head(const JsonHead& head, const ShowKeys& show);

// Prints the object with its head on stdout. indent -1: in one line.
void print_result(const JsonHead& head, const ShowKeys& show, Streams& streams, int indent = 2);

// The same if --json was given; returns whether it was.
bool print_result(const CommandSyntax& syntax, const JsonHead& head, const ShowKeys& show,
                  Streams& streams);

// Runs a command. If it throws, --json is among its words, and no object has been printed, prints
// {"error": {"code", "message", "where", "hint"}} with schema and version as one line on stdout; the
// exception goes on in any case.
int with_json_errors(const Words& words, Streams& streams, const std::function<int()>& command);

}  // namespace viscard
