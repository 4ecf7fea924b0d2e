#include "io/basics/atomic_file.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/json_output.h"
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
      "Reads a scene, says with the line of the file what is missing or contradicts itself, and "
      "draws the geometry. Nothing is solved.",
      "viscard scene check data/scenes/pillar_sensor.toml --svg sensor.svg --force"};
  syntax.options.add_options()("svg", po::value<std::string>(), "file for the drawing")(
      "force", "overwrite an existing file");
  syntax.positional = {"what", "scene"};
  syntax.choices["what"] = {"check"};
  return syntax;
}

}  // namespace

int run_scene(const Words& words, Streams& streams) {
  CommandSyntax syntax = scene_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  if (given(*values, "what") != "check" || values->count("scene") == 0) {
    throw UsageError(std::string("usage: ") + syntax.usage);
  }
  const auto path = required(*values, "scene", syntax);
  const SceneFile file = read_scene(path, given_plausible(*values, Plausible::kScene));
  streams.accepts_implausible |= file.accepts_implausible;
  const Scene scene = file.scene;
  // Reading finds neither effects that cannot be off nor buckling.
  with_lines_of(path, [&] { return checked_plan(scene); });
  const std::string name = std::filesystem::path(path).filename().string();
  const std::string drawing = svg_from_scene(scene, name);
  if (const auto svg = given(*values, "svg")) write_file(*svg, drawing, values->count("force") > 0);
  const nlohmann::json object{{"scene", path}, {"kind", kind_of(scene)}, {"ok", true}};
  if (!print_json(*values, {"viscard-scene/1", {path}}, object, streams)) {
    streams.out << path << ": nothing contradicts itself\n";
  }
  return kDone;
}

}  // namespace viscard
