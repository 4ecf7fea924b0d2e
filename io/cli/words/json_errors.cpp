#include "io/cli/words/json_errors.h"

#include "io/flow/command_error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <ostream>

namespace viscard {
namespace {

CommandError error_of(const std::exception& error) {
  const bool is_usage = dynamic_cast<const UsageError*>(&error) != nullptr;
  return is_usage ? command_error("usage", error.what()) : command_error(error);
}

}  // namespace

int with_json_errors(const Words& words, Streams& streams, const std::function<int()>& command) {
  try {
    return command();
  } catch (const std::exception& error) {
    if (std::find(words.begin(), words.end(), "--json") != words.end()) {
      const nlohmann::ordered_json json = {{"error", json_from_error(error_of(error))}};
      // Messages may quote bytes of a file that are not UTF-8.
      streams.out << json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
                  << "\n";
    }
    throw;
  }
}

}  // namespace viscard
