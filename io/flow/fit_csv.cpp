#include "io/basics/inputs.h"
#include "io/basics/number_text.h"
#include "io/basics/written_path.h"
#include "io/flow/fit_file.h"
#include "models/maths/failure_text.h"
#include "models/maths/result_visitor.h"

#include <cmath>
#include <exception>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {
namespace {

// Of one column: the measured values, those of the fit, and their standard deviations.
struct FittedColumn {
  std::string name;
  const std::vector<double>&measured, &fitted, &sigma;
};

std::string name_of_column(const FittedFile& fitted) {
  const bool is_force = fitted.result.kind == FitKind::kIndentation || fitted.has_no_depth;
  if (is_force) return "force_N";
  if (fitted.result.kind == FitKind::kDma) return "storage_modulus_Pa";
  if (fitted.result.kind == FitKind::kCreep) {
    return fitted.fitted_unit == "strain" ? "strain" : "compliance_1_Pa";
  }
  if (fitted.fitted_unit == "N/m") return "stiffness_N_m";
  return fitted.master && !fitted.result.curves.loss_measured.empty() ? "storage_modulus_Pa"
                                                                      : "modulus_Pa";
}

// "storage_modulus" of storage_modulus_Pa.
std::string without_unit(const std::string& name) {
  for (const std::string_view unit : {"_1_Pa", "_N_m", "_Pa", "_N"}) {
    if (name.ends_with(unit)) return name.substr(0, name.size() - unit.size());
  }
  return name;
}

// 0 if none is positive.
double least_positive(const std::vector<double>& values) {
  double least = 0.0;
  for (const double value : values) {
    if (value > 0.0 && (least == 0.0 || value < least)) least = value;
  }
  return least;
}

std::string text_of_failure(const FileOutcome& outcome) {
  try {
    std::rethrow_exception(outcome.error);
  } catch (const std::exception& error) {
    return failure_text(error, outcome.path);
  }
}

std::vector<FittedColumn> columns_of(const FittedFile& fitted) {
  const FitCurves& curves = fitted.result.curves;
  std::vector<FittedColumn> columns{
      {name_of_column(fitted), curves.measured, curves.fitted, curves.sigma}};
  if (!curves.loss_measured.empty()) {
    columns.push_back(
        {"loss_modulus_Pa", curves.loss_measured, curves.loss_fitted, curves.loss_sigma});
  }
  return columns;
}

const char* argument_of(const FittedFile& fitted) {
  const bool has_loss = !fitted.result.curves.loss_measured.empty();
  return has_loss || fitted.result.kind == FitKind::kDma ? "frequency_Hz" : "time_s";
}

}  // namespace

void show_curves(ResultVisitor& v, const FittedFile& fitted) {
  v.object("curves", "data and fit, with --curves; where samples are dense, averages", [&] {
    v("argument", argument_of(fitted), "what they are over: time_s or frequency_Hz");
    v("values", fitted.result.curves.time_s, "of the argument");
    const std::vector<FittedColumn> columns = columns_of(fitted);
    std::vector<std::size_t> numbers(columns.size());  // a column has no default to describe
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    v.list("columns", "what was fitted", numbers, [&](std::size_t c) {
      v("name", columns[c].name, "quantity and unit: modulus_Pa, force_N ...");
      v("measured", columns[c].measured, "data");
      v("fitted", columns[c].fitted, "by the model");
      v("sigma", columns[c].sigma, "standard deviations of the data; empty: not known");
    });
  });
}

std::string csv_from_fit(const FittedFile& fitted, const std::string& command) {
  const FitCurves& curves = fitted.result.curves;
  const std::vector<FittedColumn> columns = columns_of(fitted);
  std::string text = head_of_table(command) + argument_of(fitted);
  std::vector<double> least_sigma;  // of each column
  for (const FittedColumn& column : columns) {
    text += "," + column.name;
    for (const char* part : {"fitted_", "residual_", "sigma_"}) text += "," + (part + column.name);
    text += ",relative_weight_" + without_unit(column.name);
    least_sigma.push_back(least_positive(column.sigma));
  }
  text += "\n";
  for (std::size_t i = 0; i < curves.time_s.size(); ++i) {
    text += text_from_number(curves.time_s[i]);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const FittedColumn& column = columns[c];
      const double sigma = i < column.sigma.size() ? column.sigma[i] : 0.0;
      for (const double value :
           {column.measured[i], column.fitted[i], column.measured[i] - column.fitted[i], sigma}) {
        text += "," + text_from_number(value);
      }
      text += ",";
      if (sigma > 0.0) text += text_from_number(std::pow(least_sigma[c] / sigma, 2));
    }
    text += "\n";
  }
  return text;
}

std::string csv_from_fits(const std::vector<FileOutcome>& outcomes, const std::string& command) {
  std::string text =
      head_of_table(command) +
      "file,kind,unit,E0,E0_low,E0_high,E_inf,E_inf_low,E_inf_high,n_terms,n_samples,"
      "trustworthy,flags,error\n";
  std::vector<std::string> paths;
  for (const FileOutcome& outcome : outcomes) paths.push_back(outcome.path);
  const WrittenValues written(paths, "");
  for (const FileOutcome& outcome : outcomes) {
    text += csv_cell(written(outcome.path));
    if (!outcome.fitted) {
      text += ",,,,,,,,,,,0,," + csv_cell(written_text(text_of_failure(outcome))) + "\n";
      continue;
    }
    const FitResult& fit = outcome.fitted->result;
    text += std::string(",") + name_of_kind(fit.kind) + "," +
            (outcome.fitted->has_no_depth ? "N"
             : fit.is_stiffness           ? "N/m"
                                          : "Pa");
    for (const double value :
         {fit.E0_Pa, fit.E0_interval_95.low, fit.E0_interval_95.high, fit.E_inf_Pa,
          fit.E_inf_interval_95.low, fit.E_inf_interval_95.high}) {
      text += "," + text_from_number(value);
    }
    std::string flags;
    for (const MaterialFlag& flag : fit.flags) {
      if (flags.find(flag.name) == std::string::npos)
        flags += (flags.empty() ? "" : " ") + flag.name;
    }
    text += "," + std::to_string(fit.terms.size()) + "," + std::to_string(fit.n_samples) + "," +
            (fit.is_trustworthy ? "1" : "0") + "," + csv_cell(flags) + ",\n";
  }
  return text;
}

}  // namespace viscard
