#include "io/cli/fit/fit_command.h"
#include "io/cli/words/command_line.h"

#include <utility>

namespace po = boost::program_options;

namespace viscard {

FitWords fit_words(const po::variables_map& values) {
  FitWords words;
  const std::pair<const char*, FitWords::Text*> texts[] = {
      {"kind", &words.kind},
      {"noise", &words.noise},
      {"model", &words.model},
      {"constraints", &words.constraints},
      {"vertical-shift", &words.vertical_shift},
      {"sheet", &words.sheet},
      {"time-zero", &words.time_zero},
      {"from", &words.from},
      {"to", &words.to},
      {"crop", &words.crop},
      {"depth", &words.depth},
      {"specimen", &words.specimen},
      {"punch-diameter", &words.punch_diameter},
      {"layer-thickness", &words.layer_thickness},
      {"frame-stiffness", &words.frame_stiffness},
      {"reference-temperature", &words.reference_temperature},
      {"density", &words.density}};
  for (const auto& [name, text] : texts) *text = given(values, name);
  const std::pair<const char*, bool*> flags[] = {{"liquid", &words.liquid},
                                                 {"solid", &words.solid},
                                                 {"allow-negative", &words.allow_negative},
                                                 {"drift", &words.drift},
                                                 {"no-drift", &words.no_drift},
                                                 {"full-data", &words.full_data},
                                                 {"profiles", &words.profiles},
                                                 {"diagnose", &words.diagnose},
                                                 {"joint", &words.joint},
                                                 {"own-terms", &words.own_terms}};
  for (const auto& [name, flag] : flags) *flag = values.count(name) > 0;
  const std::pair<const char*, Words*> lists[] = {
      {"fix", &words.fix},         {"bound", &words.bound}, {"column", &words.column},
      {"segment", &words.segment}, {"share", &words.share}, {"specimen-id", &words.specimen_id}};
  for (const auto& [name, list] : lists) *list = given<Words>(values, name).value_or(Words{});
  words.terms = given<int>(values, "terms");
  words.max_terms = given<int>(values, "max-terms");
  words.bootstrap = given<int>(values, "bootstrap");
  words.hold = given<int>(values, "hold");
  words.poisson_ratio = given<double>(values, "poisson-ratio");
  words.ratio = given<std::vector<double>>(values, "ratio").value_or(std::vector<double>{});
  return words;
}

}  // namespace viscard
