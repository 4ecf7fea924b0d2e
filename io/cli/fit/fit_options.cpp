#include "io/cli/fit/fit_command.h"
#include "io/cli/words/command_line.h"

namespace po = boost::program_options;

namespace viscard {

void take_options(const po::variables_map& values, const OptionFields& fields) {
  for (const auto& [name, text] : fields.texts) *text = given(values, name);
  for (const auto& [name, flag] : fields.flags) *flag = values.count(name) > 0;
  for (const auto& [name, list] : fields.lists) {
    *list = given<Words>(values, name).value_or(Words{});
  }
  for (const auto& [name, number] : fields.whole_numbers) *number = given<int>(values, name);
}

FitWords fit_words(const po::variables_map& values) {
  FitWords words;
  take_options(values, option_fields(words));
  words.poisson_ratio = given<double>(values, "poisson-ratio");
  words.ratio = given<std::vector<double>>(values, "ratio").value_or(std::vector<double>{});
  return words;
}

}  // namespace viscard
