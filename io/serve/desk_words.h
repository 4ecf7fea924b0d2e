#pragma once

#include "io/options/option.h"
#include "io/serve/desk_folder.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// Requests of the desk as words of command lines. Functions throw ApiError 400 for a value that is none.

// The options of fit that the page may set: those that neither read another file nor belong to mixing ratios, which stand
// beside each table.
bool is_offered_by_desk(const Option& option);
// Kinds of test at large strain: uniaxial, compression ... In a request they are values of "kind" as all others; on a
// command line they stand before the file (uniaxial=a.csv).
std::vector<std::string> large_strain_words();

// Adds --name=value; value: a text, of which an empty one sets nothing.
void add_value(const std::string& name, const nlohmann::ordered_json& value,
               std::vector<std::string>& words);
// {"terms": "3", "liquid": true, "column": ["a=b"]} below the key.
std::vector<std::string> words_of(const nlohmann::ordered_json& request, const char* key,
                                  const std::function<bool(const std::string&)>& may_set);
// {"terms": "3"} of the words --terms=3 of a command with these options.
nlohmann::ordered_json options_of_words(const std::vector<std::string>& words,
                                        const OptionList& list);

// What a request fits: {"table": NAME}; or {"tests": [{"table": NAME, "kind": "creep"}, ...]}, tests of one material;
// or {"tests": [{"table": NAME, "ratio": "10"}, ...]}, specimens of several mixing ratios.
struct DeskTables {
  std::vector<std::string> names;  // files of the folder
  std::vector<std::string> words;  // as fit takes them
  std::vector<std::string>
      options;       // of fit: those of the request, else those that are kept beside the tables
  std::string stem;  // of the names of files that are made of them
  bool is_joint = false;   // over mixing ratios
  bool is_rubber = false;  // tests at large strain
};
// Throws ApiError 404 for a file that is not there, 422 for tests that keep different options.
DeskTables tables_of(const nlohmann::ordered_json& request, const DeskFolder& folder);
// What is chosen for them, as the page has it.
nlohmann::ordered_json chosen_options(const DeskTables& tables);
// The words of a command line that stand for what is chosen for one table.
std::vector<std::string> words_to_keep(const DeskTables& tables);
// The words that are kept beside a table and state how it is read.
std::vector<std::string> reading_words(const std::string& table, const DeskFolder& folder);

// viscard fit of these.
std::vector<std::string> fit_words(const DeskTables& tables,
                                   const std::vector<std::string>& more = {});
// A name that no command takes for an option, or for KIND=FILE.
std::string word_of_file(const std::string& name);
std::vector<std::string> command_words(const char* command, const std::string& file,
                                       const std::vector<std::string>& options,
                                       const std::vector<std::string>& more = {});
// As a person types it in the folder.
std::string typed(const std::vector<std::string>& words);
// {"command": as typed, "result"}.
nlohmann::ordered_json answered(const std::vector<std::string>& words,
                                nlohmann::ordered_json result);

}  // namespace viscard
