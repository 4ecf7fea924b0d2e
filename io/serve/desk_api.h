#pragma once

#include "io/serve/child_command.h"
#include "io/serve/desk_folder.h"

#include <nlohmann/json_fwd.hpp>

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace viscard {

struct DeskTables;

struct DeskOptions {
  std::filesystem::path folder;
  int port = 0;  // 0: any free one
  // The program whose commands answer. It is this one even after an upgrade has replaced its file.
  std::string program = "/proc/self/exe";
  ChildLimits limits;
};

// The requests of the desk, as functions from JSON to JSON. Each carries out a command of viscard
// in a process of its own, in the folder, and answers {"command", "result"}: what a person would type, and
// its --json object. All state is files of the folder. Functions throw ApiError, or std::exception with a message
// for a person. Any thread may call them.
class DeskApi {
 public:
  using Json = nlohmann::ordered_json;

  explicit DeskApi(DeskOptions options);

  Json state() const;
  // What the page offers: the options of fit, predict and card, kinds of test at large strain, and the targets and units
  // of cards.
  Json choices();
  Json drop(const std::string& name, const std::string& bytes);
  // {"table", "options"}: viscard fit --show-table, and keeps the options beside the table. Without "options" those that
  // are kept hold; the answer names them.
  Json table(const Json& request);
  // {"table", "options"}: viscard fit, with the curves; of tests at large strain with "pictures", {"name", "svg"}. In the
  // place of "table", here and below, "tests" of one material: [{"table", "kind"}, ...].
  Json fit(const Json& request);
  // {"table", "options", "card"}: writes the material of the fit beside the table, under a name that is free or that of
  // the same fit, and then viscard card. "fit_command" writes the material where it is missing. "options": what was chosen
  // as card() of Python takes it, quantities in SI.
  Json card(const Json& request);
  // {"table", "options", "predict", "against": a table}: likewise, and then viscard predict. "options" of the answer: those
  // of the command, with what is kept beside the other table; "notes": what predict cannot take of it.
  Json predict(const Json& request);
  // {"card", "for", "units", "plausible"}: viscard card --check of this text.
  Json check(const Json& request);

  // {"example"}: writes a copy of a scene that comes with viscard into the folder. {"scene"}: one of the folder. {"scene",
  // "text"}: keeps the text. Each answers {"scene": its name, "text"}.
  Json open_scene(const Json& request);
  // {"scene", "what", "tol"}: what is "drawing", "plan", "cost" or "answer". A drawing and an answer have "pictures", {"name",
  // "svg"}.
  Json scene(const Json& request);
  // {"tables": [...], "title"}: viscard report into a file of the folder; answers its "name" and "html". A table with
  // options is shown by its material. "notes": what the page therefore lacks; "files" and "options": what
  // viscard.report() of Python takes; "next_name": a free one, for the command.
  Json report(const Json& request);

  // Ends the commands that are running; no further one begins.
  void close();

 private:
  // The object that a command prints. Throws ApiError 422 if it prints none or one of an error.
  Json result_of(const std::vector<std::string>& words, const std::string& input = "");
  struct WrittenMaterial {
    std::string name, command;
  };
  // Of the fit that the request describes; the command does nothing where the material is there.
  WrittenMaterial write_material(const Json& request);
  std::string write_law_of_rubber(const DeskTables& tables);
  // The pictures of a fit at large strain, whose readings are not in its object.
  Json fit_of_rubber(const DeskTables& tables);

  DeskOptions options_;
  DeskFolder folder_;
  std::atomic<bool> is_closing_{false};
  std::mutex mutex_;  // of n_running_
  std::condition_variable one_has_ended_;
  int n_running_ = 0;
  std::mutex writing_;  // one file after the other, so that no two take one name
};

}  // namespace viscard
