#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace viscard {

// The part of SQLite that captures need, with errors as exceptions.
class SqliteError : public std::runtime_error {
 public:
  SqliteError(const std::string& what, int code) : std::runtime_error(what), code_(code) {}
  int code() const { return code_; }  // primary result code, SQLITE_FULL ...

 private:
  int code_;
};

class Statement {
 public:
  Statement(sqlite3* database, const char* sql, std::string file);

  // Parameters are counted from 1; an empty optional is stored as NULL.
  struct Blob {
    std::string_view bytes;
  };
  void bind(int place, double value);
  void bind(int place, std::int64_t value);
  void bind(int place, bool value);
  void bind(int place, std::string_view text);
  void bind(int place, const std::optional<double>& value);
  void bind(int place, Blob blob);

  // True while there is a row; columns are counted from 0.
  bool step();
  // Runs a statement without rows and makes it ready for the next parameters.
  void run();
  // The same with all parameters, from the first.
  template <typename... Values>
  void run_with(const Values&... values) {
    int place = 0;
    (bind(++place, values), ...);
    run();
  }

  double number(int column) const;
  std::int64_t integer(int column) const;
  std::optional<double> maybe_number(int column) const;
  std::string text(int column) const;  // text or blob
  // Types and values of the row's columns as bytes that are the same on every machine.
  std::string canonical_row() const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  void check(int code) const;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  std::string file_;
};

class Database {
 public:
  // kMainFileOnly reads without a write-ahead log that lies beside the file.
  enum class Access { kReadOnly, kReadWrite, kMainFileOnly };
  // The file must exist. The text of an error begins with its name.
  Database(const std::filesystem::path& path, Access access);

  void execute(const char* sql);
  Statement prepare(const char* sql);
  // First column of the first row; "" without a row.
  std::string text_of(const char* sql);
  // Closing the file will not merge its log into it, nor remove the log.
  void leave_log_as_it_is();
  // The first view, trigger or virtual table. Files of viscard have none, and one may never end or run code of
  // others. "" without one.
  std::string first_foreign_object();

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Close> database_;
  std::string file_;
};

}  // namespace viscard
