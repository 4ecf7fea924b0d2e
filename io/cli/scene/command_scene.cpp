#include "io/basics/atomic_file.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/json_output.h"
#include "io/pictures/scene_picture.h"
#include "io/scenes/scene_file.h"
#include "models/scene/plan.h"

#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

void show_check(ResultVisitor& v, const std::string& path, const std::string& kind) {
  v("kind", kind, "of the analysis");
  v("ok", true, "true; a mistake is an error");
  v("scene", path, "the file");
}

}  // namespace

int run_scene(const Words& words, Streams& streams) {
  std::string what, path;
  std::optional<std::string> svg;
  bool overwrite = false;
  CommandSyntax syntax{
      "viscard scene check SCENE.toml [OPTIONS]",
      "Reads a scene, reports with the line of the file what is missing or contradicts itself, and "
      "draws the geometry. Nothing is solved.",
      "viscard scene check data/scenes/pillar_sensor.toml --svg sensor.svg --force"};
  syntax.positional.add("what", &what, "what to do").among({"check"});
  syntax.positional.add("scene", &path, "scene file");
  syntax.options.add("svg", &svg, "file for the drawing");
  syntax.options.add("force", &overwrite, "overwrite an existing file").only_with({"svg"});
  syntax.results = {
      {"scene", "viscard scene check", {[](ResultVisitor& v) { show_check(v, "", ""); }}}};
  if (!parse_words(syntax, words, streams)) return kDone;
  if (svg && std::filesystem::path(*svg).extension() != ".svg") {
    throw UsageError("--svg " + *svg + ": the drawing is an SVG file, so end its name with .svg");
  }
  const SceneFile file = read_scene(path, given_plausible(syntax, Plausible::kScene));
  streams.accepts_implausible |= file.accepts_implausible;
  const Scene scene = file.scene;
  // Reading finds neither effects that cannot be off nor buckling.
  with_lines_of(path, [&] { return checked_plan(scene); });
  const std::string name = std::filesystem::path(path).filename().string();
  const std::string drawing = svg_from_scene(scene, name);
  if (svg) write_file(*svg, drawing, overwrite);
  const auto show = [&](ResultVisitor& v) { show_check(v, path, kind_of(scene)); };
  if (!print_result(syntax, {"viscard-scene/1", {path}}, show, streams)) {
    streams.out << path << ": nothing contradicts itself\n";
  }
  return kDone;
}

}  // namespace viscard
