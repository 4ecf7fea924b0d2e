#include "io/cli/words/json_output.h"

#include "io/basics/inputs.h"
#include "io/basics/json_string.h"
#include "io/basics/program.h"
#include "io/basics/written_path.h"
#include "io/flow/command_error.h"

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
void print_line(const nlohmann::ordered_json& object, Streams& streams, int indent) {
  streams.out << printable_text_from_json(object, indent) << "\n";
  streams.has_printed_json = true;
}

}  // namespace

void show_head(ResultVisitor& v, const JsonHead& head) {
  v.word("schema", head.schema, {head.schema}, "name and version of the description");
  v("version", VISCARD_VERSION, "version of viscard");
  const WrittenValues written(head.inputs, "");
  std::vector<std::string> inputs;
  for (const std::string& input : head.inputs) inputs.push_back(written(input));
  v("inputs", inputs, "the files that were read, as they were named");
  v.when(head.accepts_implausible, [&] {
    v.word("plausible", "off", {"off"}, "that ranges of plausible values were switched off");
  });
}

void show_origin(ResultVisitor& v, const std::string& command) {
  v.when(!command.empty(), [&] {
    v("command", command, "in a file: the command line");
    v("created_by", program_with_version(), "in a file: version of viscard");
  });
}

namespace {

// Of this command. Schemas describe the key with the head (io/results/result_schema.cpp).
void show_input_files(ResultVisitor& v) {
  const std::vector<InputFile> files = provenance_of_inputs();
  v.when(!files.empty(), [&] {
    v.list("input_files", "every file that was read, also those that the inputs name", files,
           [&](const InputFile& file) {
             v("path", file.path, "its name");
             v("sha256", file.sha256, "the SHA-256 of what was read");
             v.when(!file.note.empty(), [&] {
               v("note", file.note, "what must be known of it, such as that it was edited");
             });
           });
  });
}

}  // namespace

nlohmann::ordered_json with_head(const JsonHead& head, const ShowKeys& show) {
  return json_from_keys([&](ResultVisitor& v) {
    show_head(v, head);
    show_input_files(v);
    show(v);
  });
}

void print_result(const JsonHead& head, const ShowKeys& show, Streams& streams, int indent) {
  const JsonHead of_command{head.schema, head.inputs,
                            head.accepts_implausible || streams.accepts_implausible};
  print_line(with_head(of_command, show), streams, indent);
}

bool print_result(const CommandSyntax& syntax, const JsonHead& head, const ShowKeys& show,
                  Streams& streams) {
  if (!syntax.as_json) return false;
  print_result(head, show, streams);
  return true;
}

int with_json_errors(const Words& words, Streams& streams, const std::function<int()>& command) {
  try {
    return command();
  } catch (const std::exception& error) {
    const bool is_asked = std::find(words.begin(), words.end(), "--json") != words.end();
    if (is_asked && !streams.has_printed_json) {
      const nlohmann::ordered_json json = {{"schema", "viscard-error/1"},
                                           {"version", VISCARD_VERSION},
                                           {"error", json_from_result(error_of(error))}};
      print_line(json, streams, -1);
    }
    throw;
  }
}

}  // namespace viscard
