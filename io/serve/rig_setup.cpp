#include "io/serve/rig_setup.h"

#include "io/basics/atomic_file.h"
#include "io/config/config_file.h"
#include "io/serve/api_error.h"
#include "io/serve/series_json.h"
#include "rig/emulator/demo_rig.h"
#include "rig/lines/port_probe.h"
#include "rig/open_devices.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace viscard {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// A name beside the file that nothing has.
fs::path free_name(const fs::path& file) {
  for (int n = 1;; ++n) {
    fs::path name = file.string() + "." + std::to_string(n);
    if (!fs::exists(fs::symlink_status(name))) return name;
  }
}

}  // namespace

Json RigSetup::text() const {
  const bool has_file = options_.rig_file.has_value();
  Json ports = Json::array();
  for (const std::string& path : present_ports()) ports.push_back(path);
  return {{"text", has_file ? read_file(*options_.rig_file) : toml_from_rig(demo_rig())},
          {"file", has_file ? *options_.rig_file : ""},
          {"is_kept", has_file},
          {"stage_drivers", stage_drivers()},
          {"load_cell_drivers", load_cell_drivers()},
          {"ports", ports}};
}

Json RigSetup::take(const Json& request) {
  constexpr std::size_t kLongest = 50'000;
  const std::string text = text_at(request, "text");
  if (text.size() > kLongest)
    throw ApiError(400, "bad-value", "a rig file has at most 50 kB of text");
  const fs::path file = options_.rig_file.value_or("rig.toml");
  const RigConfig rig = rig_of_text(text, file, judged_by(request));
  check_devices(rig);
  Json answer = {{"name", rig.name}, {"kept_before", ""}};
  if (!request.contains("keep")) return answer;
  if (!request.at("keep").is_boolean())
    throw ApiError(400, "bad-value", "'keep' must be true or false");
  if (!request.at("keep").get<bool>()) return answer;
  if (!options_.rig_file) {
    throw ApiError(422, "emulated",
                   "the page shows the rig of the demonstration; begin with viscard serve FOLDER "
                   "--rig FILE to keep one");
  }
  job_.begin("a change of the rig file");
  const JobEnd at_end(job_);
  const std::string before = read_file(file);
  if (before == text) return answer;
  if (request.contains("based_on") && text_at(request, "based_on") != before) {
    throw ApiError(
        409, "changed",
        file.string() +
            " was changed since the page showed it, and nothing is written; open the set-up "
            "again to see the text of now");
  }
  const fs::path kept = free_name(file);
  write_file(kept, before, false);
  rewrite_file(fs::canonical(file), text);  // a link goes on to name the file
  answer["kept_before"] = kept.filename().string();
  return answer;
}

}  // namespace viscard
