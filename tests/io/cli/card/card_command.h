#pragma once

#include "io/basics/atomic_file.h"
#include "io/cli/card/card_words.h"
#include "io/materials/material_file.h"

#include <unistd.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace viscard::test {

// A folder that goes with the test, and the command run in it.
class CardCommand {
 public:
  CardCommand()
      : folder_(std::filesystem::temp_directory_path() /
                ("viscard-card-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~CardCommand() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  CardCommand(const CardCommand&) = delete;
  CardCommand& operator=(const CardCommand&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string save(const Material& material, const std::string& name = "m.json") const {
    write_file(path(name), json_from_material(material), true);
    return path(name);
  }
  int run(const std::vector<std::string>& words) {
    std::ostringstream printed, messages;
    Streams streams{printed, messages};
    int status = kDone;
    try {
      status = run_card(words, streams);
    } catch (const UsageError& error) {
      messages << error.what();
      status = kBadWords;
    } catch (const std::exception& error) {
      messages << error.what();
      status = kFailed;
    }
    out = printed.str();
    err = messages.str();
    return status;
  }

  std::string out, err;

 private:
  std::filesystem::path folder_;
};

}  // namespace viscard::test
