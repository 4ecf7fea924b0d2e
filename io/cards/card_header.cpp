#include "io/cards/card_header.h"

#include "io/basics/program.h"
#include "io/basics/written_path.h"
#include "io/cards/card_sum.h"
#include "io/cards/header_name.h"

#include <fmt/format.h>

#include <cctype>
#include <set>

namespace viscard {
namespace {

std::string ascii(const std::string& text) {
  std::string out;
  for (const char c : text) out += (c >= ' ' && c <= '~') ? c : '?';
  return out;
}

std::string interval_text(const Interval& interval) {
  return fmt::format("[{:.6g}, {:.6g}]", interval.low, interval.high);
}

void add_moduli(std::vector<std::string>& lines, const Material& material, const UnitSystem& units,
                bool has_density) {
  const DerivedModuli moduli = derived_moduli(material);
  const auto in_units = [&](double value_Pa) {
    return fmt::format("{:.10g} {}", to_card(value_Pa, units.stress_exponent), units.stress);
  };
  lines.push_back("E0 (instantaneous) = " + in_units(moduli.E0_Pa) +
                  ", E_inf (long-term) = " + in_units(moduli.E_inf_Pa));
  lines.push_back("K0 = " + (material.nu < 0.5 ? in_units(moduli.K0_Pa) : "infinite") +
                  fmt::format(" from nu = {} ({})", material.nu, material.provenance.nu_origin));
  if (has_density && material.rho_kg_m3 > 0.0) {
    lines.push_back(fmt::format(
        "rho = {:.10g} {}", to_card(material.rho_kg_m3, units.density_exponent), units.density));
  }
}

void add_validity(std::vector<std::string>& lines, const Material& material) {
  const ValidityWindow& valid = material.valid;
  std::string text = "valid: ";
  text += valid.t_max_s > 0.0 ? fmt::format("{:g} s to {:g} s", valid.t_min_s, valid.t_max_s)
                              : "time window not stated";
  text += valid.strain_max > 0.0 ? fmt::format(", strain up to {}", valid.strain_max)
                                 : ", strain limit not stated";
  text +=
      material.T_ref_C ? fmt::format(", at {} C", *material.T_ref_C) : ", temperature not stated";
  lines.push_back(text);
}

void add_uncertainty(std::vector<std::string>& lines, const Material& material) {
  if (material.uncertainty) {
    const MaterialUncertainty& found = *material.uncertainty;
    lines.push_back("95 % intervals: E0 " + interval_text(found.E0_Pa_95) + " Pa, E_inf " +
                    interval_text(found.E_inf_Pa_95) + " Pa" +
                    (found.systematic_relative > 0.0
                         ? fmt::format(", and {:.2g} systematic of E0 (standard uncertainty)",
                                       found.systematic_relative)
                         : ""));
    for (std::size_t i = 0; i < found.terms.size(); ++i) {
      lines.push_back(fmt::format("  term {}: g {}, tau {} s", i + 1,
                                  interval_text(found.terms[i].g_95),
                                  interval_text(found.terms[i].tau_s_95)));
    }
  }
  for (const MaterialFlag& flag : material.flags) {
    lines.push_back("flag " + flag.name +
                    (flag.term > 0 ? fmt::format(" (term {})", flag.term) : "") + ": " +
                    written_text(flag.text));
  }
}

void add_provenance(std::vector<std::string>& lines, const Material& material,
                    const CardOptions& options) {
  const Provenance& provenance = material.provenance;
  lines.push_back(fmt::format("tests behind it: {}", provenance.raw_files.size()));
  std::vector<RawFile> files = provenance.raw_files;
  write_paths_of(files);
  for (const RawFile& file : files) {
    lines.push_back("raw data " + name_in_header(file.path) + " sha256 " + file.sha256);
  }
  if (!options.material_sha256.empty()) {
    lines.push_back("material file " +
                    (options.material_file.empty()
                         ? ""
                         : name_in_header(written_path(options.material_file)) + " ") +
                    "sha256 " + options.material_sha256);
  }
  lines.push_back(unsealed_sum_line());
  if (!options.is_reproducible) {
    if (!options.created_at.empty()) lines.push_back("created " + options.created_at);
    if (!options.command.empty()) lines.push_back("by " + options.command);
  }
}

// A material called "creep" would be a second [creep] block in MOOSE; "tau" or "double" would be a
// variable or a keyword in MFront's C++. Names of fewer than four letters may be variables there.
bool is_word_of_a_solver(const std::string& name) {
  static const std::set<std::string> kWords{
      "creep",      "density",  "materials", "stress",    "strain",    "alignas",  "alignof",
      "auto",       "bool",     "break",     "case",      "catch",     "char",     "class",
      "concept",    "const",    "continue",  "default",   "delete",    "double",   "else",
      "enum",       "explicit", "export",    "extern",    "false",     "float",    "friend",
      "goto",       "inline",   "long",      "mutable",   "namespace", "new",      "noexcept",
      "nullptr",    "operator", "private",   "protected", "public",    "real",     "register",
      "requires",   "return",   "short",     "signed",    "sizeof",    "static",   "struct",
      "switch",     "template", "this",      "throw",     "true",      "typedef",  "typename",
      "union",      "unsigned", "using",     "virtual",   "void",      "volatile", "while",
      "integrator", "deto",     "time",      "behaviour"};
  std::string lower;
  for (const char c : name) {
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name.size() < 4 || kWords.count(lower) > 0;
}

}  // namespace

std::vector<std::string> card_header(const Material& material, const CardTarget& target,
                                     const UnitSystem& units, const CardOptions& options,
                                     const std::vector<FidelityItem>& fidelity) {
  std::vector<std::string> lines;
  lines.push_back(program_with_version() + ": " +
                  (material.name.empty() ? "material" : material.name) + " for " + target.code);
  if (!target.cannot_represent.empty()) {
    lines.push_back("CANNOT REPRESENT: " + target.cannot_represent);
  }
  const bool is_in_K = target.temperature == std::string("K");
  if (material.shift && takes_shift(target, material) && !target.set_temperature.empty()) {
    lines.push_back(fmt::format(
        "SET THE TEMPERATURE of the model: {}, {:.10g} {} for the times below; "
        "without it the solver shifts them",
        target.set_temperature, material.shift->T_ref_C - (is_in_K ? kAbsoluteZero_C : 0.0),
        target.temperature));
  }
  lines.push_back(std::string("units: ") + units.name + " (" + units.description + ")");
  lines.push_back("conventions: " + conventions_in_words(target));
  add_moduli(lines, material, units, target.states_density);
  for (const FidelityItem& item : fidelity) {
    lines.push_back(item.item + ": " + to_word(item.mapping) +
                    (item.text.empty() ? "" : ", " + item.text));
  }
  add_validity(lines, material);
  add_uncertainty(lines, material);
  add_provenance(lines, material, options);
  lines.insert(lines.end(), options.notes.begin(), options.notes.end());
  if (!target.advice.empty()) lines.push_back(target.advice);
  if (target.step_note != nullptr && !material.terms.empty()) {
    lines.push_back(target.step_note(material));
  }
  for (std::string& line : lines) line = ascii(line);
  return lines;
}

std::string as_comments(const std::vector<std::string>& lines, const std::string& comment) {
  const bool is_xml = comment == "<!--";
  std::string out;
  for (std::string line : lines) {
    if (is_xml) {
      for (std::size_t at = line.find("--"); at != std::string::npos; at = line.find("--")) {
        line.replace(at, 2, "-\\-");  // the same word for a shell, so that a command can be copied
      }
      if (!line.empty() && line.back() == '-') line += ' ';
    }
    out += comment + " " + line + (is_xml ? " -->" : "") + "\n";
  }
  return out;
}

std::string card_identifier(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 && c > 0;
    if (is_plain) {
      out += c;
    } else if (!out.empty() && out.back() != '_') {
      out += '_';
    }
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  if (out.empty()) return "MATERIAL";
  if (is_word_of_a_solver(out)) out += "_material";
  if (std::isdigit(static_cast<unsigned char>(out[0])) != 0) out.insert(0, "M_");
  return out.substr(0, 60);
}

}  // namespace viscard
