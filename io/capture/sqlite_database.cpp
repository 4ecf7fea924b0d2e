#include "io/capture/sqlite_database.h"

#include <sqlite3.h>

#include <bit>
#include <cerrno>
#include <map>
#include <string_view>

namespace viscard {
namespace {

[[noreturn]] void fail(sqlite3* database, const std::string& file, int code) {
  static const std::map<int, const char*> kReasons{
      {SQLITE_FULL, "the disk is full"},
      {SQLITE_IOERR, "the disk could not be read or written (full, removed or over quota?)"},
      {SQLITE_NOTADB,
       "is not an SQLite database, so neither a capture nor the answers of a study; choose another "
       "name"},
      {SQLITE_CANTOPEN, "cannot be opened; check that its folder exists and may be written to"},
      {SQLITE_CORRUPT, "is damaged"},
      {SQLITE_BUSY, "is held by another program"}};
  const auto known = kReasons.find(code & 0xff);
  const char* reason = known != kReasons.end() ? known->second
                       : database != nullptr   ? sqlite3_errmsg(database)
                                               : sqlite3_errstr(code);
  const int cause = database != nullptr ? sqlite3_system_errno(database) : 0;
  if (cause == EMFILE || cause == ENFILE) {
    reason = "cannot be opened: too many files are open; raise the limit (ulimit -n)";
  }
  std::string text = reason;
  constexpr std::string_view kNoTable = "no such ";  // "no such table: moves"
  if (text.starts_with(kNoTable)) {
    text = "has no " + text.substr(kNoTable.size()) +
           ", which viscard writes: the file was altered. Use another copy of it";
  }
  throw SqliteError(file + ": " + text, code & 0xff);
}

// A URI by which SQLite reads the file alone: https://www.sqlite.org/uri.html
std::string immutable_uri(const std::filesystem::path& path) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c != '%' && c != '?' && c != '#') {
      uri += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    uri += std::string{'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return uri + "?immutable=1";
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Statement::Statement(sqlite3* database, const char* sql, std::string file)
    : file_(std::move(file)) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(database, sql, -1, &statement, nullptr);
  statement_.reset(statement);
  if (code != SQLITE_OK) fail(database, file_, code);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK && code != SQLITE_ROW && code != SQLITE_DONE) {
    fail(sqlite3_db_handle(statement_.get()), file_, code);
  }
}

void Statement::bind(int place, double value) {
  check(sqlite3_bind_double(statement_.get(), place, value));
}
void Statement::bind(int place, std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), place, value));
}
void Statement::bind(int place, bool value) {
  bind(place, static_cast<std::int64_t>(value));
}
void Statement::bind(int place, std::string_view text) {
  check(sqlite3_bind_text64(statement_.get(), place, text.data(), text.size(), SQLITE_TRANSIENT,
                            SQLITE_UTF8));
}
void Statement::bind(int place, const std::optional<double>& value) {
  value ? bind(place, *value) : check(sqlite3_bind_null(statement_.get(), place));
}
void Statement::bind(int place, Blob blob) {
  check(sqlite3_bind_blob64(statement_.get(), place, blob.bytes.data(), blob.bytes.size(),
                            SQLITE_TRANSIENT));
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  check(code);
  return code == SQLITE_ROW;
}

void Statement::run() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_DONE && code != SQLITE_ROW) {
    sqlite3_reset(statement_.get());
    check(code);
  }
  check(sqlite3_reset(statement_.get()));
}

double Statement::number(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}
std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}
std::optional<double> Statement::maybe_number(int column) const {
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) return std::nullopt;
  return number(column);
}
std::string Statement::text(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  if (bytes == nullptr) return {};
  return {static_cast<const char*>(bytes),
          static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

std::string Statement::canonical_row() const {
  std::string bytes;
  const auto append = [&bytes](std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
  };
  const int n_columns = sqlite3_column_count(statement_.get());
  for (int column = 0; column < n_columns; ++column) {
    const int type = sqlite3_column_type(statement_.get(), column);
    bytes += static_cast<char>(type);
    if (type == SQLITE_INTEGER) {
      append(static_cast<std::uint64_t>(integer(column)));
    } else if (type == SQLITE_FLOAT) {
      append(std::bit_cast<std::uint64_t>(number(column)));
    } else if (type != SQLITE_NULL) {
      const std::string value = text(column);
      append(value.size());
      bytes += value;
    }
  }
  return bytes;
}

void Database::Close::operator()(sqlite3* database) const {
  sqlite3_close_v2(database);
}

Database::Database(const std::filesystem::path& path, Access access) : file_(path.string()) {
  std::error_code ignored;
  // A device or a pipe may never end; what cannot be looked at SQLite reports.
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    throw std::runtime_error(file_ +
                             " is not a plain file, so neither a capture nor the answers of a "
                             "study; choose another name");
  }
  sqlite3* database = nullptr;
  const bool is_alone = access == Access::kMainFileOnly;
  const int flags = (access == Access::kReadWrite ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READONLY) |
                    (is_alone ? SQLITE_OPEN_URI : 0) | SQLITE_OPEN_FULLMUTEX;
  const std::string name = is_alone ? immutable_uri(path) : path.string();
  const int code = sqlite3_open_v2(name.c_str(), &database, flags, nullptr);
  database_.reset(database);
  if (code != SQLITE_OK) fail(database, file_, code);
  sqlite3_busy_timeout(database, 2000);
  // The file may come from anywhere, so no code in it may run.
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  constexpr int kLongestValue_B = 256 << 20;  // far more than any row of ours
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, kLongestValue_B);
}

void Database::execute(const char* sql) {
  const int code = sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(database_.get(), file_, code);
}

void Database::leave_log_as_it_is() {
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
}

Statement Database::prepare(const char* sql) {
  return {database_.get(), sql, file_};
}

std::string Database::first_foreign_object() {
  return text_of(
      "SELECT type || ' ' || name FROM sqlite_schema WHERE type NOT IN ('table', 'index') OR "
      "sql LIKE 'CREATE VIRTUAL%' "
      "UNION ALL SELECT 'column ' || s.name || '.' || x.name || ', which is computed' "
      "FROM sqlite_schema s, pragma_table_xinfo(s.name) x WHERE s.type = 'table' AND x.hidden > 1 "
      "UNION ALL SELECT 'index ' || s.name || ', which is computed' "
      "FROM sqlite_schema s, pragma_index_xinfo(s.name) x WHERE s.type = 'index' AND x.cid = -2 "
      "LIMIT 1");
}

std::string Database::text_of(const char* sql) {
  Statement statement = prepare(sql);
  return statement.step() ? statement.text(0) : std::string();
}

}  // namespace viscard
