#include "io/tables/derived_columns.h"

#include "io/basics/units.h"
#include "io/basics/words.h"
#include "io/tables/column_names.h"
#include "io/tables/csv_dialect.h"
#include "io/tables/csv_header.h"
#include "io/tables/modulus_of_columns.h"
#include "io/tables/table_parts.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

using Values = std::vector<double>;

class Derivation {
 public:
  Derivation(CsvTable& table, const ColumnMap& map) : table_(table), map_(map) {}

  bool has(const char* name) const { return find_column(table_, name, map_).has_value(); }
  Values of(const char* name) const { return column_with_gaps_SI(table_, name, map_); }
  const CsvColumn& column(const char* name) const {
    return table_.columns[find_column(table_, name, map_)->index];
  }

  // Adds a column in SI. source: the quantity of the column whose header states the kind of modulus.
  // It may not be an own name of viscard, which means tension.
  void add(const char* name, Values values, const char* source, const std::string& from) {
    CsvColumn added;
    added.header = added.name = name;
    const CsvColumn& told = column(source);
    const bool is_own = told.header == source && told.derived_from.empty();
    if (!is_own) added.derived_from = told.derived_from.empty() ? told.header : told.derived_from;
    if (!is_own) added.modulus_kind = modulus_kind_of_header(told);
    const auto bad = std::find_if(values.begin(), values.end(),
                                  [](double value) { return !std::isfinite(value); });
    if (bad != values.end()) {
      added.first_bad_line = table_.lines[static_cast<std::size_t>(bad - values.begin())];
    }
    added.values = std::move(values);
    table_.columns.push_back(std::move(added));
    table_.notes.push_back(std::string(name) + ": " + from);
  }

  // The column that was added last is of tension.
  void state_tension() {
    table_.columns.back().derived_from.clear();
    table_.columns.back().modulus_kind = ModulusKind::kTension;
  }

  Values combined(const Values& a, const Values& b,
                  const std::function<double(double, double)>& of_both) const {
    Values out(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) out[i] = of_both(a[i], b[i]);
    return out;
  }

 private:
  CsvTable& table_;
  const ColumnMap& map_;
};

// The phase by which the strain lags behind, in rad; from tan delta if there is no phase. Empty without
// both.
Values phases_of(const CsvTable& table, const Derivation& made) {
  if (made.has("phase_rad")) {
    Values phase = made.of("phase_rad");
    constexpr double kMost = 0.5 * std::numbers::pi + 0.05;  // noise of a liquid
    for (const double value : phase) {
      if (!(std::abs(value) > kMost)) continue;
      const std::string& header = made.column("phase_rad").header;
      throw std::runtime_error(
          table.file + ": column '" + header + "' has a phase of " + text_of(value, 4) +
          " rad, but a phase lies between 0 and pi/2. If it is in degrees, write "
          "--column " +
          quoted_for_shell({"phase_rad=" + header + " [deg]"}));
    }
    return phase;
  }
  if (!made.has("tan_delta")) return {};
  Values phase = made.of("tan_delta");
  for (double& value : phase) value = std::atan(value);
  return phase;
}

void derive_moduli(CsvTable& table, Derivation& made) {
  const bool has_storage = made.has("storage_modulus_Pa"), has_loss = made.has("loss_modulus_Pa");
  if (has_storage && has_loss) return;
  if (has_storage || has_loss) {
    const char* known = has_storage ? "storage_modulus_Pa" : "loss_modulus_Pa";
    const Values phase = phases_of(table, made);
    if (phase.empty()) return;
    const Values modulus = made.of(known);
    if (has_storage) {
      made.add("loss_modulus_Pa",
               made.combined(modulus, phase, [](double e, double d) { return e * std::tan(d); }),
               known, "storage modulus times tan delta");
    } else {
      made.add("storage_modulus_Pa",
               made.combined(modulus, phase, [](double e, double d) { return e / std::tan(d); }),
               known, "loss modulus over tan delta");
    }
    return;
  }
  const bool has_modulus = made.has("complex_modulus_Pa");
  const bool has_viscosity =
      !has_modulus && made.has("complex_viscosity_Pa_s") && made.has("frequency_Hz");
  if (!has_modulus && !has_viscosity) return;
  const char* source = has_modulus ? "complex_modulus_Pa" : "complex_viscosity_Pa_s";
  const Values phase = phases_of(table, made);
  if (phase.empty()) return;
  Values magnitude = made.of(source);
  std::string from = "'" + made.column(source).header + "' and its phase";
  if (has_viscosity) {
    magnitude = made.combined(magnitude, made.of("frequency_Hz"), [](double eta, double f) {
      return 2.0 * std::numbers::pi * f * eta;
    });
    from += ", times the angular frequency";
  }
  made.add("storage_modulus_Pa",
           made.combined(magnitude, phase, [](double m, double d) { return m * std::cos(d); }),
           source, from);
  made.add("loss_modulus_Pa",
           made.combined(magnitude, phase, [](double m, double d) { return m * std::sin(d); }),
           source, from);
}

void derive_strains(Derivation& made) {
  if (made.has("true_strain") && !made.has("strain") && !made.has("stretch")) {
    Values strain = made.of("true_strain");
    for (double& value : strain) value = std::expm1(value);
    made.add("strain", std::move(strain), "true_strain", "exp(true strain) - 1");
  }
  if (!made.has("true_stress_Pa") || made.has("stress_Pa") || made.has("nominal_stress_Pa")) return;
  const bool has_stretch = made.has("stretch");
  if (!has_stretch && !made.has("strain")) return;
  const double rest = has_stretch ? 0.0 : 1.0;
  made.add("stress_Pa",
           made.combined(made.of("true_stress_Pa"), made.of(has_stretch ? "stretch" : "strain"),
                         [&](double stress, double stretch) { return stress / (stretch + rest); }),
           "true_stress_Pa", "true stress over the stretch (incompressible)");
}

void derive_from_load(const SpecimenSize& size, Derivation& made, SpecimenSize& used) {
  const bool has_stress = made.has("stress_Pa") || made.has("nominal_stress_Pa");
  const bool has_load = made.has("force_N") && size.area_m2 > 0.0;
  if (!has_load && !has_stress) return;
  const bool has_strain = made.has("strain") || made.has("stretch");
  if (!has_strain && made.has("depth_m") && size.gauge_length_m > 0.0) {
    Values strain = made.of("depth_m");
    for (double& value : strain) value /= size.gauge_length_m;
    used.gauge_length_m = size.gauge_length_m;
    made.add("strain", std::move(strain), "depth_m",
             "extension over the length of " + text_with_unit(size.gauge_length_m, "m"));
  } else if (!has_strain) {
    return;
  }
  if (has_stress) return;
  Values stress_Pa = made.of("force_N");
  for (double& value : stress_Pa) value /= size.area_m2;
  used.area_m2 = size.area_m2;
  made.add("stress_Pa", std::move(stress_Pa), "force_N",
           "load over the area of " + text_of(1e6 * size.area_m2, 6) + " mm2");
  made.state_tension();
}

void derive_from_ratio(CsvTable& table, const SpecimenSize& size, Derivation& made,
                       SpecimenSize& used) {
  if (!made.has("relative_modulus") || made.has("modulus_Pa")) return;
  if (!(size.E0_Pa > 0.0)) {
    throw std::runtime_error(table.file + ": column '" + made.column("relative_modulus").header +
                             "' is a modulus over its first value; state that value, Young's "
                             "modulus at once, with --youngs-modulus \"1.5 MPa\"");
  }
  Values modulus_Pa = made.of("relative_modulus");
  for (double& value : modulus_Pa) value *= size.E0_Pa;
  used.E0_Pa = size.E0_Pa;
  const std::string from =
      "'" + made.column("relative_modulus").header + "' times --youngs-modulus";
  made.add("modulus_Pa", std::move(modulus_Pa), "relative_modulus", from);
  made.state_tension();
}

// The number of a note with its unit, in SI: "Width (mm);6", "Width: 6 mm", "Width,6,mm".
std::optional<double> size_in(const std::vector<std::string>& cells, const char* si_unit) {
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
    const HeaderParts parts = split_header(cells[i]);
    std::string number = cells[i + 1];
    std::replace(number.begin(), number.end(), ',', '.');
    try {
      if (!parts.unit.empty() && is_unit_of(parts.unit, si_unit)) {
        return si_from_text(number, "1") * scale_to_si(parts.unit, si_unit).factor;
      }
      if (i + 2 < cells.size() && !cells[i + 2].empty() && is_unit_of(cells[i + 2], si_unit)) {
        return si_from_text(number, "1") * scale_to_si(cells[i + 2], si_unit).factor;
      }
      const bool has_unit = number.find_first_not_of("0123456789.+-eE ") != std::string::npos;
      if (has_unit) return si_from_text(number, si_unit);
    } catch (const std::invalid_argument&) {
      // no number with such a unit
    }
  }
  return std::nullopt;
}

std::vector<std::string> cells_of_note(const std::string& note) {
  for (const char separator : {';', '\t', ',', ':', '='}) {
    if (note.find(separator) == std::string::npos) continue;
    std::vector<std::string> cells;
    for (const std::string_view cell : plain_cells(note, separator)) cells.emplace_back(cell);
    return cells;
  }
  return {note};
}

}  // namespace

SpecimenSize derive_columns(CsvTable& table, const ColumnMap& map, const SpecimenSize& size) {
  Derivation made(table, map);
  SpecimenSize used;
  derive_moduli(table, made);
  derive_strains(made);
  derive_from_load(size, made, used);
  derive_from_ratio(table, size, made, used);
  return used;
}

OptionUses uses_of(const SpecimenSize& given, const SpecimenSize& used) {
  return {{"--gauge-length", given.gauge_length_m > 0.0, used.gauge_length_m > 0.0,
           "tables with an extension beside a load or stress, and without a strain"},
          {"--area", given.area_m2 > 0.0, used.area_m2 > 0.0,
           "tables with a load beside a strain or an extension, and without a stress"},
          {"--youngs-modulus", given.E0_Pa > 0.0, used.E0_Pa > 0.0,
           "tables of a relative modulus (E/E0), and for tests at large strain"}};
}

SpecimenSize size_from_notes(CsvTable& table, SpecimenSize known) {
  const auto value_of = [&](std::initializer_list<const char*> names, const char* si_unit) {
    for (const std::string& note : table.preamble) {
      const std::vector<std::string> cells = cells_of_note(note);
      const std::string text = lower_case(cells.front());
      const bool is_named = std::any_of(names.begin(), names.end(),
                                        [&](const char* name) { return text.starts_with(name); });
      if (!is_named) continue;
      if (const auto value = size_in(cells, si_unit); value && *value > 0.0) return *value;
    }
    return 0.0;
  };
  if (known.gauge_length_m <= 0.0) {
    known.gauge_length_m = value_of({"gauge length", "gage length", "initial length", "length",
                                     "messlänge", "longueur", "lunghezza", "longitud", "длина"},
                                    "m");
    if (known.gauge_length_m > 0.0) {
      table.notes.push_back("the notes state a length of " +
                            text_with_unit(known.gauge_length_m, "m"));
    }
  }
  if (known.area_m2 > 0.0) return known;
  known.area_m2 = value_of(
      {"area", "cross-section", "cross section", "querschnitt", "section", "площадь"}, "m2");
  if (known.area_m2 <= 0.0) {
    const double width_m = value_of({"width", "breite", "largeur", "larghezza", "ширина"}, "m");
    const double thickness_m =
        value_of({"thickness", "dicke", "épaisseur", "spessore", "толщина"}, "m");
    const double diameter_m = value_of({"diameter", "durchmesser", "diamètre", "диаметр"}, "m");
    known.area_m2 = width_m > 0.0 && thickness_m > 0.0
                        ? width_m * thickness_m
                        : 0.25 * std::numbers::pi * diameter_m * diameter_m;
  }
  if (known.area_m2 > 0.0) {
    table.notes.push_back("the notes state an area of " + text_of(1e6 * known.area_m2, 6) + " mm2");
  }
  return known;
}

}  // namespace viscard
