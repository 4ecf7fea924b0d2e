#include "io/cli/scene/design_judge.h"

#include "io/basics/atomic_file.h"
#include "io/basics/data_folder.h"
#include "io/basics/file_kind.h"
#include "io/basics/json_string.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/design/judge_scene.h"
#include "io/flow/design/judgement_output.h"

#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

Judgement judgement_of(const DesignWords& words, const Requirements& requirements,
                       Streams& streams) {
  const std::string& scene = *words.scene;
  Progress progress(streams, "design");
  const WordsOnSignal words_on_signal(
      "the design was stopped; nothing is written. --search-time ends the search for remedies "
      "earlier");
  JudgeOptions options;
  options.tolerance = words.tolerance;
  options.search_s = words.search_s;
  if (options.search_s < 0.0) throw UsageError("--search-time must not be negative, such as 60s");
  options.progress = [&](double done, const std::string& what) { progress.announce(done, what); };
  try {
    std::string text = read_file(scene);
    if (words.judged == Plausible::kOff) text = "plausible = \"off\"\n" + text;
    return judge_scene(text, scene, requirements, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

DescribedResult result_of_judgement() {
  const auto show = [](ResultVisitor& v) {
    show_keys(v, Judgement{});
    show_origin(v, "");
  };
  return {"design-judge",
          "viscard design SCENE --require FILE; judgement.json has command and created_by besides",
          {show}};
}

int run_design_judge(const DesignWords& asked, const CommandSyntax& syntax, const Words& words,
                     Streams& streams) {
  const std::optional<std::string>&scene = asked.scene, &require = asked.require;
  if (!scene) throw UsageError("--require judges a scene; name its file, such as SCENE.toml");
  if (!require) {
    refuse_other_kind(read_file(*scene), *scene, FileKind::kScene);
    throw UsageError(
        "'" + *scene + "'" +
        example_with_data(" is judged by what is required; add --require FILE, such as "
                          "data/requirements/human_hand.toml"));
  }
  const Requirements requirements = read_requirements(*require);
  const Judgement judgement = judgement_of(asked, requirements, streams);
  const JsonHead head{"viscard-design-judge/1", {*scene, *require}};
  const auto show = [&](const std::string& command) {
    return [&judgement, command](ResultVisitor& v) {
      show_keys(v, judgement);
      show_origin(v, command);
    };
  };
  if (asked.out) {
    const auto stored = with_head(head, show(quoted_command_line("design", words)));
    std::filesystem::create_directories(*asked.out);
    write_file(std::filesystem::path(*asked.out) / "judgement.json",
               text_from_json(stored, 2) + "\n", asked.overwrite);
  }
  if (!print_result(syntax, head, show(""), streams)) {
    streams.out << *scene << "\n" << text_from_judgement(judgement);
  }
  return judgement.passes() ? kDone : kFailed;
}

}  // namespace viscard
