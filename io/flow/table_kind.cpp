#include "io/flow/table_kind.h"

#include "fit/samples/median.h"
#include "io/basics/words.h"
#include "io/flow/plausible_record.h"
#include "io/tables/column_names.h"
#include "io/tables/column_proposal.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace viscard {
namespace {

[[noreturn]] void refuse_unknown_columns(const CsvTable& table, const FitRequest& request) {
  const auto has = [&](const char* name) {
    return find_column(table, name, request.columns).has_value();
  };
  if (const std::string unit = unknown_unit(table); !unit.empty()) {
    throw std::runtime_error(table.file + ": " + unit);
  }
  const std::string columns = ". The columns are " + columns_with_values(table);
  if (has("storage_modulus_Pa") || has("loss_modulus_Pa") || has("complex_modulus_Pa") ||
      has("complex_viscosity_Pa_s")) {
    throw std::runtime_error(
        table.file +
        ": an oscillation needs frequencies and the storage modulus, better two of storage "
        "modulus, loss modulus, tan delta and phase (or |E*|, |G*| or the complex viscosity with "
        "one of the last two), because one of them does not determine the other" +
        columns);
  }
  const std::string words = proposed_words(table);
  throw std::runtime_error(
      table.file +
      ": no known column to fit; expected force_N with depth_m, modulus_Pa, stress_Pa with "
      "strain, compliance_1_Pa, or storage_modulus_Pa with loss_modulus_Pa" +
      columns +
      (words.empty() ? ". State what each is, as in --column modulus_Pa=\"HEADER\", or with "
                       "its number from 1"
                     : ". By their headers these may be: " + words));
}

// A stress over a stretch or strain without times is a test at large strain, whose kind no column states.
void refuse_curve(const CsvTable& table, const FitRequest& request) {
  const auto has = [&](const char* name) {
    return find_column(table, name, request.columns).has_value();
  };
  const bool has_stress = has("stress_Pa") || has("nominal_stress_Pa");
  if (!has_stress || !(has("stretch") || has("strain")) || has("time_s")) return;
  throw std::runtime_error(
      table.file +
      ": holds stresses over stretches or strains without times, which show the elasticity of a "
      "rubber and no relaxation. Name the kind of test, as in " +
      quoted_for_shell({"uniaxial=" + table.file}) +
      " (or compression=, planar=, equibiaxial=). The columns are " + columns_with_values(table));
}

// Largest less smallest value, over the larger of both sizes.
double relative_range(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return (*high - *low) / std::max(std::abs(*low), std::abs(*high));
}

// A sweep of the strain amplitude at one frequency has no relaxation times. What it shows is where the material stops
// being linear: where the storage modulus has left its plateau by 5 % (Mezger, The Rheology Handbook, ch. 8.3).
void refuse_strain_sweep(const CsvTable& table, const FitRequest& request) {
  constexpr double kPlateau = 3.0, kAway = 0.05, kSweeps = 3.0, kSameFrequency = 0.01;
  const auto column = [&](const char* name) {
    return find_column(table, name, request.columns)
               ? column_with_gaps_SI(table, name, request.columns)
               : std::vector<double>{};
  };
  const std::vector<double> strain = column("strain"), storage = column("storage_modulus_Pa");
  std::vector<std::pair<double, double>> rows;
  for (std::size_t i = 0; i < std::min(strain.size(), storage.size()); ++i) {
    if (strain[i] > 0.0 && storage[i] > 0.0) rows.emplace_back(strain[i], storage[i]);
  }
  constexpr std::size_t kFewest = 4;
  if (rows.size() < kFewest || relative_range(column("frequency_Hz")) > kSameFrequency) return;
  std::sort(rows.begin(), rows.end());
  const double least = rows.front().first, most = rows.back().first;
  if (most < kSweeps * least) return;
  std::vector<double> plateau;
  for (const auto& [at, value] : rows) {
    if (at <= kPlateau * least || plateau.size() < kFewest / 2) plateau.push_back(value);
  }
  const double level_Pa = median(plateau);
  const auto is_away = [&](const auto& row) {
    return std::abs(row.second / level_Pa - 1.0) > kAway;
  };
  const auto last_near =
      std::find_if_not(rows.rbegin(), rows.rend(), is_away).base();  // all from here on are away
  const std::string unit =
      " % (the storage modulus is within 5 % of " + text_of(level_Pa, 3) + " Pa)";
  const std::string range =
      last_near == rows.end()
          ? "it is linear up to the largest strain, " + text_of(100.0 * most, 3) + unit
          : "it is linear up to a strain of " +
                text_of(100.0 * (last_near == rows.begin() ? least : std::prev(last_near)->first),
                        3) +
                unit;
  throw std::runtime_error(
      table.file + ": a sweep of the strain amplitude at one frequency, from " +
      text_of(100.0 * least, 3) + " to " + text_of(100.0 * most, 3) +
      " %, has no relaxation times to fit; " + range +
      ". Fit a sweep of the frequency within that range, or a relaxation test");
}

// For how many rows one column rests while the other moves on: within one per cent of its largest value, over a
// twentieth of the rows.
std::size_t rows_driven_by(const std::vector<double>& cause, const std::vector<double>& effect) {
  constexpr double kRest = 0.01;
  const auto limit_of = [](const std::vector<double>& values) {
    double largest = 0.0;
    for (const double value : values) {
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    }
    return kRest * largest;
  };
  const double still = limit_of(cause), moved = limit_of(effect);
  const std::size_t stride = std::max<std::size_t>(1, cause.size() / 20);
  std::size_t count = 0;
  for (std::size_t i = 0; i + stride < cause.size(); ++i) {
    const bool rests = std::abs(cause[i + stride] - cause[i]) <= still;
    if (rests && std::abs(effect[i + stride] - effect[i]) > moved) ++count;
  }
  return count;
}

// In creep the strain moves on while the stress rests; in relaxation it is the other way round.
bool is_creep(const CsvTable& table, const FitRequest& request) {
  constexpr double kTimes = 4.0, kShare = 0.05, kConstant = 0.01;
  const std::vector<double> stress = column_with_gaps_SI(table, "stress_Pa", request.columns);
  const std::vector<double> strain = column_with_gaps_SI(table, "strain", request.columns);
  if (relative_range(stress) < kConstant) return relative_range(strain) > 2.0 * kConstant;
  const auto by_stress = static_cast<double>(rows_driven_by(stress, strain));
  return by_stress > kTimes * static_cast<double>(rows_driven_by(strain, stress)) &&
         by_stress >= std::max(1.0, kShare * static_cast<double>(stress.size()));
}

// True if a column of varying numbers is none of the known quantities.
bool has_unknown_numbers(const CsvTable& table, const FitRequest& request) {
  std::vector<char> is_known(table.columns.size(), 0);
  for (const std::string& name : column_names()) {
    if (const auto use = find_column(table, name, request.columns)) is_known[use->index] = 1;
  }
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::vector<double>& values = table.columns[i].values;
    const bool changes = std::any_of(values.begin(), values.end(),
                                     [&](double value) { return value != values.front(); });
    if (is_known[i] == 0 && changes && table.columns[i].text.empty()) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> columns_of_kind(FitKind kind, const CsvTable& table,
                                         const FitRequest& request) {
  const auto first_of = [&](const std::vector<std::string>& names) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
      return find_column(table, name, request.columns).has_value();
    });
    return found != names.end() ? *found : names.back();
  };
  switch (kind) {
    case FitKind::kIndentation:
      return {"time_s", "force_N", "depth_m"};
    case FitKind::kRelaxation:
      return {"time_s", first_of({"modulus_Pa", "stress_Pa", "force_N"}), "strain"};
    case FitKind::kCreep:
      return {"time_s", first_of({"compliance_1_Pa", "stress_Pa"}), "strain"};
    case FitKind::kDma:
      return {"frequency_Hz", "storage_modulus_Pa", "loss_modulus_Pa"};
    case FitKind::kSeveral:
      break;
  }
  return {};
}

void flag_assumed_units(const CsvTable& table, const FitRequest& request, FitResult& result) {
  std::vector<std::string> names = columns_of_kind(result.kind, table, request);
  const auto loss = result.kind == FitKind::kDma
                        ? find_column(table, "loss_modulus_Pa", request.columns)
                        : std::nullopt;
  // What the moduli were computed from.
  if (loss && !table.columns[loss->index].derived_from.empty()) {
    names.insert(names.end(), {"phase_rad", "complex_modulus_Pa"});
  }
  const auto flag = assumed_units(table, request.columns, names);
  if (flag) result.flags.push_back(*flag);
}

FitKind kind_of_table(const CsvTable& table, const FitRequest& request) {
  if (!request.kind || *request.kind == FitKind::kDma) refuse_strain_sweep(table, request);
  if (request.kind) return *request.kind;
  const auto has = [&](const char* name) {
    return find_column(table, name, request.columns).has_value();
  };
  const bool is_strip = request.size.area_m2 > 0.0 && has("strain") && has("stress_Pa");
  if (has("force_N") && has("depth_m") && !is_strip) return FitKind::kIndentation;
  const bool is_dma = has("storage_modulus_Pa") && has("loss_modulus_Pa");
  if (is_dma && has("frequency_Hz")) return FitKind::kDma;
  if (has("modulus_Pa")) return FitKind::kRelaxation;
  if (has("compliance_1_Pa")) return FitKind::kCreep;
  refuse_curve(table, request);
  if (has("stress_Pa") && has("strain") && is_creep(table, request)) return FitKind::kCreep;
  if (has("stress_Pa")) return FitKind::kRelaxation;
  if (is_dma || is_storage_alone(table, request)) return FitKind::kDma;
  if (has("time_s") && is_force_alone(table, request)) return FitKind::kRelaxation;
  refuse_unknown_columns(table, request);
}

bool is_storage_alone(const CsvTable& table, const FitRequest& request) {
  const auto has = [&](const char* name) {
    return find_column(table, name, request.columns).has_value();
  };
  return has("frequency_Hz") && has("storage_modulus_Pa") && !has("loss_modulus_Pa");
}

void require_kind(const CsvTable& table, FitKind kind, const FitRequest& request) {
  const auto has = [&](const char* name) {
    return find_column(table, name, request.columns).has_value();
  };
  const bool has_history = has("stress_Pa") && has("strain");
  bool is_of_kind = false;
  switch (kind) {
    case FitKind::kIndentation:
      is_of_kind = has("force_N") && has("depth_m");
      break;
    case FitKind::kRelaxation:
      is_of_kind = has("modulus_Pa") || (has("stress_Pa") && !has("compliance_1_Pa") &&
                                         !(has_history && is_creep(table, request)));
      is_of_kind |= is_force_alone(table, request) && !has("compliance_1_Pa");
      break;
    case FitKind::kCreep:
      is_of_kind = has("compliance_1_Pa") || (has_history && is_creep(table, request));
      break;
    case FitKind::kDma:
      is_of_kind = has("storage_modulus_Pa") && has("loss_modulus_Pa");
      break;
    case FitKind::kSeveral:
      break;
  }
  if (is_of_kind) return;
  constexpr const char* kNames[] = {"an indentation", "a relaxation", "creep", "an oscillation"};
  constexpr const char* kColumns[] = {"force_N and depth_m",
                                      "modulus_Pa, stress_Pa with strain, or force_N alone",
                                      "compliance_1_Pa, or strain under a known stress_Pa",
                                      "frequency_Hz, storage_modulus_Pa and loss_modulus_Pa"};
  FitRequest open = request;
  open.kind.reset();
  const FitKind found = kind_of_table(table, open);  // refuses columns that are of no kind
  throw std::runtime_error(
      table.file + ": was given as " + kNames[static_cast<std::size_t>(kind)] + " (" +
      kColumns[static_cast<std::size_t>(kind)] + "), but its columns are those of " +
      kNames[static_cast<std::size_t>(found)] + ": " + columns_with_values(table) +
      ". State the other kind, or name the columns with --column");
}

bool is_force_alone(const CsvTable& table, const FitRequest& request) {
  for (const char* name : {"modulus_Pa", "stress_Pa", "depth_m"}) {
    if (find_column(table, name, request.columns)) return false;
  }
  if (!find_column(table, "force_N", request.columns)) return false;
  // Numbers of unknown meaning may be the depth, unless the user has decided.
  return request.kind || request.depth_m || !has_unknown_numbers(table, request);
}

}  // namespace viscard
