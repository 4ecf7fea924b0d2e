#include "io/basics/atomic_file.h"
#include "io/basics/temporary_folder.h"
#include "io/basics/words.h"
#include "io/basics/words_file.h"
#include "io/serve/api_error.h"
#include "io/serve/desk_api.h"
#include "io/serve/desk_words.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace viscard {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

// Words for every page of this folder, one a line: --logo=logo.svg.
constexpr const char* kReportOptions = "report.options";

Texts report_options(const std::filesystem::path& file) {
  return std::filesystem::exists(file) ? words_of_file(file) : Texts{};
}

// Options of report that viscard.report() of Python has too.
struct ReportPythonWords {
  std::optional<std::string> title, logo, units, plausible;
  std::vector<std::string> card;
  bool reproducible = false;
};

OptionList options_of(ReportPythonWords& words) {
  OptionList list;
  list.add("title", &words.title, "");
  list.add("logo", &words.logo, "");
  list.add("units", &words.units, "");
  list.add("card", &words.card, "");
  list.add("plausible", &words.plausible, "");
  list.add("reproducible", &words.reproducible, "");
  return list;
}

}  // namespace

Json DeskApi::report(const Json& request) {
  if (!request.contains("tables") || !request.at("tables").is_array() ||
      request.at("tables").empty()) {
    throw ApiError(400, "bad-value", "the report needs tables; choose at least one");
  }
  Texts files;
  Json notes = Json::array();
  for (const Json& one : request.at("tables")) {
    if (!one.is_string()) throw ApiError(400, "bad-value", "'tables' are names of files");
    const auto table = one.get<std::string>();
    const Json of_table{{"table", table}};
    const DeskTables kept = tables_of(of_table, folder_);
    const bool is_fitted_alike =
        !kept.is_rubber &&
        std::all_of(kept.options.begin(), kept.options.end(),
                    [](const std::string& word) { return word.starts_with("--density="); });
    if (is_fitted_alike) files.push_back(word_of_file(table));
    if (is_fitted_alike && kept.options.empty()) continue;
    const std::string material = write_material(of_table).name;
    files.push_back(word_of_file(material));
    if (is_fitted_alike) continue;
    notes.push_back(table + " is shown by " + material + ", which was fitted with " +
                    quoted_for_shell(words_to_keep(kept)) +
                    ", without its data and residuals: viscard report takes no options of a fit");
  }
  // A title that is typed on the page stands for that of the file.
  const bool has_title = request.contains("title");
  Texts options;
  for (const std::string& word : report_options(folder_.path() / kReportOptions)) {
    if (!has_title || !word.starts_with("--title=")) options.push_back(word);
  }
  if (has_title) add_value("title", request.at("title"), options);
  Texts words{"report"};
  for (const Texts* part : {&files, &options})
    words.insert(words.end(), part->begin(), part->end());
  const TemporaryFolder scratch;
  const std::filesystem::path page = scratch.path() / "report.html";
  const std::string shown = typed(words);
  words.push_back("--out=" + page.string());
  const Json result = result_of(words);
  const std::string html = read_own_file(page);
  const std::lock_guard<std::mutex> lock(writing_);
  const std::string name = folder_.keep_new("report.html", html);
  // The command and Python would not replace it.
  const std::string next = folder_.free_name("report.html");
  ReportPythonWords unused;
  return {{"command", shown + " --out " + next},
          {"result", result},
          {"name", name},
          {"html", html},
          {"next_name", next},
          {"files", files},
          {"options", options_of_words(options, options_of(unused))},
          {"notes", std::move(notes)}};
}

}  // namespace viscard
