#include "io/basics/atomic_file.h"
#include "io/basics/data_folder.h"
#include "io/basics/temporary_folder.h"
#include "io/serve/api_error.h"
#include "io/serve/desk_api.h"
#include "io/serve/desk_files.h"
#include "io/serve/desk_words.h"
#include "io/serve/series_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace viscard {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

constexpr std::size_t kLongestScene_B = std::size_t{1} << 20;

}  // namespace

Json DeskApi::open_scene(const Json& request) {
  if (!request.contains("example")) {
    std::string name = text_at(request, "scene");
    folder_.require_scene(name);
    if (request.contains("text")) {
      const std::string text = text_at(request, "text");
      if (text.size() > kLongestScene_B) {
        throw ApiError(400, "bad-value", "a scene has at most 1 MiB of text");
      }
      const std::lock_guard<std::mutex> lock(writing_);
      name = folder_.keep_scene(name, text);
    }
    return {{"scene", name}, {"text", read_own_file(folder_.path() / name)}};
  }
  const std::string example = text_at(request, "example");
  const Json known = example_scenes();
  const bool is_known = std::any_of(known.begin(), known.end(),
                                    [&](const Json& one) { return one["name"] == example; });
  if (!is_known)
    throw ApiError(404, "no-such-file", "no example '" + example + "' comes with viscard");
  const std::filesystem::path data = data_folder();
  std::string text = read_own_file(data / "scenes" / example);
  // The files that it names stay where they are.
  const std::string up = "\"../", there = "\"" + data.string() + "/";
  for (std::size_t at = text.find(up); at != std::string::npos;
       at = text.find(up, at + there.size())) {
    text.replace(at, up.size(), there);
  }
  const std::lock_guard<std::mutex> lock(writing_);
  text = kSceneHead + (", of the example " + example) + "\n" + text;
  return {{"scene", folder_.keep_new(example, text)}, {"text", text}};
}

Json DeskApi::scene(const Json& request) {
  const std::string name = text_at(request, "scene"), what = text_at(request, "what");
  folder_.require_scene(name);
  Texts more;
  if (what != "drawing" && request.contains("tol")) add_value("tol", request.at("tol"), more);
  if (what == "plan") {
    const Texts words = command_words("plan", name, more);
    return answered(words, result_of(words));
  }
  if (what == "cost") {
    const Texts words = command_words("cost", name, {}, {"--budget=10s"});
    return answered(words, result_of(words));
  }
  const TemporaryFolder scratch;
  const std::string out = (scratch.path() / "out").string();
  Texts words = what == "drawing" ? Texts{"scene", "check", word_of_file(name)}
                                  : command_words("simulate", name, more);
  if (what != "drawing" && what != "answer") {
    throw ApiError(400, "bad-value", "'what' is drawing, plan, cost or answer");
  }
  const std::string shown = typed(words);
  words.push_back(what == "drawing" ? "--svg=" + out + ".svg" : "--out=" + out);
  Json answer{
      {"command", shown}, {"result", result_of(words)}, {"pictures", pictures_in(scratch.path())}};
  return answer;
}

}  // namespace viscard
