#include "io/serve/desk_api.h"

#include "io/basics/atomic_file.h"
#include "io/basics/option_quantity.h"
#include "io/basics/program.h"
#include "io/basics/temporary_folder.h"
#include "io/basics/words.h"
#include "io/flow/words/fit_words.h"
#include "io/flow/words/predict_words.h"
#include "io/materials/material_file.h"
#include "io/materials/material_json.h"
#include "io/serve/api_error.h"
#include "io/serve/desk_files.h"
#include "io/serve/desk_words.h"
#include "io/serve/series_json.h"
#include "io/tables/column_names.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
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
  static const Texts kNames{"ratio",          "extrapolate",  "density", "bulk-modulus",
                            "approximate",    "accept-flags", "terms",   "elastic-only",
                            "at-temperature", "bound",        "band",    "clamp-nu",
                            "plausible"};
  return kNames;
}

// Quantities among them, as card() of Python names them, which takes numbers in SI.
struct CardQuantity {
  const char *option, *unit, *keyword;
};
constexpr CardQuantity kCardQuantities[]{{"density", "kg/m3", "density_kg_m3"},
                                         {"bulk-modulus", "Pa", "bulk_modulus_Pa"},
                                         {"at-temperature", "degC", "temperature_C"}};

// What was chosen for a card that was written, as keywords of Python.
Json card_keywords(Json chosen) {
  for (const char* name : {"for", "units"}) chosen.erase(name);
  for (const auto& [option, unit, keyword] : kCardQuantities) {
    const std::string text = chosen.contains(option) ? text_at(chosen, option) : "";
    chosen.erase(option);
    if (!text.empty()) {
      chosen[keyword] = option_quantity(std::string("--") + option, text, QuantityOrUnit::any(unit),
                                        Plausible::kOff);
    }
  }
  return chosen;
}

// True if this file is the material that the command would write of tables with these sums. One that another
// version wrote, or that was edited since, may have other numbers.
bool is_material_of(const std::filesystem::path& path, const std::string& command,
                    const Texts& sha256) {
  try {
    const std::string text = read_file(path), name = path.string();
    const Provenance made = looks_like_ratio_file(path)
                                ? ratio_fit_from_json(text, name).common.provenance
                                : material_from_json(text, name).material.provenance;
    return made.created_by == program_with_version() && has_own_sum(text) &&
           made.command == command &&
           std::equal(
               made.raw_files.begin(), made.raw_files.end(), sha256.begin(), sha256.end(),
               [](const RawFile& file, const std::string& sum) { return file.sha256 == sum; });
  } catch (const std::exception&) {
    return false;  // another file
  }
}

// The names that a material of these tables may have.
std::string numbered(const std::string& stem, int n) {
  return stem + (n > 1 ? "." + std::to_string(n) : "") + ".json";
}

// A line that may be typed again and in another folder: the fit does not replace its material.
std::string unless_there(const std::string& name, const Texts& fit) {
  return quoted_for_shell({"test", "-e", word_of_file(name)}) + " || " + typed(fit);
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
  Json of_card = Json::array();
  const Json described_of_card = result_of({"card", "--help"}).at("options");
  for (const std::string& name : card_options_offered()) {
    const auto one = std::find_if(described_of_card.begin(), described_of_card.end(),
                                  [&](const Json& option) { return option.at("name") == name; });
    if (one != described_of_card.end()) of_card.push_back(*one);
  }
  return {
      {"targets", list.at("targets")}, {"units", list.at("units")},
      {"options", std::move(options)}, {"large_strain", large_strain_words()},
      {"quantities", column_names()},  {"predict", result_of({"predict", "--help"}).at("options")},
      {"card", std::move(of_card)},    {"examples", example_scenes()}};
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
  const TemporaryFolder scratch;
  const std::string picture = (scratch.path() / "stresses_over_stretch.svg").string();
  Json answer = answered(fit_words(tables), result_of(fit_words(tables, {"--svg=" + picture})));
  answer["pictures"] = pictures_in(scratch.path());
  return answer;
}

// The file of a law of rubber does not state its command, but the same fit gives the same bytes.
std::string DeskApi::write_law_of_rubber(const DeskTables& tables) {
  const TemporaryFolder scratch;
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
  answer["options"] = card_keywords(request.at("card"));
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
  for (const char* name : {"for", "units", "plausible"}) {
    if (request.contains(name)) add_value(name, request.at(name), words);
  }
  Json answer = answered(words, result_of(words, text_at(request, "card")));
  // As a person types it, with a file.
  words.front() = "card";
  words[1] = "--check=CARD";
  answer["command"] = typed(words);
  return answer;
}

void DeskApi::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closing_ = true;
  }
  one_has_ended_.notify_all();
}

}  // namespace viscard
