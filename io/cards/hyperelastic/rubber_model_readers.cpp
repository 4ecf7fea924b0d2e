// Cards of rubber that are a part of a model's text: FrontISTR, MOOSE and COMSOL; conventions and sources as in
// rubber_rows.cpp and rubber_models.cpp.
#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"
#include "io/cards/hyperelastic/rubber_readers.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/moose_blocks.h"
#include "io/cards/named_values.h"

#include <map>
#include <stdexcept>

namespace viscard {
namespace {

// A number with its unit in SI, of a stress or a density.
double comsol_number_SI(const Match& row, bool is_density, const CardLine& line) {
  const double value = card_number(row.group[2], line, row.group[1]);
  const std::string& unit = row.group[3];
  if (unit == "kPa" && !is_density) return 1e3 * value;
  for (const UnitSystem& system : unit_systems()) {
    if (comsol_unit(is_density ? system.density : system.stress) == unit)
      return from_card(value, is_density ? system.density_exponent : system.stress_exponent);
  }
  throw std::runtime_error(at_line(line, "unit [" + unit + "] is not known here"));
}

}  // namespace

RubberText read_moose_rubber(const std::string& commented) {
  const std::string text = without_line_comments(commented, "#");
  require_in_card(first_match(text, "type\\s*=\\s*ComputeNeoHookeanStress").has_value(),
                  "ComputeNeoHookeanStress");
  RubberText out;
  out.findings = moose_block_findings(text);
  const NamedNumbers named =
      named_lists(text, "\\b(lambda|mu|prop_values)\\s*=\\s*('[^'\\n]*'|\"[^\"\\n]*\"|[^\\s\\[]+)");
  const double mu = one_of(named, "mu");
  out.numbers.bulk = one_of(named, "lambda") + 2.0 * mu / 3.0;
  take_invariant_law({mu / 2.0}, out.numbers);
  if (first_match(text, "prop_names\\s*=\\s*['\"]?density"))
    out.numbers.density = one_of(named, "prop_values");
  if (all_matches(text, "large_kinematics\\s*=\\s*true").size() < 2) {
    out.findings.push_back({"small-kinematics",
                            "ComputeNeoHookeanStress or ComputeLagrangianStrain lacks "
                            "large_kinematics = true: MOOSE computes with small strain",
                            true});
  }
  return out;
}

RubberText read_comsol_rubber(const std::string& text) {
  RubberText out;
  out.has_own_units = true;
  std::map<std::string, double> found;
  const char* row = "^\\s*(\\w+)\\s+([-+.\\deE]+)\\[([^\\]]*)\\](?:\\s.*)?$";
  for (const CardLine& line : card_lines(text, "%")) {
    const auto match = first_match(line.text, row);
    if (!match && trimmed(line.text).empty()) continue;
    const auto not_read = [&] {
      add_unread_parts({at_line(line, "'" + std::string(trimmed(line.text)) + "'")}, out.findings);
    };
    if (!match) {
      not_read();
      continue;
    }
    const auto role = first_match(match->group[1], "^(?:.*_)?(mu|C10|C01|kappa|rho)$");
    if (!role) {
      not_read();
      continue;
    }
    const std::string& kind = role->group[1];
    if (!found.emplace(kind, comsol_number_SI(*match, kind == "rho", line)).second)
      throw std::runtime_error(at_line(line, kind + " stands in the card twice; keep one"));
  }
  const bool has_mu = found.contains("mu"), has_constants = found.contains("C10");
  require_in_card(has_mu != has_constants, "parameter ending in mu or in C10, or has both");
  take_invariant_law({has_mu ? found["mu"] / 2.0 : found["C10"], has_mu ? 0.0 : found["C01"]},
                     out.numbers);
  out.numbers.bulk = found["kappa"];
  out.numbers.density = found["rho"];
  return out;
}

RubberText read_frontistr_rubber(const std::string& text) {
  RubberText out;
  RubberNumbers& law = out.numbers;
  bool has_law = false;
  const std::vector<KeywordBlock> blocks = keyword_blocks(card_lines(text, "#"), '!');
  for (const KeywordBlock& block : blocks) {
    if (block.keyword == "!DENSITY") law.density = density_in(block);
    if (has_law && (block.keyword == "!VISCOELASTIC" || block.keyword == "!ELASTIC")) {
      out.findings.push_back(
          {"last-decides",
           at_line(block.line, block.keyword + " below !HYPERELASTIC replaces the law of rubber"),
           true});
    }
    if (block.keyword != "!HYPERELASTIC") continue;
    has_law = true;
    const bool is_boyce = block.has("TYPE=ARRUDA-BOYCE"), is_two = block.has("TYPE=MOONEY-RIVLIN");
    if (!is_boyce && !is_two && !block.has("TYPE=NEOHOOKE"))
      throw std::runtime_error(
          at_line(block.line, "only NEOHOOKE, MOONEY-RIVLIN and ARRUDA-BOYCE are read"));
    const CardLine& line = block.first_data();
    const auto row = cells(line.text, ',');
    const double first = cell_number(row, 0, line, "C10 or mu");
    const double second = is_boyce || is_two ? cell_number(row, 1, line, "C01 or s_m") : 0.0;
    const double D = cell_number(row, is_boyce || is_two ? 2 : 1, line, "D");
    law.form = is_boyce ? HyperelasticForm::kArrudaBoyce
               : is_two ? HyperelasticForm::kMooneyRivlin
                        : HyperelasticForm::kNeoHooke;
    law.moduli = is_two ? std::vector{first, second} : std::vector{first};
    if (is_boyce) law.shapes = {second};
    constexpr double kLeast = 1e-12;
    if (D > kLeast) {
      law.bulk = 2.0 / D;
    } else {
      out.findings.push_back(
          {"replaced-D", at_line(line, "FrontISTR takes a D up to 1e-12 for 1/D"), true});
    }
  }
  require_in_card(has_law, "!HYPERELASTIC");
  for (const CardFinding& finding : material_findings(blocks, false))
    out.findings.push_back(finding);
  return out;
}

}  // namespace viscard
