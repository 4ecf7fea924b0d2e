#include "io/serve/desk_words.h"

#include "io/basics/words.h"
#include "io/flow/test_words.h"
#include "io/flow/words/fit_words.h"
#include "io/serve/api_error.h"
#include "io/serve/series_json.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace viscard {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

constexpr std::size_t kLongestValue = 200;
constexpr std::size_t kMostTests = 12;
constexpr std::size_t kLongestStem = 60;
const std::string kKind = "--kind=";

Texts fit_words_of(const Json& request) {
  FitWords unused;
  const OptionList list = options_of(unused);
  return words_of(request, "options", [&](const std::string& name) {
    const Option* option = list.find(name);
    return option != nullptr && is_offered_by_desk(*option);
  });
}

bool is_large_strain(const std::string& kind) {
  const auto kinds = large_strain_kinds();
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](const LargeStrainKind& one) { return one.word == kind; });
}

bool is_same_test(const LargeStrainKind& a, const LargeStrainKind& b) {
  return a.foam_test == b.foam_test && a.is_compression == b.is_compression;
}

// "uniaxial" of "uniaxial=a.csv" and "tension=a.csv", the first of the words for it; of all others
// nothing.
std::string large_strain_kind_of(const std::string& word) {
  const std::string kind = word.substr(0, word.find('='));
  if (kind == word) return "";
  const auto kinds = large_strain_kinds();
  const auto known = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const LargeStrainKind& one) { return one.word == kind; });
  if (known == kinds.end()) return "";
  return std::find_if(kinds.begin(), kinds.end(),
                      [&](const LargeStrainKind& one) { return is_same_test(one, *known); })
      ->word;
}

// {"kind": "uniaxial", "terms": "3"}: what the page may set of these words of fit; others are left out.
Json fit_options_of(const Texts& words) {
  FitWords unused;
  const OptionList list = options_of(unused);
  Texts offered;
  for (const std::string& word : words) {
    const std::string kind = large_strain_kind_of(word);
    if (!kind.empty()) {
      offered.push_back(kKind + kind);
    } else if (word.starts_with("--")) {
      const Option* option = list.find(word.substr(2, word.find('=') - 2));
      if (option != nullptr && is_offered_by_desk(*option)) offered.push_back(word);
    }
  }
  return options_of_words(offered, list);
}

Texts kept_options(const std::string& table, const DeskFolder& folder) {
  return fit_words_of({{"options", fit_options_of(folder.kept_words(table))}});
}

std::string stem_of(const std::string& table) {
  return std::filesystem::path(table).stem().string();
}

void add_test(const Json& test, const DeskFolder& folder, DeskTables& out) {
  if (!test.is_object()) throw ApiError(400, "bad-value", "a test is {\"table\", \"kind\"}");
  const std::string name = text_at(test, "table");
  folder.require_table(name);
  out.names.push_back(name);
  const std::string stem = out.stem.empty() ? stem_of(name) : out.stem + "+" + stem_of(name);
  out.stem = stem.substr(0, kLongestStem);
  if (test.contains("ratio")) {
    out.words.push_back(word_of_file(name));
    return;
  }
  const std::string kind = text_at(test, "kind");
  const bool is_word = !kind.empty() && std::all_of(kind.begin(), kind.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || c == '-';
  });
  if (!is_word) throw ApiError(400, "bad-value", "'" + kind + "' is no kind of test");
  out.words.push_back(kind + "=" + name);
}

// Specimens of several mixing ratios, or tests of one material.
void add_tests(const Json& tests, const DeskFolder& folder, DeskTables& out) {
  const auto has_ratio = [](const Json& test) {
    return test.is_object() && test.contains("ratio");
  };
  const auto n_ratios = std::count_if(tests.begin(), tests.end(), has_ratio);
  if (n_ratios != 0 && static_cast<std::size_t>(n_ratios) != tests.size()) {
    throw ApiError(400, "bad-value", "either each test has a mixing ratio, or none");
  }
  out.is_joint = n_ratios > 0;
  if (out.is_joint) out.words.emplace_back("--joint");
  for (const Json& test : tests) add_test(test, folder, out);
  if (!out.is_joint) return;
  for (const Json& test : tests) {
    if (text_at(test, "ratio").empty()) {
      throw ApiError(400, "bad-value", text_at(test, "table") + " needs a mixing ratio");
    }
    add_value("ratio", test.at("ratio"), out.words);
  }
}

bool has(const Texts& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// A word that states how a table is read.
bool is_of_reading(const std::string& word) {
  static const Texts kNames{
      "--column=", "--table=", "--sheet=", "--skip=", "--modulus-kind=", "--time-zero="};
  return std::any_of(kNames.begin(), kNames.end(),
                     [&](const std::string& name) { return word.starts_with(name); });
}

// Such a word that only one of them has; empty if there is none.
std::string read_otherwise(const Texts& one, const Texts& other) {
  const auto differing = std::find_if(one.begin(), one.end(), [&](const std::string& word) {
    return is_of_reading(word) && !has(other, word);
  });
  return differing == one.end() ? "" : *differing;
}

// Tests that are fitted together have one set of options: those that all share. They must be read alike.
void take_kept_options(const DeskFolder& folder, DeskTables& out) {
  const Texts first = kept_options(out.names.front(), folder);
  out.options = first;
  for (const std::string& name : out.names) {
    const Texts own = kept_options(name, folder);
    std::string differing = read_otherwise(own, first);
    if (differing.empty()) differing = read_otherwise(first, own);
    if (!differing.empty()) {
      throw ApiError(422, "different-options",
                     out.names.front() + " and " + name + " are not read alike (" + differing +
                         "), and tests that are fitted together are; choose the same for both, or "
                         "fit them one by one");
    }
    std::erase_if(out.options, [&](const std::string& word) { return !has(own, word); });
  }
}

// Each of several tests has its kind before it. That of one table is an option, or, at large strain, stands before it.
void put_kind_before_file(bool are_tests, DeskTables& out) {
  const auto kind = std::find_if(out.options.begin(), out.options.end(),
                                 [](const std::string& word) { return word.starts_with(kKind); });
  if (kind == out.options.end() || out.is_joint) return;
  const std::string name = kind->substr(kKind.size());
  if (!are_tests && !is_large_strain(name)) return;
  if (!are_tests) out.words = {name + "=" + out.names.front()};
  out.options.erase(kind);
}

}  // namespace

std::vector<std::string> large_strain_words() {
  Texts words;
  const LargeStrainKind* last = nullptr;
  for (const LargeStrainKind& one : large_strain_kinds()) {
    // Another word for the one before it is left out: tension, oedometer ...
    if (last == nullptr || !is_same_test(*last, one)) words.emplace_back(one.word);
    last = &one;
  }
  return words;
}

bool is_offered_by_desk(const Option& option) {
  static const Texts kOfSeveral{"joint", "own-terms", "specimen-id", "share", "ratio"};
  return !option.is_file &&
         std::find(kOfSeveral.begin(), kOfSeveral.end(), option.name) == kOfSeveral.end();
}

void add_value(const std::string& name, const Json& value, Texts& words) {
  if (!value.is_string()) {
    throw ApiError(400, "bad-value", "'" + name + "' must be a text, or true for a switch");
  }
  const auto text = value.get<std::string>();
  const bool has_control = std::any_of(text.begin(), text.end(),
                                       [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (text.size() > kLongestValue || has_control) {
    throw ApiError(400, "bad-value", "the value of '" + name + "' is no value of an option");
  }
  if (!text.empty()) words.push_back("--" + name + "=" + text);
}

Texts words_of(const Json& request, const char* key,
               const std::function<bool(const std::string&)>& may_set) {
  Texts words;
  if (!request.contains(key)) return words;
  const Json& options = request.at(key);
  if (!options.is_object()) {
    throw ApiError(400, "bad-value", std::string("'") + key + "' must be an object");
  }
  for (const auto& [name, value] : options.items()) {
    if (!may_set(name)) {
      throw ApiError(400, "bad-value", "the page cannot set the option '" + name + "'");
    }
    if (value.is_boolean()) {
      if (value.get<bool>()) words.push_back("--" + name);
    } else if (value.is_array()) {
      for (const Json& one : value) add_value(name, one, words);
    } else {
      add_value(name, value, words);
    }
  }
  return words;
}

Json options_of_words(const Texts& words, const OptionList& list) {
  Json options = Json::object();
  for (const std::string& word : words) {
    const std::size_t sign = word.find('=');
    const std::string name = word.starts_with("--") ? word.substr(2, sign - 2) : "";
    const Option* option = list.find(name);
    if (option == nullptr) continue;
    if (is_switch(*option)) {
      options[name] = true;
    } else if (sign == std::string::npos) {
      continue;
    } else if (is_list(*option)) {
      options[name].push_back(word.substr(sign + 1));
    } else {
      options[name] = word.substr(sign + 1);
    }
  }
  return options;
}

DeskTables tables_of(const Json& request, const DeskFolder& folder) {
  DeskTables out;
  if (request.contains("tests")) {
    const Json& tests = request.at("tests");
    if (!tests.is_array() || tests.empty() || tests.size() > kMostTests) {
      throw ApiError(400, "bad-value",
                     "'tests' are one to " + std::to_string(kMostTests) +
                         " of one material, or specimens of several mixing ratios");
    }
    add_tests(tests, folder, out);
  } else {
    const std::string name = text_at(request, "table");
    folder.require_table(name);
    out = {{name}, {word_of_file(name)}, {}, stem_of(name)};
  }
  if (request.contains("options")) {
    out.options = fit_words_of(request);
  } else {
    take_kept_options(folder, out);
  }
  put_kind_before_file(request.contains("tests"), out);
  out.is_rubber = std::any_of(out.words.begin(), out.words.end(), [](const std::string& word) {
    return !large_strain_kind_of(word).empty();
  });
  return out;
}

Json chosen_options(const DeskTables& tables) {
  return fit_options_of(words_to_keep(tables));
}

Texts words_to_keep(const DeskTables& tables) {
  Texts words;
  if (tables.is_rubber && tables.names.size() == 1) words = tables.words;
  words.insert(words.end(), tables.options.begin(), tables.options.end());
  return words;
}

Texts reading_words(const std::string& table, const DeskFolder& folder) {
  Texts words = kept_options(table, folder);
  std::erase_if(words, [](const std::string& word) { return !is_of_reading(word); });
  return words;
}

Texts fit_words(const DeskTables& tables, const Texts& more) {
  Texts words{"fit"};
  for (const Texts* part : {&tables.words, &tables.options, &more})
    words.insert(words.end(), part->begin(), part->end());
  return words;
}

std::string word_of_file(const std::string& name) {
  // "-x" would be an option, "@x" a file of options, "kind=x" a kind of test.
  const bool is_plain =
      name.front() != '-' && name.front() != '@' && name.find('=') == std::string::npos;
  return is_plain ? name : "./" + name;
}

Texts command_words(const char* command, const std::string& file, const Texts& options,
                    const Texts& more) {
  Texts words{command, word_of_file(file)};
  words.insert(words.end(), options.begin(), options.end());
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string typed(const Texts& words) {
  Texts all{"viscard"};
  all.insert(all.end(), words.begin(), words.end());
  return quoted_for_shell(all);
}

Json answered(const Texts& words, Json result) {
  return {{"command", typed(words)}, {"result", std::move(result)}};
}

}  // namespace viscard
