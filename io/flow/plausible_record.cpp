#include "io/flow/plausible_record.h"

#include "io/basics/words.h"
#include "io/tables/column_names.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {

std::optional<MaterialFlag> strain_flag(double largest) {
  if (!(largest > kDoubtfulStrain)) return std::nullopt;
  return MaterialFlag{"strain-beyond-linear", 0,
                      "the strain reaches " + text_of(100.0 * largest, 3) +
                          " %, but a linear law describes strains up to " +
                          text_of(100.0 * kDoubtfulStrain) +
                          " % well; for rubber at large strain fit uniaxial=FILE"};
}

std::optional<MaterialFlag> strain_flag(const CsvTable& table, const ColumnMap& columns,
                                        Plausible judged) {
  const auto use = find_column(table, "strain", columns);
  if (!use) return std::nullopt;
  double largest = 0.0;
  for (const double value : column_with_gaps_SI(table, "strain", columns)) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  if (largest > kLargestBareStrain && !use->is_unit_stated && judged != Plausible::kOff) {
    throw BadNumber(table.file + ": the column '" + table.columns[use->index].header +
                    "' states no unit, and its largest value is " + text_of(largest, 4) +
                    ", a strain of " + text_of(100.0 * largest, 4) +
                    " %; for a linear law at most " + text_of(kLargestBareStrain) +
                    " is read without a unit. If the column is in per cent, " +
                    words_for_factor(table, "strain", *use, 0.01) +
                    "; if it is not, state its unit, as in 'strain (-)', or add --plausible off");
  }
  return strain_flag(largest);
}

void refuse_depth(const CsvTable& table, double deepest_m, Plausible judged,
                  const std::string& remedy) {
  const auto doubt = doubt_about(quantities::kDepth, std::vector<double>{deepest_m}, judged);
  if (!doubt) return;
  throw BadNumber(
      table.file + ": the largest depth " +
      doubt->with_remedy(remedy.empty() ? "correct the unit" : remedy, "add --plausible off"));
}

std::optional<MaterialFlag> depth_flag(double deepest_m, double layer_m, Plausible judged,
                                       const std::string& remedy) {
  if (!(layer_m > 0.0)) return std::nullopt;
  const double share = deepest_m / layer_m;
  const auto length = [](double value_m) { return text_with_unit(value_m, "m"); };
  if (share > kDeepest && judged != Plausible::kOff) {
    throw BadNumber("the depth reaches " + length(deepest_m) + ", but the layer is " +
                    length(layer_m) + " thick: no tip goes deeper. " +
                    (remedy.empty() ? "If" : "If the depths are in mm, " + remedy + "; if") +
                    " they are right, correct --layer-thickness or the specimen file");
  }
  if (!(share > kDoubtfulDepth)) return std::nullopt;
  return MaterialFlag{"depth-beyond-linear", 0,
                      "the depth reaches " + length(deepest_m) + ", " + text_of(100.0 * share, 3) +
                          " % of the layer of " + length(layer_m) +
                          "; the law of contact is for small strains, so that the moduli are too "
                          "large above " +
                          text_of(100.0 * kDoubtfulDepth) + " %"};
}

namespace {

// "write --column 'stress_Pa=1e6*stress'" for the column without unit that the modulus is made of.
std::string remedy_for_modulus(const CsvTable& table, const ColumnMap& columns, double factor) {
  for (const char* name : {"modulus_Pa", "storage_modulus_Pa", "nominal_stress_Pa", "stress_Pa",
                           "compliance_1_Pa", "force_N"}) {
    const auto use = find_column(table, name, columns);
    if (!use) continue;
    const bool is_reciprocal = std::string(name) == "compliance_1_Pa";
    return words_for_factor(table, name, *use, is_reciprocal ? 1.0 / factor : factor);
  }
  return "name the unit of each column";
}

}  // namespace

void refuse_modulus(double E0_Pa, const CsvTable* table, const ColumnMap& columns,
                    Plausible judged) {
  if (E0_Pa == 0.0 && table != nullptr && find_column(*table, "stress_Pa", columns) &&
      find_column(*table, "strain", columns)) {
    const std::vector<double> stress = column_with_gaps_SI(*table, "stress_Pa", columns);
    const std::vector<double> strain = column_with_gaps_SI(*table, "strain", columns);
    double product = 0.0;
    for (std::size_t i = 0; i < stress.size(); ++i) {
      if (std::isfinite(stress[i] * strain[i])) product += stress[i] * strain[i];
    }
    if (product < 0.0) {
      throw BadNumber(
          table->file +
          ": stress and strain have opposite signs, which no material has; turn one of them, as in "
          "--column " +
          quoted_for_shell(
              {"stress_Pa=-" +
               table->columns[find_column(*table, "stress_Pa", columns)->index].header}));
    }
  }
  const auto doubt = doubt_about(quantities::kModulus, E0_Pa, judged);
  if (!doubt) return;
  const std::string remedy = table != nullptr
                                 ? remedy_for_modulus(*table, columns, doubt->meant_factor)
                                 : std::string("check the geometry and the calibration");
  throw BadNumber((table != nullptr ? table->file + ": " : "") + "the fitted modulus " +
                  doubt->with_remedy(remedy, "add --plausible off"));
}

std::optional<MaterialFlag> assumed_units(const CsvTable& table, const ColumnMap& columns,
                                          const std::vector<std::string>& names) {
  std::string headers, units, example, weight;
  // A table with our own names ("time_s") has a strain that is a plain number.
  const bool has_own_names = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    const auto use = find_column(table, name, columns);
    return !use || table.columns[use->index].header == name;
  });
  std::string strain;
  for (const std::string& name : names) {
    const auto use = find_column(table, name, columns);
    if (use && use->is_weight) {
      weight = "'" + table.columns[use->index].header +
               "' is in a unit of mass and was read as its weight, 9.80665 N for 1 kg; write gf or "
               "kgf if it is";
    }
    if (use && name == "strain" && !use->is_unit_stated && !has_own_names &&
        table.columns[use->index].derived_from.empty()) {
      strain =
          "'" + table.columns[use->index].header +
          "' states no unit and was read as a plain number (0.05 is 5 %); write 'strain (-)' or "
          "'strain (%)'";
    }
    if (!use || !use->is_unit_assumed) continue;
    const std::string& header = table.columns[use->index].header;
    const std::string unit = column_kind(name).unit.si;
    headers += (headers.empty() ? "'" : ", '") + header + "'";
    units += (units.empty() ? "" : ", ") + unit;
    const std::string other = unit == "1/Pa"                 ? "1/MPa"
                              : unit == "rad"                ? "deg"
                              : unit == "Pa" || unit == "Hz" ? "k" + unit
                                                             : "m" + unit;
    example = header + " (" + other + ")";
  }
  if (!strain.empty()) weight = strain + (weight.empty() ? "" : "; " + weight);
  if (headers.empty() && weight.empty()) return std::nullopt;
  if (headers.empty()) return MaterialFlag{"unit-assumed", 0, weight};
  if (!weight.empty()) weight = "; " + weight;
  const bool is_one = headers.find(',') == std::string::npos;
  return MaterialFlag{"unit-assumed", 0,
                      std::string(is_one ? "the column " : "the columns ") + headers +
                          (is_one ? " states no unit and was" : " state no unit and were") +
                          " read in " + units + "; write the unit in the header, as in '" +
                          example + "'" + weight};
}

}  // namespace viscard
