#include "io/cli/report/demo_record.h"

#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/basics/program.h"
#include "io/basics/sha256.h"

#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
namespace viscard {

DemoRecord::DemoRecord(const fs::path& folder) : file_(folder / "demo.record.json") {
  if (!fs::exists(file_)) return;
  const nlohmann::json json = json_or_discarded(read_own_file(file_));
  if (!json.is_object() || !json.contains("made") || !json["made"].is_object()) return;
  for (const auto& [name, made] : json["made"].items()) {
    if (!made.is_object()) continue;
    made_[name] = {made.value("from", nlohmann::json()).is_string() ? made["from"] : "",
                   made.value("sha256", nlohmann::json()).is_string() ? made["sha256"] : ""};
  }
}

bool DemoRecord::is_up_to_date(const fs::path& result, const std::string& made_from) const {
  const auto found = made_.find(result.filename().string());
  return found != made_.end() && found->second.from == made_from && fs::is_regular_file(result) &&
         sha256_of_file(result) == found->second.sha256;
}

bool DemoRecord::knows(const fs::path& result) const {
  return made_.count(result.filename().string()) > 0;
}

void DemoRecord::begin(const fs::path& result) {
  made_[result.filename().string()] = {};
  write();
}

void DemoRecord::finish(const fs::path& result, const std::string& made_from) {
  made_[result.filename().string()] = {made_from, sha256_of_file(result)};
  write();
}

void DemoRecord::write() const {
  nlohmann::ordered_json json{{"schema", "viscard-demo-record/1"},
                              {"created_by", program_with_version()},
                              {"made", nlohmann::ordered_json::object()}};
  for (const auto& [name, made] : made_)
    json["made"][name] = {{"from", made.from}, {"sha256", made.sha256}};
  write_file(file_, printable_text_from_json(json, 2) + "\n", true);
}

std::string sum_of_inputs(const std::vector<fs::path>& inputs, const std::string& settings) {
  // The file of the program is long; a build writes it anew.
  const auto built = fs::last_write_time("/proc/self/exe").time_since_epoch().count();
  std::string all = program_with_version() + " " + std::to_string(built) + " " + settings;
  for (const fs::path& input : inputs) all += "\n" + sha256_of_file(input);
  return sha256_of_text(all);
}

}  // namespace viscard
