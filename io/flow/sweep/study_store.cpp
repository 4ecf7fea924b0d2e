#include "io/flow/sweep/study_store.h"

#include "io/basics/json_string.h"
#include "io/basics/number_text.h"
#include "io/basics/written_path.h"
#include "io/capture/row_checksum.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sqlite3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <thread>

namespace viscard {
namespace {

const char* const kTables =
    "CREATE TABLE IF NOT EXISTS study (fingerprint TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS inputs (path TEXT NOT NULL, sha256 TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS points (point INTEGER PRIMARY KEY, parameters TEXT NOT NULL, "
    "results TEXT NOT NULL, failure TEXT NOT NULL, kind TEXT, crc32 INTEGER);";

const char* const kInsert =
    "INSERT OR IGNORE INTO points (point, parameters, results, failure, kind, crc32) "
    "VALUES (?, ?, ?, ?, ?, ?)";

constexpr const char* kKindWords[] = {"answered", "refused", "failed", "passing"};

const char* word_of(PointKind kind) {
  return kKindWords[static_cast<std::size_t>(kind)];
}

// Rows of before there were kinds have none.
PointKind kind_from(const std::string& word, const std::string& failure) {
  for (std::size_t i = 0; i < std::size(kKindWords); ++i) {
    if (word == kKindWords[i]) return static_cast<PointKind>(i);
  }
  return failure.empty() ? PointKind::kAnswered : PointKind::kError;
}

// Stores of this user_version bind their rows to the study and its inputs.
constexpr const char* kIsBound = "PRAGMA user_version = 1;";

// What the checksums of this store begin with: a log of another store that lies beside this one would pass for its
// own otherwise. Empty in stores of before 2026-12.
std::string binding_of(Database& database, const Study& study) {
  return database.text_of("PRAGMA user_version") == "0" ? "" : fingerprint_with_inputs(study);
}

// Of the columns of a row, from the first to `kind`.
std::int64_t checksum_of(const std::string& binding, std::int64_t point,
                         const std::string& parameters, const std::string& results,
                         const std::string& failure, const std::string& kind) {
  RowChecksum sum;
  sum.add(binding);
  for (const std::string& text : {std::to_string(point), parameters, results, failure, kind}) {
    sum.add(std::to_string(text.size()) + ":" + text);
  }
  return sum.crc32();
}

// SQLite does not wait when a journal becomes a WAL while another program opens the file as well.
void write_ahead(Database& database) {
  constexpr int kMostTries = 500;
  for (int tries = 1;; ++tries) {
    try {
      database.execute("PRAGMA journal_mode = WAL;");
      return;
    } catch (const SqliteError& error) {
      if (error.code() != SQLITE_BUSY || tries == kMostTries) throw;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

[[noreturn]] void refuse_other_study(const std::filesystem::path& path,
                                     const StoreOptions& options) {
  throw std::runtime_error(
      path.string() + ": holds points of another study, scene, tolerance or version of viscard; " +
      options.elsewhere + ", or remove this one");
}

// Refuses a store of other points.
void refuse_other_points(const std::filesystem::path& path, const Study& study,
                         const StoreOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::exists(path) || std::filesystem::file_size(path, ignored) == 0) return;
  Database database = opened_to_look(path);
  if (database.text_of("SELECT count(*) FROM sqlite_schema") == "0") return;
  if (database.text_of("SELECT fingerprint FROM study LIMIT 1") != fingerprint(study))
    refuse_other_study(path, options);
}

void refuse_damage(Database& database, const std::filesystem::path& path) {
  const std::string found = database.text_of("PRAGMA quick_check(1)");
  if (found == "ok") return;
  throw std::runtime_error(path.string() + " is damaged (" + found +
                           "); use a copy of it, or remove it and answer the points again");
}

bool has_table(Database& database, const char* name) {
  Statement found = database.prepare("SELECT 1 FROM sqlite_schema WHERE name = ?");
  found.bind(1, std::string_view(name));
  return found.step();
}

bool has_column(Database& database, const char* name) {
  Statement found = database.prepare("SELECT 1 FROM pragma_table_info('points') WHERE name = ?");
  found.bind(1, std::string_view(name));
  return found.step();
}

// The file of a study that a store states under this name: the same path, or, if the study was moved or its paths
// were stripped, the first of the others outside its folder that has the same file name.
std::vector<InputFile>::iterator found_input(std::vector<InputFile>& files, const std::string& kept,
                                             bool by_file_name) {
  const auto is_outside = [](const std::string& path) {
    return path.starts_with("../") || path.starts_with("/");
  };
  const auto name_of = [](const std::string& path) {
    return std::filesystem::path(path).filename();
  };
  return std::find_if(files.begin(), files.end(), [&](const InputFile& file) {
    if (!by_file_name) return file.path == kept;
    return is_outside(file.path) && (is_outside(kept) || name_of(kept) == kept) &&
           name_of(file.path) == name_of(kept);
  });
}

// The first file that is not what it was, for a message; empty: all are.
std::string changed_input(Database& database, const Study& study) {
  std::vector<InputFile> now = study.inputs, kept;
  Statement row = database.prepare("SELECT path, sha256 FROM inputs");
  while (row.step()) kept.push_back({row.text(0), row.text(1)});
  std::string changed;
  for (const bool by_file_name : {false, true}) {
    std::erase_if(kept, [&](const InputFile& then) {
      const auto file = found_input(now, then.path, by_file_name);
      if (file == now.end()) return false;
      if (file->sha256 != then.sha256 && changed.empty()) {
        changed = file->path + " has changed since (SHA-256 " + then.sha256.substr(0, 8) +
                  "... then, " + file->sha256.substr(0, 8) + "... now)";
      }
      now.erase(file);
      return true;
    });
  }
  if (!changed.empty()) return changed;
  if (!now.empty()) return now.front().path + " was not read then";
  return kept.empty() ? "" : kept.front().path + " is not read any more";
}

// Throws if the points are of another study or other files. Returns whether the inputs are recorded.
bool check_study(Database& database, const std::filesystem::path& path, const Study& study,
                 const StoreOptions& options) {
  if (database.text_of("SELECT fingerprint FROM study LIMIT 1") != fingerprint(study)) {
    refuse_other_study(path, options);
  }
  const bool is_recorded =
      has_table(database, "inputs") && database.text_of("SELECT count(*) FROM inputs") != "0";
  if (!is_recorded) {
    if (options.accepts_unrecorded) return false;
    throw std::runtime_error(
        path.string() +
        ": inputs not recorded: it was written before stores stated the files that their points "
        "were answered with, such as materials. Name another file with --out, or, if none of them "
        "has changed, go on with --accept-unrecorded");
  }
  const std::string changed = changed_input(database, study);
  if (changed.empty()) return true;
  throw std::runtime_error(path.string() + ": its points were answered with other files: " +
                           changed + "; " + options.elsewhere + ", or remove this one");
}

void create_tables(Database& database, const Study& study) {
  database.execute(kTables);
  database.execute(kIsBound);
  Statement keep = database.prepare("INSERT INTO study (fingerprint) VALUES (?)");
  keep.run_with(std::string_view(fingerprint(study)));
  Statement input = database.prepare("INSERT INTO inputs VALUES (?, ?)");
  for (const InputFile& file : study.inputs) {
    input.run_with(std::string_view(written_path(file.path)), std::string_view(file.sha256));
  }
}

Database opened(const std::filesystem::path& path, const Study& study, const StoreOptions& options,
                bool& is_recorded) {
  refuse_second_name(path);
  refuse_other_kind(path);
  refuse_other_points(path, study, options);
  if (!std::filesystem::exists(path)) std::ofstream(path).flush();
  Database database(path, Database::Access::kReadWrite);
  database.execute("PRAGMA busy_timeout = 10000;");
  write_ahead(database);
  database.execute("PRAGMA synchronous = NORMAL;");
  refuse_damage(database, path);
  database.execute("BEGIN IMMEDIATE");  // of two programs that create the file one comes first
  if (!has_table(database, "study")) create_tables(database, study);
  is_recorded = check_study(database, path, study, options);
  for (const auto& [name, type] : {std::pair{"kind", "TEXT"}, std::pair{"crc32", "INTEGER"}}) {
    const std::string add = std::string("ALTER TABLE points ADD COLUMN ") + name + " " + type;
    if (!has_column(database, name)) database.execute(add.c_str());
  }
  database.execute("COMMIT");
  return database;
}

Database opened_to_read(const std::filesystem::path& path, const Study& study,
                        const StoreOptions& options, bool& is_recorded) {
  if (!std::filesystem::exists(path)) throw std::runtime_error(path.string() + ": no such file");
  refuse_other_kind(path);
  Database database = opened_to_look(path);
  refuse_damage(database, path);
  if (!has_table(database, "study")) refuse_other_file(path);
  is_recorded = check_study(database, path, study, options);
  return database;
}

nlohmann::ordered_json json_from(const StudyValues& values) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const auto& [key, value] : values) out[key] = value;
  return out;
}

nlohmann::ordered_json json_from(const std::vector<NamedValue>& results) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const NamedValue& one : results) {
    out[one.name] = {
        {"value", one.value}, {"unit", one.unit}, {"error_estimate", one.error_estimate}};
  }
  return out;
}

StudyPoint point_from(std::int64_t number, const nlohmann::ordered_json& values,
                      const nlohmann::ordered_json& results, const std::string& failure) {
  StudyPoint point{.point = number, .failure = failure};
  for (const auto& [key, value] : values.items()) {
    point.values.emplace_back(key, value.get<std::string>());
  }
  for (const auto& item : results.items()) {
    const nlohmann::ordered_json& one = item.value();
    const auto value_of = [&](const char* key) {
      return one.at(key).is_null() ? std::nan("") : one.at(key).get<double>();
    };
    point.results.push_back({item.key(), value_of("value"), one.at("unit").get<std::string>(),
                             value_of("error_estimate")});
  }
  return point;
}

// As files state them: a value may be the name of a file.
StudyValues written_with(const WrittenValues& written, StudyValues values) {
  for (auto& [key, value] : values) value = written(value);
  return values;
}

WrittenValues written_values_of(const Study& study) {
  std::vector<std::string> all;
  for (const StudyParameter& parameter : study.parameters)
    all.insert(all.end(), parameter.values.begin(), parameter.values.end());
  return {all, study.scene_path.parent_path()};
}

constexpr const char* kColumns = "point, parameters, results, failure, kind, crc32";

// How the rows of a store are judged.
struct RowCheck {
  std::string binding;
  bool has_recorded_inputs = true;

  bool is_sound(const Statement& row) const;
};

// Of a row with these columns. Rows of before there were checksums have none; stores that state their inputs
// had them from the beginning.
bool RowCheck::is_sound(const Statement& row) const {
  if (!row.maybe_number(5)) return !has_recorded_inputs && row.text(4).empty();
  return checksum_of(binding, row.integer(0), row.text(1), row.text(2), row.text(3), row.text(4)) ==
         row.integer(5);
}

StudyPoint point_in(const Statement& row) {
  StudyPoint point = point_from(row.integer(0), ordered_json_from_text(row.text(1)),
                                ordered_json_from_text(row.text(2)), row.text(3));
  point.kind = kind_from(row.text(4), point.failure);
  return point;
}

std::string columns_of(Database& database) {
  return has_column(database, "crc32") ? kColumns
                                       : "point, parameters, results, failure, NULL, NULL";
}

std::vector<std::int64_t> damaged_rows(Database& database, const RowCheck& check) {
  std::vector<std::int64_t> damaged;
  Statement row = database.prepare(("SELECT " + columns_of(database) + " FROM points").c_str());
  while (row.step()) {
    if (!check.is_sound(row)) damaged.push_back(row.integer(0));
  }
  return damaged;
}

}  // namespace

std::string bytes_from_point(const StudyPoint& point) {
  const auto bytes = nlohmann::ordered_json::to_cbor({point.point, json_from(point.values),
                                                      json_from(point.results), point.failure,
                                                      static_cast<int>(point.kind)});
  return {bytes.begin(), bytes.end()};
}

StudyPoint point_from_bytes(const std::string& bytes) {
  try {
    const auto parts = nlohmann::ordered_json::from_cbor(bytes);
    StudyPoint point = point_from(parts.at(0).get<std::int64_t>(), parts.at(1), parts.at(2),
                                  parts.at(3).get<std::string>());
    point.kind = kind_from(kKindWords[parts.at(4).get<std::size_t>() % std::size(kKindWords)], "");
    return point;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error("an answer of a point arrived damaged: " + std::string(error.what()));
  }
}

StudyStore::StudyStore(const std::filesystem::path& path, const Study& study,
                       const StoreOptions& options)
    : lock_(options.is_answering
                ? std::optional<StudyLock>(std::in_place, path, options.on_gone, options.waits_s)
                : std::nullopt),
      database_(opened(path, study, options, has_recorded_inputs_)),
      binding_(binding_of(database_, study)),
      written_(written_values_of(study)),
      insert_(database_.prepare(kInsert)) {
  Statement forget = database_.prepare("DELETE FROM points WHERE point = ?");
  for (const std::int64_t point : damaged_rows(database_, {binding_, has_recorded_inputs_})) {
    forget.run_with(point);
    ++n_damaged_;
  }
  // Rows of before there were kinds have failed if they state a reason.
  if (options.retries_failed) {
    database_.execute(
        "DELETE FROM points WHERE kind = 'failed' OR (kind IS NULL AND failure <> '')");
  }
}

std::set<std::int64_t> StudyStore::done() {
  std::set<std::int64_t> points;
  Statement rows = database_.prepare("SELECT point FROM points");
  while (rows.step()) points.insert(rows.integer(0));
  return points;
}

std::int64_t StudyStore::count(PointKind kind) {
  std::int64_t n = 0;
  for_each([&](const StudyPoint& point) { n += point.kind == kind ? 1 : 0; });
  return n;
}

void StudyStore::add(const StudyPoint& point) {
  if (lock_) lock_->check_file();
  if (point.kind == PointKind::kPassing) return;
  const std::string values = text_from_json(json_from(written_with(written_, point.values))),
                    results = text_from_json(json_from(point.results)), kind = word_of(point.kind);
  insert_.run_with(point.point, std::string_view(values), std::string_view(results),
                   std::string_view(point.failure), std::string_view(kind),
                   checksum_of(binding_, point.point, values, results, point.failure, kind));
}

void StudyStore::add(const std::vector<StudyPoint>& points) {
  database_.execute("BEGIN");
  for (const StudyPoint& point : points) add(point);
  database_.execute("COMMIT");
}

std::int64_t StudyStore::merge(const std::filesystem::path& other, const Study& study,
                               const StoreOptions& options) {
  bool is_recorded = false;
  Database from = opened_to_read(other, study, options, is_recorded);
  const RowCheck check{binding_of(from, study), is_recorded};
  const std::set<std::int64_t> here = done();
  std::int64_t taken = 0;
  std::size_t n_damaged = 0;
  database_.execute("BEGIN");
  Statement row =
      from.prepare(("SELECT " + columns_of(from) + " FROM points ORDER BY point").c_str());
  while (row.step()) {
    if (!check.is_sound(row)) {
      ++n_damaged;
      continue;
    }
    if (here.count(row.integer(0)) > 0) continue;
    add(point_in(row));
    ++taken;
  }
  database_.execute("COMMIT");
  n_damaged_ += n_damaged;
  return taken;
}

void StudyStore::for_each(const std::function<void(const StudyPoint&)>& take) {
  const std::string sql = "SELECT " + std::string(kColumns) + " FROM points ORDER BY point";
  Statement rows = database_.prepare(sql.c_str());
  while (rows.step()) {
    if (RowCheck{binding_, has_recorded_inputs_}.is_sound(rows)) take(point_in(rows));
  }
}

void check_study_store(const std::filesystem::path& path, const Study& study,
                       const StoreOptions& options) {
  bool is_recorded = false;
  opened_to_read(path, study, options, is_recorded);
}

std::string csv_from_study(StudyStore& store, const Study& study) {
  // In the order in which the points first have them: some parameters change what is answered.
  std::vector<std::string> names;
  std::map<std::string, std::size_t> column;
  const auto name_of = [](const NamedValue& one) {
    return one.name + (one.unit == "1" ? "" : " [" + one.unit + "]");
  };
  store.for_each([&](const StudyPoint& point) {
    for (const NamedValue& one : point.results) {
      if (column.try_emplace(name_of(one), names.size()).second) names.push_back(name_of(one));
    }
  });
  std::string text = "point";
  for (const StudyParameter& parameter : study.parameters) text += "," + parameter.key;
  for (const std::string& name : names)
    text += "," + csv_cell(name) + "," + csv_cell("error " + name);
  text += ",failure\n";
  const WrittenValues written = written_values_of(study);
  store.for_each([&](const StudyPoint& point) {
    text += std::to_string(point.point);
    for (const auto& [key, value] : written_with(written, point.values))
      text += "," + csv_cell(value);
    std::vector<std::string> cells(names.size(), ",,");
    for (const NamedValue& one : point.results) {
      cells[column.at(name_of(one))] = fmt::format(",{},{:.3g}", one.value, one.error_estimate);
    }
    for (const std::string& cell : cells) text += cell;
    text += "," + (point.failure.empty() ? "" : csv_cell(written_text(point.failure))) + "\n";
  });
  return text;
}

}  // namespace viscard
