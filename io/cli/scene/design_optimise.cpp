#include "io/cli/scene/design_optimise.h"

#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/basics/option_use.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/optimise/optimised_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

// One scene for each design, and the picture of a front.
void write_designs(const DesignSpec& spec, const DesignFront& front,
                   const nlohmann::ordered_json& object, const std::filesystem::path& folder,
                   bool overwrite) {
  std::filesystem::create_directories(folder);
  write_file(folder / "design.json", text_from_json(object, 2) + "\n", overwrite);
  write_file(folder / "designs.csv", csv_from_front(spec, front), overwrite);
  for (std::size_t i = 0; i < front.designs.size(); ++i) {
    const std::string name =
        front.designs.size() == 1 ? "scene.toml" : fmt::format("scene_{}.toml", i + 1);
    write_file(folder / name, scene_for_folder(spec, front.designs[i], folder), overwrite);
  }
  if (front.designs.size() < 2) return;
  write_file(folder / "front.svg", svg_from_plot(picture_of_front(spec, front), "front") + "\n",
             overwrite);
}

}  // namespace

DescribedResult result_of_front() {
  const auto show = [](ResultVisitor& v) {
    show_front(v, DesignSpec{}, DesignFront{});
    show_origin(v, "");
  };
  return {"design-front",
          "viscard design SPEC; design.json has command and created_by besides",
          {show}};
}

int run_design_optimise(const DesignWords& asked, const CommandSyntax& syntax, const Words& words,
                        Streams& streams) {
  const std::string& path = *asked.scene;
  const std::string of_judgement =
      "a scene that --require judges, and " + path + " is a specification";
  refuse_idle<UsageError>(
      {{"--tol", asked.tolerance.has_value(), false, of_judgement},
       {"--search-time", is_given(syntax, "search-time"), false, of_judgement}});
  const DesignSpec spec = read_design_spec(path);
  DesignFront front;
  {
    Progress progress(streams, "design");
    const WordsOnSignal words_on_signal(
        "the design was stopped; nothing is written. Fewer ranges and choices or a smaller front "
        "in " +
        path + ", or a larger tolerance in its scene, end earlier");
    front = design_front(
        spec, [&](double done, const std::string& what) { progress.announce(done, what); });
  }
  const JsonHead head{"viscard-design-front/1", {path}};
  const auto show = [&](const std::string& command) {
    return [&spec, &front, command](ResultVisitor& v) {
      show_front(v, spec, front);
      show_origin(v, command);
    };
  };
  if (asked.out) {
    const auto stored = with_head(head, show(quoted_command_line("design", words)));
    write_designs(spec, front, stored, *asked.out, asked.overwrite);
  }
  if (!print_result(syntax, head, show(""), streams)) {
    streams.out << path << "\n" << text_from_front(spec, front);
  }
  return front.designs[0].is_feasible ? kDone : kFailed;
}

}  // namespace viscard
