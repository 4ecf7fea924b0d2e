#include "io/capture/capture_file.h"
#include "io/capture/integrity_notes.h"
#include "io/flow/table_from_capture.h"
#include "io/python/parts.h"
#include "io/python/values.h"
#include "io/tables/column_names.h"
#include "io/tables/csv_header.h"

#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <optional>

namespace viscard::python {
namespace {

namespace py = pybind11;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Columns in SI by quantity. A quantity that two columns could be is left out, unless the user named it.
py::dict quantities_of(const CsvTable& table, const ColumnMap& map) {
  py::dict found;
  for (const ColumnKind& quantity : column_kinds()) {
    const std::string name = quantity.name;
    try {
      if (!find_column(table, name, map)) continue;
    } catch (const std::runtime_error&) {
      if (map.count(name) > 0) throw;
      continue;
    }
    found[py::str(name)] = quantity.is_text ? py::cast(column_text(table, name, map))
                                            : array_of(column_with_gaps_SI(table, name, map));
  }
  return found;
}

py::dict table_dict(CsvTable table, const ColumnMap& map) {
  py::dict out;
  out["file"] = table.file;
  out["maker"] = table.maker;
  out["preamble"] = table.preamble;
  out["comments"] = table.comments;
  out["quantities"] = quantities_of(table, map);
  py::list columns;
  for (CsvColumn& column : table.columns) {
    py::dict one;
    one["header"] = column.header;
    one["name"] = column.name;
    one["unit"] = column.unit;
    one["text"] = column.text.empty() ? py::object(py::none()) : py::cast(column.text);
    one["values"] = array_of(std::move(column.values));
    columns.append(one);
  }
  out["columns"] = columns;
  return out;
}

py::dict load_of(const CapturedRun& run, const py::object& owner) {
  const auto& rows = run.load_samples;
  const auto with_gaps = [&](std::optional<double> LoadSample::*field) {
    return array_over(rows, [&](const LoadSample& row) { return (row.*field).value_or(kNone); });
  };
  py::dict out;
  out["index"] = field_array(rows, &LoadSample::index, owner);
  out["time_s"] = field_array(rows, &LoadSample::host_time_s, owner);
  out["device_time_s"] = with_gaps(&LoadSample::device_time_s);
  out["counts"] = with_gaps(&LoadSample::counts);
  out["volts_V"] = with_gaps(&LoadSample::volts);
  out["force_N"] = with_gaps(&LoadSample::force_N);
  out["is_saturated"] = field_array(rows, &LoadSample::is_saturated, owner);
  out["is_glitch"] = field_array(rows, &LoadSample::is_glitch, owner);
  return out;
}

py::dict stage_of(const CapturedRun& run, const py::object& owner) {
  py::dict out;
  out["time_s"] = field_array(run.stage_reports, &StageReport::host_time_s, owner);
  out["position_m"] = field_array(run.stage_reports, &StageReport::position_m, owner);
  py::list states;
  for (const StageReport& row : run.stage_reports) states.append(row.state);
  out["state"] = states;
  return out;
}

py::dict moves_of(const CapturedRun& run) {
  const auto values = [&](double StageMove::*field) {
    return array_over(run.moves, [&](const CommandedMove& row) { return row.move.*field; });
  };
  py::dict out;
  out["time_s"] = values(&StageMove::start_time_s);
  out["from_m"] = values(&StageMove::from_m);
  out["to_m"] = values(&StageMove::to_m);
  out["speed_m_s"] = values(&StageMove::speed_m_s);
  out["acceleration_m_s2"] = values(&StageMove::acceleration_m_s2);
  py::list purposes;
  for (const CommandedMove& row : run.moves) purposes.append(row.purpose);
  out["purpose"] = purposes;
  return out;
}

py::dict capture_dict(const std::string& path, bool accepts_damage) {
  auto* run = new CapturedRun;
  const py::capsule owner(run, [](void* it) { delete static_cast<CapturedRun*>(it); });
  {
    const py::gil_scoped_release others_may_run;
    *run = read_capture(path, {.accepts_damage = accepts_damage});
  }
  py::dict out;
  out["file"] = path;
  out["status"] = run->status;
  out["started_at"] = run->started_at;
  out["program"] = run->program;
  out["command"] = run->command;
  out["specimen_id"] = run->specimen.id;
  out["mixing_ratio"] = run->specimen.mixing_ratio;
  out["load"] = load_of(*run, owner);
  out["stage"] = stage_of(*run, owner);
  out["moves"] = moves_of(*run);
  py::dict temperature;
  temperature["time_s"] = field_array(run->temperatures, &TemperatureSample::host_time_s, owner);
  temperature["temperature_C"] =
      field_array(run->temperatures, &TemperatureSample::temperature_C, owner);
  out["temperature"] = temperature;
  py::list events;
  for (const RunEvent& event : run->events) {
    events.append(py::make_tuple(event.host_time_s, event.name, event.value, event.text));
  }
  out["events"] = events;
  py::list notes;
  for (const IntegrityNote& note : integrity_notes(*run)) notes.append(note.text);
  out["notes"] = notes;
  out["unverified"] = accepts_damage;
  return out;
}

}  // namespace

CsvTable table_from_arrays(const py::dict& arrays, const std::string& name) {
  CsvTable table;
  table.file = name;
  table.has_header = true;
  if (py::hasattr(arrays, "comments"))  // of a table that was read from a file
    table.comments = arrays.attr("comments").cast<std::vector<std::string>>();
  for (const auto& [header, values] : arrays) {
    CsvColumn column;
    column.header = header.cast<std::string>();
    const HeaderParts parts = split_header(column.header);
    column.name = parts.name;
    column.unit = parts.unit;
    column.values = values.cast<std::vector<double>>();
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      if (std::isfinite(column.values[i])) continue;
      if (column.first_bad_line == 0) {
        column.first_bad_line = i + 1;
        column.first_bad_cell = std::isnan(column.values[i]) ? "nan" : "inf";
      }
      column.values[i] = kNone;
    }
    table.columns.push_back(std::move(column));
  }
  const std::size_t n = table.columns.empty() ? 0 : table.columns.front().values.size();
  for (std::size_t i = 0; i < n; ++i) table.lines.push_back(static_cast<std::uint32_t>(i + 1));
  return table;
}

void add_tables(py::module_& module) {
  module.def("read_table", [](const std::string& path, const std::vector<std::string>& column,
                              const std::string& sheet) {
    const ColumnMap map = column_map_from_words(column);
    std::optional<CsvTable> table;
    {
      const py::gil_scoped_release others_may_run;
      table = read_csv(path, {sheet});
    }
    return table_dict(std::move(*table), map);
  });
  module.def("read_capture", &capture_dict);
  module.def("csv_of_capture", [](const std::string& path, bool accepts_damage) {
    const py::gil_scoped_release others_may_run;
    return table_from_capture(read_capture(path, {.accepts_damage = accepts_damage}));
  });
  module.def("table_of_capture", [](const std::string& path, bool accepts_damage) {
    std::optional<CsvTable> table;
    {
      const py::gil_scoped_release others_may_run;
      table = csv_from_text(
          table_from_capture(read_capture(path, {.accepts_damage = accepts_damage})), path);
    }
    return table_dict(std::move(*table), {});
  });
}

}  // namespace viscard::python
