#include "io/cli/scene/command_scene.h"

#include "io/basics/atomic_file.h"
#include "io/cli/words/command_line.h"
#include "io/pictures/scene_picture.h"
#include "io/scenes/scene_file.h"
#include "models/scene/plan.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

CommandSyntax scene_syntax() {
  CommandSyntax syntax{
      "viscard scene check SCENE.toml [OPTIONS]",
      "Reads a scene, says with the line of the file what is missing or "
      "contradicts itself,\nand draws the geometry. Nothing is solved.",
      "viscard scene check data/scenes/pillar_sensor.toml --svg sensor.svg --force"};
  syntax.options.add_options()("svg", po::value<std::string>(), "file for the drawing")(
      "force", "overwrite an existing file");
  syntax.positional = {"what", "scene"};
  return syntax;
}

}  // namespace

int run_scene(const std::vector<std::string>& words, Streams& streams) {
  CommandSyntax syntax = scene_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  if (values->count("what") == 0 || (*values)["what"].as<std::string>() != "check" ||
      values->count("scene") == 0) {
    throw UsageError(std::string("usage: ") + syntax.usage);
  }
  const auto path = (*values)["scene"].as<std::string>();
  const Scene scene = read_scene(path).scene;
  try {
    checked_plan(scene);  // reading finds neither effects that cannot be off nor buckling
  } catch (const SceneMistake& mistake) {
    throw std::runtime_error(told_with_line(path, mistake));
  }
  const std::string name = std::filesystem::path(path).filename().string();
  const std::string drawing = svg_from_scene(scene, name);
  if (values->count("svg") > 0) {
    write_file((*values)["svg"].as<std::string>(), drawing, values->count("force") > 0);
  }
  if (values->count("json") > 0) {
    streams.out << nlohmann::json({{"scene", path}, {"kind", kind_of(scene)}, {"ok", true}}).dump(2)
                << "\n";
  } else {
    streams.out << path << ": nothing contradicts itself\n";
  }
  return kDone;
}

}  // namespace viscard
