#include "io/serve/desk_api.h"

#include "io/basics/atomic_file.h"
#include "io/basics/data_folder.h"
#include "io/basics/program.h"
#include "io/basics/words.h"
#include "io/basics/words_file.h"
#include "io/flow/words/fit_words.h"
#include "io/flow/words/predict_words.h"
#include "io/materials/material_file.h"
#include "io/serve/api_error.h"
#include "io/serve/desk_words.h"
#include "io/serve/series_json.h"
#include "io/tables/column_names.h"

#include <nlohmann/json.hpp>
#include <stdlib.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <exception>
#include <functional>
#include <optional>
#include <utility>

namespace viscard {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

constexpr int kMostRunning = 3;  // commands at once; a further one waits

// Options of card that the page may set.
const Texts& card_options_offered() {
  static const Texts kNames{"approximate",  "accept-flags",   "clamp-nu",     "bound",
                            "elastic-only", "terms",          "band",         "ratio",
                            "extrapolate",  "at-temperature", "bulk-modulus", "density"};
  return kNames;
}

Json answered(const Texts& words, Json result) {
  return {{"command", typed(words)}, {"result", std::move(result)}};
}

// True if this file is the material that the command would write of tables with these sums.
bool is_material_of(const std::filesystem::path& path, const std::string& command,
                    const Texts& sha256) {
  try {
    const Provenance made = looks_like_ratio_file(path) ? read_ratio_fit(path).common.provenance
                                                        : read_material(path).material.provenance;
    return made.command == command &&
           std::equal(
               made.raw_files.begin(), made.raw_files.end(), sha256.begin(), sha256.end(),
               [](const RawFile& file, const std::string& sum) { return file.sha256 == sum; });
  } catch (const std::exception&) {
    return false;  // another file
  }
}

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

constexpr std::size_t kLongestScene_B = std::size_t{1} << 20;

// Name and first line of the scenes that come with viscard.
Json example_scenes() {
  Json examples = Json::array();
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(data_folder() / "scenes", error), end;
       !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".toml") files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    const std::string text = read_own_file(file);
    const std::string first = text.substr(0, text.find('\n'));
    examples.push_back({{"name", file.filename().string()},
                        {"what", first.substr(std::min<std::size_t>(2, first.size()))}});
  }
  return examples;
}

// The names that a material of these tables may have.
std::string numbered(const std::string& stem, int n) {
  return stem + (n > 1 ? "." + std::to_string(n) : "") + ".json";
}

// A line that may be typed again and in another folder: the fit does not replace its material.
std::string unless_there(const std::string& name, const Texts& fit) {
  return quoted_for_shell({"test", "-e", word_of_file(name)}) + " || " + typed(fit);
}

// A folder of a command's outputs, for one request.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "viscard-desk-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error(name + ": cannot create a folder: " + std::strerror(errno));
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// The pictures below a folder, by name, as many as a page can show.
Json pictures_in(const std::filesystem::path& folder) {
  constexpr std::size_t kMost = 12, kLargest_B = std::size_t{4} << 20;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".svg" && entry.file_size() <= kLargest_B)
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  Json pictures = Json::array();
  for (const std::filesystem::path& file : files) {
    if (pictures.size() == kMost) break;
    pictures.push_back({{"name", file.stem().string()}, {"svg", read_own_file(file)}});
  }
  return pictures;
}

}  // namespace

DeskApi::DeskApi(DeskOptions options) : options_(std::move(options)), folder_(options_.folder) {}

Json DeskApi::state() const {
  Json tables = Json::array();
  for (const DeskTable& table : folder_.tables()) {
    tables.push_back(
        {{"name", table.name}, {"bytes", table.bytes}, {"is_capture", table.is_capture}});
  }
  const bool is_full = tables.size() == kMostDeskFiles;
  return {{"program", program_with_version()},
          {"folder", folder_.path().string()},
          {"folder_trouble", folder_.trouble()},
          {"largest_drop_B", kLargestDrop_B},
          {"tables", std::move(tables)},
          {"scenes", folder_.scenes()},
          {"are_more", is_full}};
}

Json DeskApi::result_of(const Texts& words, const std::string& input) {
  {
    std::unique_lock<std::mutex> lock(mutex_);
    one_has_ended_.wait(lock, [&] { return is_closing_ || n_running_ < kMostRunning; });
    if (is_closing_) throw ApiError(409, "closing", "viscard desk is ending; start it again");
    ++n_running_;
  }
  ChildEnd end;
  std::exception_ptr failure;
  Texts all = words;
  all.emplace_back("--json");
  try {
    end = run_child(options_.program, all, folder_.path(), options_.limits, is_closing_, input);
  } catch (...) {
    failure = std::current_exception();
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    --n_running_;
  }
  one_has_ended_.notify_all();
  if (failure) std::rethrow_exception(failure);
  if (!end.trouble.empty()) {
    throw ApiError(422, "ended",
                   typed(words) + " " + end.trouble +
                       ". The desk goes on; try a part of the table, or the command");
  }
  Json result = Json::parse(end.out, nullptr, false);
  if (!result.is_object()) {
    throw ApiError(422, "failed",
                   typed(words) + " gave no result (exit status " + std::to_string(end.status) +
                       "): " + end.err.substr(0, 500));
  }
  if (!result.contains("error")) return result;
  const Json& error = result.at("error");
  std::string text = error.value("message", "");
  const std::string hint = error.value("hint", "");
  // A hint that goes on in the sentence stays in it, so that it is found again.
  const bool goes_on = !hint.empty() && std::isupper(static_cast<unsigned char>(hint[0])) == 0;
  if (!hint.empty()) text += (goes_on ? "; " : ". ") + hint;
  throw ApiError(422, error.value("code", "failed"), text);
}

Json DeskApi::choices() {
  const Json list = result_of({"card", "--list"});
  Json options = Json::array();
  FitWords unused;
  const OptionList offered = options_of(unused);
  const Json described = result_of({"fit", "--help"});
  for (const Json& option : described.at("options")) {
    const Option* one = offered.find(option.at("name").get<std::string>());
    if (one != nullptr && is_offered_by_desk(*one)) options.push_back(option);
    if (option.at("name") != "kind") continue;
    for (const std::string& kind : large_strain_words()) options.back()["choices"].push_back(kind);
  }
  return {
      {"targets", list.at("targets")}, {"units", list.at("units")},
      {"options", std::move(options)}, {"large_strain", large_strain_words()},
      {"quantities", column_names()},  {"predict", result_of({"predict", "--help"}).at("options")},
      {"examples", example_scenes()}};
}

Json DeskApi::drop(const std::string& name, const std::string& bytes) {
  const std::lock_guard<std::mutex> lock(writing_);
  return {{"name", folder_.drop(name, bytes)}};
}

Json DeskApi::table(const Json& request) {
  const DeskTables tables = tables_of(request, folder_);
  if (tables.names.size() > 1) throw ApiError(400, "bad-value", "one table is shown");
  if (request.contains("options")) {
    const std::lock_guard<std::mutex> lock(writing_);
    folder_.keep_words(tables.names.front(), words_to_keep(tables));
  }
  Texts of_reading = tables.options;
  if (tables.is_rubber) {  // how a law is fitted does not belong to the table
    std::erase_if(of_reading, [](const std::string& word) {
      return word.starts_with("--model=") || word.starts_with("--youngs-modulus=");
    });
  }
  const Texts words = command_words("fit", tables.names.front(), of_reading, {"--show-table"});
  Json answer = answered(words, Json());
  answer["options"] = chosen_options(tables);
  try {
    Json result = result_of(words);
    if (tables.is_rubber) {  // what the columns alone do not show
      result["kind"] = answer["options"]["kind"];
      result["kind_trouble"] = "";
    }
    answer["result"] = std::move(result);
  } catch (const ApiError&
               error) {  // the page shows the options in any case, so that they can be changed
    answer["trouble"] = error.what();
  }
  return answer;
}

Json DeskApi::fit(const Json& request) {
  const DeskTables tables = tables_of(request, folder_);
  // Tests that are fitted together have their curves with them.
  const bool has_curves = tables.names.size() == 1 && !tables.is_rubber;
  Json answer =
      tables.is_rubber
          ? fit_of_rubber(tables)
          : answered(fit_words(tables),
                     result_of(fit_words(tables, has_curves ? Texts{"--curves"} : Texts{})));
  answer["options"] = chosen_options(tables);
  return answer;
}

Json DeskApi::fit_of_rubber(const DeskTables& tables) {
  const ScratchFolder scratch;
  const std::string picture = (scratch.path() / "stresses_over_stretch.svg").string();
  Json answer = answered(fit_words(tables), result_of(fit_words(tables, {"--svg=" + picture})));
  answer["pictures"] = pictures_in(scratch.path());
  return answer;
}

// The file of a law of rubber does not state its command, but the same fit gives the same bytes.
std::string DeskApi::write_law_of_rubber(const DeskTables& tables) {
  const ScratchFolder scratch;
  const std::filesystem::path law = scratch.path() / "law.json";
  result_of(fit_words(tables, {"--out=" + law.string()}));
  const std::string text = read_own_file(law);
  for (int n = 1;; ++n) {
    const std::string name = numbered(tables.stem, n);
    const std::filesystem::path path = folder_.path() / name;
    if (!std::filesystem::exists(std::filesystem::symlink_status(path))) {
      write_file(path, text, false);
      return name;
    }
    if (std::filesystem::is_regular_file(path) && read_own_file(path) == text) return name;
  }
}

DeskApi::WrittenMaterial DeskApi::write_material(const Json& request) {
  const DeskTables tables = tables_of(request, folder_);
  const std::lock_guard<std::mutex> lock(writing_);
  if (tables.is_rubber) {
    const std::string name = write_law_of_rubber(tables);
    return {name, unless_there(name, fit_words(tables, {"--out=" + name}))};
  }
  Texts sums;
  for (const std::string& table : tables.names)
    sums.push_back(sha256_of_file(folder_.path() / table));
  for (int n = 1;; ++n) {
    const std::string name = numbered(tables.stem, n);
    const Texts words = fit_words(tables, {"--out=" + name});
    const std::filesystem::path path = folder_.path() / name;
    if (std::filesystem::exists(std::filesystem::symlink_status(path))) {
      if (!is_material_of(path, typed(words), sums)) continue;
    } else {
      result_of(words);
    }
    return {name, unless_there(name, words)};
  }
}

Json DeskApi::card(const Json& request) {
  if (!request.contains("card")) throw ApiError(400, "bad-value", "the request needs 'card'");
  const Texts of_card = words_of(request, "card", [](const std::string& name) {
    const Texts& more = card_options_offered();
    return name == "for" || name == "units" ||
           std::find(more.begin(), more.end(), name) != more.end();
  });
  const WrittenMaterial material = write_material(request);
  const Texts words = command_words("card", material.name, of_card);
  Json answer = answered(words, result_of(words));
  answer["material"] = material.name;
  answer["fit_command"] = material.command;
  return answer;
}

Json DeskApi::predict(const Json& request) {
  PredictWords unused;
  const OptionList list = options_of(unused);
  Texts of_test = words_of(request, "predict", [&](const std::string& name) {
    const Option* option = list.find(name);
    return option != nullptr && !option->is_file;
  });
  const DeskTables tables = tables_of(request, folder_);
  if (tables.is_joint) {
    throw ApiError(422, "several-materials",
                   "a fit by mixing ratio is of several materials, and a prediction is of one; fit "
                   "the specimens of one ratio together to predict by them");
  }
  if (tables.is_rubber) {
    throw ApiError(422, "law-of-rubber",
                   "a law of rubber gives cards, and no predictions; the picture of its fit shows "
                   "what it does in the tests that were made");
  }
  Json notes = Json::array();
  if (request.contains("against")) {
    const std::string against = text_at(request, "against");
    folder_.require_table(against);
    of_test.push_back("--against=" + against);
    // The other table is read as the page shows it, as far as predict can.
    for (const std::string& word : reading_words(against, folder_)) {
      if (list.find(word.substr(2, word.find('=') - 2)) != nullptr) {
        of_test.push_back(word);
      } else {
        notes.push_back(against + " is read here without " + word +
                        ", which a prediction does not take");
      }
    }
  }
  const WrittenMaterial material = write_material(request);
  const Texts words = command_words("predict", material.name, of_test);
  Json answer = answered(words, result_of(words));
  answer["options"] = options_of_words(of_test, list);
  answer["notes"] = std::move(notes);
  answer["material"] = material.name;
  answer["fit_command"] = material.command;
  return answer;
}

Json DeskApi::check(const Json& request) {
  Texts words{"card", "--check=/dev/stdin"};
  for (const char* name : {"for", "units"}) {
    if (request.contains(name)) add_value(name, request.at(name), words);
  }
  Json answer = answered(words, result_of(words, text_at(request, "card")));
  // As a person types it, with a file.
  words.front() = "card";
  words[1] = "--check=CARD";
  answer["command"] = typed(words);
  return answer;
}

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
  const ScratchFolder scratch;
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
  const ScratchFolder scratch;
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

void DeskApi::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closing_ = true;
  }
  one_has_ended_.notify_all();
}

}  // namespace viscard
