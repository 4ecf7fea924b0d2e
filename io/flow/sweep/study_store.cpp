#include "io/flow/sweep/study_store.h"

#include "io/basics/json_string.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sqlite3.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace viscard {
namespace {

const char* const kTables =
    "CREATE TABLE IF NOT EXISTS study (fingerprint TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS points (point INTEGER PRIMARY KEY, parameters TEXT NOT NULL, "
    "results TEXT NOT NULL, failure TEXT NOT NULL);";

const char* const kInsert =
    "INSERT OR IGNORE INTO points (point, parameters, results, failure) VALUES (?, ?, ?, ?)";

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

Database opened(const std::filesystem::path& path, const Study& study) {
  if (std::filesystem::is_directory(path)) {
    throw std::runtime_error(path.string() + ": is a folder; name a file in it, such as " +
                             (path / "points.sqlite").string());
  }
  if (!std::filesystem::exists(path)) std::ofstream(path).flush();
  Database database(path, Database::Access::kReadWrite);
  database.execute("PRAGMA busy_timeout = 10000;");
  write_ahead(database);
  database.execute("PRAGMA synchronous = NORMAL;");
  database.execute(kTables);
  const std::string own = fingerprint(study);
  const std::string found = database.text_of("SELECT fingerprint FROM study LIMIT 1");
  if (found.empty()) {
    Statement keep = database.prepare("INSERT INTO study (fingerprint) VALUES (?)");
    keep.run_with(std::string_view(own));
  } else if (found != own) {
    throw std::runtime_error(path.string() +
                             ": holds points of another study, scene or version of viscard; name "
                             "another file with --out, or remove this one");
  }
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

StudyPoint point_in(const Statement& row) {
  return point_from(row.integer(0), ordered_json_from_text(row.text(1)),
                    ordered_json_from_text(row.text(2)), row.text(3));
}

std::string quoted(std::string text) {
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2)) {
    text.insert(at, 1, '"');
  }
  return '"' + text + '"';
}

}  // namespace

std::string bytes_from_point(const StudyPoint& point) {
  const auto bytes = nlohmann::ordered_json::to_cbor(
      {point.point, json_from(point.values), json_from(point.results), point.failure});
  return {bytes.begin(), bytes.end()};
}

StudyPoint point_from_bytes(const std::string& bytes) {
  try {
    const auto parts = nlohmann::ordered_json::from_cbor(bytes);
    return point_from(parts.at(0).get<std::int64_t>(), parts.at(1), parts.at(2),
                      parts.at(3).get<std::string>());
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error("an answer of a point arrived damaged: " + std::string(error.what()));
  }
}

StudyStore::StudyStore(const std::filesystem::path& path, const Study& study)
    : database_(opened(path, study)), insert_(database_.prepare(kInsert)) {}

std::set<std::int64_t> StudyStore::done() {
  std::set<std::int64_t> points;
  Statement rows = database_.prepare("SELECT point FROM points");
  while (rows.step()) points.insert(rows.integer(0));
  return points;
}

void StudyStore::add(const StudyPoint& point) {
  const std::string values = text_from_json(json_from(point.values)),
                    results = text_from_json(json_from(point.results));
  insert_.run_with(point.point, std::string_view(values), std::string_view(results),
                   std::string_view(point.failure));
}

void StudyStore::add(const std::vector<StudyPoint>& points) {
  database_.execute("BEGIN");
  for (const StudyPoint& point : points) add(point);
  database_.execute("COMMIT");
}

std::int64_t StudyStore::merge(const std::filesystem::path& other, const Study& study) {
  if (!std::filesystem::exists(other)) throw std::runtime_error(other.string() + ": no such file");
  StudyStore from(other, study);
  const std::set<std::int64_t> here = done();
  std::int64_t taken = 0;
  database_.execute("BEGIN");
  from.for_each([&](const StudyPoint& point) {
    if (here.count(point.point) > 0) return;
    add(point);
    ++taken;
  });
  database_.execute("COMMIT");
  return taken;
}

void StudyStore::for_each(const std::function<void(const StudyPoint&)>& take) {
  Statement rows =
      database_.prepare("SELECT point, parameters, results, failure FROM points ORDER BY point");
  while (rows.step()) take(point_in(rows));
}

std::string csv_from_study(StudyStore& store, const Study& study) {
  std::vector<NamedValue> names;  // of the first point with an answer
  store.for_each([&](const StudyPoint& point) {
    if (names.empty()) names = point.results;
  });
  std::string text = "point";
  for (const StudyParameter& parameter : study.parameters) text += "," + parameter.key;
  for (const NamedValue& one : names) {
    const std::string unit = one.unit == "1" ? "" : " [" + one.unit + "]";
    text += "," + quoted(one.name + unit) + "," + quoted("error " + one.name + unit);
  }
  text += ",failure\n";
  store.for_each([&](const StudyPoint& point) {
    text += std::to_string(point.point);
    for (const auto& [key, value] : point.values) text += "," + quoted(value);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const bool has = i < point.results.size() && point.results[i].name == names[i].name;
      text +=
          has ? fmt::format(",{},{:.3g}", point.results[i].value, point.results[i].error_estimate)
              : ",,";
    }
    text += point.failure.empty() ? ",\n" : "," + quoted(point.failure) + "\n";
  });
  return text;
}

}  // namespace viscard
