#include "io/flow/command_error.h"

#include "models/maths/failure_text.h"
#include "models/maths/result_visitor.h"
#include "models/quantities/plausible.h"
#include "rig/lines/rig_error.h"
#include "rig/run/run_control.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <vector>

namespace viscard {
namespace {

// Place of the hint: after the first sentence, or after the last semicolon.
std::size_t begin_of_hint(const std::string& text) {
  for (std::size_t i = text.find(". "); i != std::string::npos; i = text.find(". ", i + 1)) {
    if (i + 2 < text.size() && std::isupper(static_cast<unsigned char>(text[i + 2])) != 0) return i;
  }
  return text.rfind("; ");
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    const std::size_t first = word.find_first_not_of("'\"(");
    const std::size_t last = word.find_last_not_of("'\",;:.)");
    if (first != std::string::npos && last != std::string::npos && last >= first) {
      words.push_back(word.substr(first, last - first + 1));
    }
  }
  return words;
}

// "rig.toml:10": a file with its line.
bool is_line_of_file(const std::string& word) {
  const std::size_t colon = word.rfind(':');
  return colon != std::string::npos && colon > 0 && colon + 1 < word.size() &&
         word.find_first_not_of("0123456789", colon + 1) == std::string::npos;
}
bool is_option_name(const std::string& word) {
  return word.size() > 2 && word.starts_with("--") && word != "--help";
}
bool is_port_name(const std::string& word) {
  return word.rfind("/dev/", 0) == 0;
}
// "[stage]", not "[OPTIONS]" of a usage.
bool is_section_name(const std::string& word) {
  return word.size() > 2 && word.front() == '[' && word.back() == ']' &&
         std::isupper(static_cast<unsigned char>(word[1])) == 0;
}
bool is_file_name(const std::string& word) {
  const std::size_t dot = word.rfind('.');
  return word.find('/') != std::string::npos ||
         (dot != std::string::npos && dot > 0 && dot + 1 < word.size() &&
          std::isalpha(static_cast<unsigned char>(word[dot + 1])) != 0);
}

// The place that the text names: the file at its beginning, or else the first place of the most
// specific kind.
std::string place_in(const std::string& text) {
  const std::vector<std::string> words = words_of(text);
  if (words.empty()) return "";
  if (is_line_of_file(words.front()) || is_file_name(words.front())) return words.front();
  for (const auto is_place : {is_port_name, is_option_name, is_section_name}) {
    const auto found = std::find_if(words.begin(), words.end(), is_place);
    if (found != words.end()) return *found;
  }
  return "";
}

std::string code_of_text(const std::string& text) {
  const std::vector<std::string> words = words_of(text);
  if (!words.empty() && is_line_of_file(words.front())) return "input";
  return text.find("exists already") != std::string::npos ? "exists" : "failed";
}

template <typename Type>
bool is_of(const std::exception& error) {
  return dynamic_cast<const Type*>(&error) != nullptr;
}

std::string code_of(const std::exception& error) {
  if (const auto* coded = dynamic_cast<const CodedError*>(&error)) return coded->code();
  if (is_of<PortHungUp>(error)) return "device-lost";
  if (is_of<DeviceRestarted>(error)) return "device-restarted";
  if (is_of<PortUnavailable>(error)) return "port";
  if (is_of<RunInterrupted>(error)) return "interrupted";
  if (is_of<RigError>(error)) return "device";
  if (is_of<std::filesystem::filesystem_error>(error)) return "file";
  if (is_of<std::invalid_argument>(error) || is_of<BadNumber>(error)) return "input";
  return code_of_text(error.what());
}

}  // namespace

CommandError command_error(const std::string& code, const std::string& whole_text,
                           const std::string& where) {
  const std::string text = shortened(whole_text);
  CommandError error{code, text, where, ""};
  const std::size_t cut = begin_of_hint(text);
  if (cut != std::string::npos) {
    error.message = text.substr(0, cut);
    error.hint = text.substr(cut + 2);
  }
  // Programs look for the port there, and people read in which line of the rig file it stands.
  if (where.empty() && code == "port") {
    for (const std::string& word : words_of(error.message)) {
      if (error.where.empty() && is_port_name(word)) error.where = word;
    }
  }
  // An option that a hint recommends counts as the place only if the message names no other place.
  if (error.where.empty()) error.where = place_in(error.message);
  if (error.where.empty()) error.where = place_in(error.hint);
  return error;
}

CommandError command_error(const std::exception& error) {
  const auto* of_file = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  if (of_file != nullptr) {
    return {"file", of_file->code().message(), of_file->path1().string(), "choose another place"};
  }
  return command_error(code_of(error), failure_text(error, "this command"));
}

void show_keys(ResultVisitor& v, const CommandError& error) {
  v.word("code", error.code,
         {"usage",       "input",        "exists",        "file",        "preflight",
          "calibration", "port",         "device",        "device-lost", "device-restarted",
          "stage-alarm", "readings-old", "computer-late", "force-limit", "pressing",
          "interrupted", "records-lost", "unfit",         "damaged",     "failed"},
         "kind of failure; the words stay the same");
  v("message", error.message, "what happened, with the value and its limit");
  v("where", error.where,
    "a file with its line, an option, a port or the phase of a run; may be empty");
  v("hint", error.hint, "what to do next; may be empty");
}

}  // namespace viscard
