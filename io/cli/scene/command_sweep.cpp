#include "io/basics/atomic_file.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/scene/sweep_program.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/scenes/answer_scene.h"
#include "io/flow/sweep/run_study.h"
#include "io/scenes/scene_file.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

void show_sweep(ResultVisitor& v, const StudyOutcome& outcome, const std::string& file,
                std::int64_t merged, std::int64_t n_done, const std::vector<std::string>& notes) {
  v("answered", outcome.n_answered, "points of this run");
  v("done", n_done, "points in the file");
  v("failed", outcome.n_failed,
    "points that failed for memory, disk or an error of the program; they have no answer");
  v("file", file, "the SQLite file of the points");
  v("merged", merged, "points taken over from other files");
  v("notes", notes, "such as a material that was edited since it was written");
  v("points", outcome.n_points, "of the whole study");
  v("refused", outcome.n_refused, "of those answered, points outside the model");
}

// The options of a command that sweeps.
struct SweepWords {
  std::string study;
  std::optional<std::string> out, csv, shard;
  std::vector<std::string> merge;
  bool overwrite = false, accepts_unrecorded = false, retries_failed = false;
};

CommandSyntax sweep_syntax(const SweepProgram& program, SweepWords& words) {
  CommandSyntax syntax{program.usage, program.description, program.example};
  syntax.positional.add("study", &words.study, "study file");
  OptionList& options = syntax.options;
  options.add("out", &words.out,
              "SQLite file of the points; default: the study's name with .sqlite, in this folder");
  options.add("csv", &words.csv, "write the points as a table, too");
  options.add("shard", &words.shard, "answer one part of the points only, such as 3/64");
  options.add("merge", &words.merge,
              "take over the points of another part (repeat it for several); nothing is answered "
              "then");
  options.add("retry-failed", &words.retries_failed,
              "answer points again that failed by an error of the program");
  options.add(
      "accept-unrecorded", &words.accepts_unrecorded,
      "go on with a file of an earlier version, which does not state the materials that its "
      "points were answered with");
  options.add("force", &words.overwrite, "overwrite an existing table").only_with({"csv", "out"});
  if (program.add_options) program.add_options(options);
  syntax.may_exist = {"out"};
  syntax.results = {{"sweep", "viscard sweep", {[](ResultVisitor& v) {
                       show_sweep(v, StudyOutcome{}, "", 0, 0, {});
                     }}}};
  return syntax;
}

const SweepProgram& on_all_cores() {
  static const SweepProgram kProgram{
      "viscard sweep STUDY.toml [OPTIONS]",
      "Answers a scene at many values of its parameters, on all cores: every combination of lists "
      "and ranges, or points of a Sobol' sequence. Each point is kept as it ends, so that a sweep "
      "that was stopped, also by kill -9, continues where it was. Parts of a sweep may run on "
      "other machines (--shard) and be merged; viscard-mpi answers one on many machines at once.",
      "viscard sweep data/studies/pillar.toml --out study.sqlite --csv study.csv", nullptr,
      [](const SweepJob& job) {
        return run_study(job.study, job.shard, job.store, job.progress, job.judged);
      }};
  return kProgram;
}

std::string words_of(const StudyOutcome& outcome, const std::string& file, std::int64_t merged,
                     std::int64_t n_done) {
  std::string text = fmt::format("{}: {} of {} points are done", file, n_done, outcome.n_points);
  if (merged > 0) text += fmt::format(", {} taken over now", merged);
  if (outcome.n_answered > 0) text += fmt::format(", {} answered now", outcome.n_answered);
  return text + "\n";
}

// What the scene of the first point has to state of its materials.
std::string note_of_first_point(const Study& study, Plausible judged) {
  try {
    const std::string text = scene_text_with(study, values_at(study, 0));
    return note_of_edited(scene_from_toml(text, study.scene_path, {}, judged).scene);
  } catch (const std::runtime_error&) {
    return "";  // its point states why
  }
}

// What a user must know beside the count of points.
void print_doubts(const StudyOutcome& outcome, StudyStore& store, const std::string& file,
                  Streams& streams) {
  const auto say = [&](const std::string& text) { streams.err << "viscard: " << text << "\n"; };
  if (!store.has_recorded_inputs()) {
    say(file + ": inputs not recorded: some points may have been answered with other files");
  }
  if (store.n_damaged() > 0) {
    say(
        fmt::format("{}: {} damaged or of another study; their points were removed or left out, "
                    "and are answered again "
                    "by the same command",
                    file, counted(store.n_damaged(), "row")));
  }
  const std::int64_t n_all_refused = store.count(PointKind::kRefused);
  if (n_all_refused > outcome.n_refused) {
    say(fmt::format("{} points of the file are refused in all: they lie outside the model",
                    n_all_refused));
  }
  if (outcome.n_refused > 0) {
    say(fmt::format(
        "{} of the {} points answered now {} refused: they lie outside the model (column "
        "failure states why)",
        outcome.n_refused, outcome.n_answered, outcome.n_refused == 1 ? "is" : "are"));
  }
  if (outcome.n_failed > 0) {
    say(fmt::format(
        "{} points failed and have no answer: {}. The same command tries those again "
        "that failed for memory, disk or a file that changed; add --retry-failed for the others",
        outcome.n_failed, outcome.first_failure));
  } else if (const std::int64_t before = store.count(PointKind::kError); before > 0) {
    say(
        fmt::format("{} points have no answer because the program failed on them; --retry-failed "
                    "answers them again",
                    before));
  }
}

}  // namespace

int run_sweep_command(const Words& words, Streams& streams) {
  return run_sweep_program(on_all_cores(), words, streams);
}

int run_sweep_program(const SweepProgram& program, const Words& words, Streams& streams) {
  SweepWords asked;
  CommandSyntax syntax = sweep_syntax(program, asked);
  if (!parse_words(syntax, words, streams)) return kDone;
  const std::string& path = asked.study;
  StudyShard shard;
  if (asked.shard) {
    try {
      shard = shard_from(*asked.shard);
    } catch (const std::invalid_argument& error) {
      throw UsageError(error.what());
    }
  }
  if (!asked.merge.empty() && asked.shard) {
    throw UsageError("--merge takes over points and answers none; leave --shard out");
  }
  if (asked.out) refuse_folder_as_file("out", *asked.out);
  if (asked.csv) {
    refuse_existing(*asked.csv, asked.overwrite);
    refuse_existing(*asked.csv + ".inputs.json", asked.overwrite);
  }
  const Plausible judged = given_plausible(syntax, Plausible::kScene);
  const Study study = read_study(path);
  if (asked.csv) refuse_input(*asked.csv);  // before hours of work
  // A mistake in the study or its scene is reported here, not once for each point.
  check_values(study, judged);
  const std::string edited = note_of_first_point(study, judged);
  const std::string file =
      asked.out.value_or(std::filesystem::path(path).stem().string() + ".sqlite");
  const bool answers = asked.merge.empty();
  StoreOptions how{.accepts_unrecorded = asked.accepts_unrecorded,
                   .retries_failed = asked.retries_failed,
                   .is_answering = answers};
  how.on_gone = [&streams](const std::string& why) { streams.err << "viscard: " + why + "\n"; };
  for (const std::string& part : asked.merge) check_study_store(part, study, how);
  StudyStore store(file, study, how);
  StudyOutcome outcome{.n_points = count_points(study)};
  std::int64_t merged = 0;
  if (!asked.merge.empty()) {
    for (const std::string& part : asked.merge) merged += store.merge(part, study, how);
  } else {
    Progress progress(streams, "sweep");
    const WordsOnSignal words_on_signal(
        "the sweep was stopped; the points that were answered are in " + file +
        ", and the same command goes on with the others");
    outcome =
        program.run({study, shard, store, [&](double done) { progress.show(done, ""); }, judged});
  }
  if (asked.csv) {
    const std::string table = csv_from_study(store, study);
    write_file(*asked.csv + ".inputs.json",
               json_from_inputs(study.inputs, store.has_recorded_inputs(), table,
                                judged == Plausible::kOff),
               asked.overwrite);
    write_file(*asked.csv, table, asked.overwrite);
  }
  const auto n_done = static_cast<std::int64_t>(store.done().size());
  const JsonHead head{"viscard-sweep/1", {path}};
  const std::vector<std::string> notes = edited.empty() ? Words{} : Words{edited};
  const auto show = [&](ResultVisitor& v) { show_sweep(v, outcome, file, merged, n_done, notes); };
  const bool is_all_refused = outcome.n_answered > 0 && outcome.n_refused == outcome.n_answered;
  const int status = outcome.n_failed > 0 || is_all_refused ? kFailed : kDone;
  print_doubts(outcome, store, file, streams);
  if (print_result(syntax, head, show, streams)) return status;
  FittedText text(streams);
  static_cast<std::ostream&>(text) << words_of(outcome, file, merged, n_done);
  return status;
}

}  // namespace viscard
