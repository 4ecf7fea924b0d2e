#include "io/basics/atomic_file.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/scene/sweep_program.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/cli/words/progress.h"
#include "io/flow/sweep/run_study.h"
#include "io/scenes/scene_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

CommandSyntax sweep_syntax(const SweepProgram& program) {
  CommandSyntax syntax{program.usage, program.description, program.example};
  auto add = syntax.options.add_options();
  add("out", po::value<std::string>(),
      "SQLite file of the points; default: the study's name with .sqlite, in this folder");
  add("csv", po::value<std::string>(), "write the points as a table, too");
  add("shard", po::value<std::string>(), "answer one part of the points only, such as 3/64");
  add("merge", po::value<std::vector<std::string>>()->composing(),
      "take over the points of another part (repeat it for several); nothing is answered then");
  add("force", "overwrite an existing table");
  if (program.add_options) program.add_options(syntax.options);
  syntax.may_exist = {"out"};
  syntax.positional = {"study"};
  return syntax;
}

const SweepProgram& on_all_cores() {
  static const SweepProgram kProgram{
      "viscard sweep STUDY.toml [OPTIONS]",
      "Answers a scene at many values of its parameters, on all cores: every combination of lists "
      "and ranges, or points of a Sobol' sequence. Each point is kept as it ends, so that a sweep "
      "that was stopped, also by kill -9, continues where it was. Parts of a sweep may run on "
      "other "
      "machines (--shard) and be merged; viscard-mpi answers one on many machines at once.",
      "viscard sweep data/studies/pillar.toml --out study.sqlite --csv study.csv", nullptr,
      [](const SweepJob& job) {
        return run_study(job.study, job.shard, job.store, job.progress,
                         given_plausible(job.values, Plausible::kScene));
      }};
  return kProgram;
}

std::string words_of(const StudyOutcome& outcome, const std::string& file, std::int64_t merged,
                     std::int64_t n_done) {
  std::string text = fmt::format("{}: {} of {} points are done", file, n_done, outcome.n_points);
  if (merged > 0) text += fmt::format(", {} taken over now", merged);
  if (outcome.n_answered > 0) text += fmt::format(", {} answered now", outcome.n_answered);
  if (outcome.n_failed > 0) {
    text += fmt::format("; {} of these have no answer (column failure says why)", outcome.n_failed);
  }
  return text + "\n";
}

}  // namespace

int run_sweep_command(const Words& words, Streams& streams) {
  return run_sweep_program(on_all_cores(), words, streams);
}

int run_sweep_program(const SweepProgram& program, const Words& words, Streams& streams) {
  CommandSyntax syntax = sweep_syntax(program);
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  const auto path = required(*values, "study", syntax);
  StudyShard shard;
  if (const auto text = given(*values, "shard")) {
    try {
      shard = shard_from(*text);
    } catch (const std::invalid_argument& error) {
      throw UsageError(error.what());
    }
  }
  const auto parts = given<std::vector<std::string>>(*values, "merge");
  if (parts && values->count("shard") > 0) {
    throw UsageError("--merge takes over points and answers none; leave --shard out");
  }
  if (const auto out = given(*values, "out")) refuse_folder_as_file("out", *out);
  const auto table = given(*values, "csv");
  if (table) refuse_existing(*table, values->count("force") > 0);
  const Study study = read_study(path);
  // A mistake in the study or its scene is reported here, not once for each point.
  check_values(study, given_plausible(*values, Plausible::kScene));
  const std::string file =
      given(*values, "out").value_or(std::filesystem::path(path).stem().string() + ".sqlite");
  StudyStore store(file, study);
  StudyOutcome outcome{.n_points = count_points(study)};
  std::int64_t merged = 0;
  if (parts) {
    for (const std::string& part : *parts) merged += store.merge(part, study);
  } else {
    Progress progress(streams, "sweep");
    outcome =
        program.run({study, shard, store, [&](double done) { progress.show(done, ""); }, *values});
  }
  if (table) write_file(*table, csv_from_study(store, study), values->count("force") > 0);
  const auto n_done = static_cast<std::int64_t>(store.done().size());
  const JsonHead head{"viscard-sweep/1", {path}};
  const nlohmann::json object{{"file", file},
                              {"points", outcome.n_points},
                              {"done", n_done},
                              {"answered", outcome.n_answered},
                              {"failed", outcome.n_failed},
                              {"merged", merged}};
  const int status =
      outcome.n_answered > 0 && outcome.n_failed == outcome.n_answered ? kFailed : kDone;
  if (print_json(*values, head, object, streams)) return status;
  FittedText text(streams);
  static_cast<std::ostream&>(text) << words_of(outcome, file, merged, n_done);
  return status;
}

}  // namespace viscard
