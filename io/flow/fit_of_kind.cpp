#include "io/flow/fit_of_kind.h"

#include "fit/fit_creep.h"
#include "fit/fit_dma.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "fit/intervals/left_out.h"
#include "io/flow/plausible_record.h"
#include "io/flow/table_kind.h"
#include "io/tables/column_map.h"
#include "io/tables/column_proposal.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace viscard {
namespace {

using Column = std::vector<double>;

Column time_of(const CsvTable& table, const FitRequest& request) {
  Column time_s = column_SI(table, "time_s", request.columns);
  for (double& time : time_s) time -= request.time_zero_s.value_or(0.0);
  return time_s;
}

// By how much t = 0 is unsure: the begin of clock times was assumed.
double zero_unsure_s(const CsvTable& table, const FitRequest& request) {
  if (request.time_zero_s) return 0.0;
  const auto use = find_column(table, "time_s", request.columns);
  return use ? table.columns[use->index].zero_unsure_s : 0.0;
}

// Moduli or stresses as those of tension.
Column moduli_of(const CsvTable& table, const char* name, const FitRequest& request) {
  Column values = column_SI(table, name, request.columns);
  if (request.young_factor == 1.0) return values;
  for (double& value : values) value *= request.young_factor;
  return values;
}

// Measured, or strain over constant stress.
Column measured_compliance(const CsvTable& table, const FitRequest& request) {
  if (find_column(table, "compliance_1_Pa", request.columns) ||
      !find_column(table, "stress_Pa", request.columns) ||
      !find_column(table, "strain", request.columns)) {
    return column_SI(table, "compliance_1_Pa", request.columns);
  }
  Column compliance = column_SI(table, "strain", request.columns);
  const Column stress_Pa = column_SI(table, "stress_Pa", request.columns);
  for (std::size_t i = 0; i < compliance.size(); ++i) compliance[i] /= stress_Pa[i];
  return compliance;
}

// True for a strain under a stress that changes: creep with recovery, pulses, a ramp to the stress.
bool has_stress_history(const CsvTable& table, const FitRequest& request) {
  constexpr double kConstant = 0.01;
  if (find_column(table, "compliance_1_Pa", request.columns) ||
      !find_column(table, "stress_Pa", request.columns) ||
      !find_column(table, "strain", request.columns)) {
    return false;
  }
  const Column stress_Pa = column_SI(table, "stress_Pa", request.columns);
  const auto [low, high] = std::minmax_element(stress_Pa.begin(), stress_Pa.end());
  return !stress_Pa.empty() && *high - *low > kConstant * std::max(std::abs(*low), std::abs(*high));
}

// Rows between the first and the last that are not among those of the table any more.
std::size_t missing_rows(const CsvTable& table) {
  if (table.lines.empty()) return 0;
  const std::size_t span = table.lines[table.lines.size() - 1] - table.lines.front() + 1;
  return span - std::min(span, table.lines.size());
}

FitResult fit_stress_history(const CsvTable& table, const FitRequest& request) {
  CreepData data{.time_s = time_of(table, request),
                 .compliance_1_Pa = column_SI(table, "strain", request.columns)};
  data.is_zero_known = request.time_zero_s.has_value();
  data.stress_Pa = moduli_of(table, "stress_Pa", request);
  data.n_missing = missing_rows(table);
  return fit_creep(data, request.options);
}

// As that of tension.
Column compliance_of(const CsvTable& table, const FitRequest& request) {
  Column compliance = measured_compliance(table, request);
  if (request.young_factor == 1.0) return compliance;
  for (double& value : compliance) value /= request.young_factor;
  return compliance;
}

// Force at constant depth: a stiffness if the depth is known, a modulus if the geometry is too.
FitResult fit_force_table(const CsvTable& table, const FitRequest& request) {
  const bool has_geometry = request.specimen.has_value();
  if (has_geometry && !request.depth_m) {
    throw std::runtime_error(
        "the table has force but no depth, so a punch geometry gives no modulus; add --depth "
        "\"0.1 mm\", the constant depth of the hold");
  }
  if (request.needs_modulus && !has_geometry) {
    throw std::runtime_error(
        "--out writes moduli, but a record of force alone gives only forces or stiffnesses; add "
        "--depth and --punch-diameter or --specimen");
  }
  DepthLaw law{1.0, 1.0};
  if (has_geometry) law = depth_law(request.specimen->contact);
  const double per = request.depth_m ? law.factor * std::pow(*request.depth_m, law.power) : 1.0;
  RelaxationData data{time_of(table, request), column_SI(table, "force_N", request.columns)};
  if (!has_geometry) data.unit = request.depth_m ? "N/m" : "N";
  data.is_zero_known = request.time_zero_s.has_value();
  data.zero_unsure_s = zero_unsure_s(table, request);
  data.n_missing = missing_rows(table);
  for (double& value : data.value) value /= per;
  FitResult result = fit_relaxation(data, request.options);
  result.is_stiffness = !has_geometry;
  return result;
}

// A stress is a modulus only over its strain.
[[noreturn]] void refuse_stress_alone(const CsvTable& table, const FitRequest& request) {
  const auto header_of = [&](const char* name) -> std::string {
    const auto use = find_column(table, name, request.columns);
    return use ? table.columns[use->index].header : "";
  };
  if (header_of("stress_Pa").empty()) {
    const bool creeps = find_column(table, "compliance_1_Pa", request.columns).has_value();
    throw std::runtime_error(
        table.file +
        ": a relaxation needs a modulus, or a stress with its strain, and the table has neither" +
        (creeps
             ? "; '" + header_of("compliance_1_Pa") + "' is a compliance: fit it with --kind creep"
             : ". The columns are " + columns_with_values(table)));
  }
  const std::string length = header_of("depth_m");
  const std::string what = table.file + ": '" + header_of("stress_Pa") +
                           "' is a stress, and without its strain it is no modulus. ";
  if (!length.empty()) {
    throw std::runtime_error(what + "'" + length +
                             "' is a length; state the length of the specimen between the grips "
                             "with --gauge-length, such as \"25 mm\", and it becomes the strain");
  }
  throw std::runtime_error(what +
                           "Add a column of strain, or, if the strain was constant, a column of "
                           "the stress divided by it, "
                           "with a header such as 'modulus (MPa)'");
}

FitResult fit_relaxation_table(const CsvTable& table, const FitRequest& request) {
  RelaxationData data;
  data.time_s = time_of(table, request);
  data.is_zero_known = request.time_zero_s.has_value();
  data.zero_unsure_s = zero_unsure_s(table, request);
  data.n_missing = missing_rows(table);
  const bool has_modulus = find_column(table, "modulus_Pa", request.columns).has_value();
  if (!has_modulus && !find_column(table, "strain", request.columns)) {
    refuse_stress_alone(table, request);
  }
  data.value = moduli_of(table, has_modulus ? "modulus_Pa" : "stress_Pa", request);
  if (!has_modulus) data.strain = column_SI(table, "strain", request.columns);
  return fit_relaxation(data, request.options);
}

FitResult fit_indentation_table(const CsvTable& table, const FitRequest& request) {
  if (request.needs_modulus && !request.specimen) {
    throw std::runtime_error(
        "--out writes moduli, but an indentation without punch geometry gives only stiffnesses; "
        "add --specimen FILE, or --punch-diameter (and --layer-thickness)");
  }
  IndentationData data;
  data.is_zero_known = request.time_zero_s.has_value();
  data.time_s = time_of(table, request);
  data.force_N = column_SI(table, "force_N", request.columns);
  data.depth_m = column_SI(table, "depth_m", request.columns);
  data.before = request.before_test;
  for (double& time : data.before.time_s) time -= request.time_zero_s.value_or(0.0);
  data.frame_stiffness_N_m = request.frame_stiffness_N_m;
  data.n_missing = missing_rows(table);
  if (request.specimen) data.contact = request.specimen->contact;
  return fit_indentation(data, request.options);
}

}  // namespace

std::optional<MasterData> master_data(const CsvTable& table, FitKind kind,
                                      const FitRequest& request) {
  const bool is_step =
      kind == FitKind::kRelaxation && find_column(table, "modulus_Pa", request.columns);
  const bool has_temperature = find_column(table, "temperature_C", request.columns).has_value();
  const bool may_have_several = is_step || kind == FitKind::kDma;
  MasterData data;
  if (has_temperature && may_have_several) {
    data.temperature_C = column_SI(table, "temperature_C", request.columns);
  }
  if (!may_have_several || !has_several_temperatures(data.temperature_C)) return std::nullopt;
  if (is_step) {
    data.argument = time_of(table, request);
    data.modulus_Pa = moduli_of(table, "modulus_Pa", request);
  } else {
    data.argument = column_SI(table, "frequency_Hz", request.columns);
    data.modulus_Pa = moduli_of(table, "storage_modulus_Pa", request);
    data.loss_Pa = moduli_of(table, "loss_modulus_Pa", request);
  }
  data.T_ref_C = request.T_ref_C;
  data.start_shifts = request.start_shifts;
  return data;
}

TableFit fit_of_kind(const CsvTable& table, FitKind kind, const FitRequest& request) {
  TableFit fit;
  if (const auto data = master_data(table, kind, request)) {
    fit.master = fit_master_curve(*data, request.options);
    fit.result = fit.master->fit;
    fit.unit = "Pa";
    return fit;
  }
  switch (kind) {
    case FitKind::kIndentation:
      fit.result = fit_indentation_table(table, request);
      fit.unit = "N";
      break;
    case FitKind::kRelaxation:
      if (is_force_alone(table, request)) {
        fit.result = fit_force_table(table, request);
        fit.unit = request.specimen ? "Pa" : request.depth_m ? "N/m" : "N";
        fit.has_no_depth = !request.depth_m;
        break;
      }
      fit.result = fit_relaxation_table(table, request);
      fit.unit = "Pa";
      break;
    case FitKind::kCreep:
      if (has_stress_history(table, request)) {
        fit.result = fit_stress_history(table, request);
        fit.unit = kStrainUnit;
        break;
      }
      fit.result = fit_creep({time_of(table, request), compliance_of(table, request),
                              request.time_zero_s.has_value(), zero_unsure_s(table, request)},
                             request.options);
      fit.unit = "1/Pa";
      break;
    case FitKind::kDma:
      fit.result =
          fit_dma({column_SI(table, "frequency_Hz", request.columns),
                   moduli_of(table, "storage_modulus_Pa", request),
                   is_storage_alone(table, request) ? Column{}
                                                    : moduli_of(table, "loss_modulus_Pa", request)},
                  request.options);
      fit.unit = "Pa";
      break;
    case FitKind::kSeveral:
      throw std::logic_error("a table is one test");
  }
  return fit;
}

}  // namespace viscard
