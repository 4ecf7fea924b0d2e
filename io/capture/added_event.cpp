#include "io/capture/capture_database.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_header.h"
#include "io/capture/capture_lock.h"

#include <stdexcept>
#include <string_view>

namespace viscard {

void add_late_event(const std::filesystem::path& path, const std::string& name,
                    const std::string& value, const std::string& text) {
  if (is_being_captured(path)) {
    throw std::runtime_error(path.string() + ": is being written, so nothing can be added to it");
  }
  check_capture_header(path);
  Database database(path, Database::Access::kReadWrite);
  database.execute("PRAGMA synchronous=EXTRA");
  database.execute("BEGIN IMMEDIATE");
  const std::int64_t seq =
      1 + std::stoll("0" + database.text_of("SELECT max(last_seq) FROM checksums"));
  Statement insert = database.prepare(
      "INSERT INTO events SELECT ?, coalesce(max(host_time_s), 0.0), ?, ?, ? FROM events");
  insert.run_with(seq, std::string_view(name), std::string_view(value), std::string_view(text));
  const RowChecksum checksum = checksum_of_rows(database, "events", seq, seq);
  database.prepare("INSERT INTO checksums VALUES(?,?,?,?,?)")
      .run_with(std::string_view("events"), seq, seq, static_cast<std::int64_t>(checksum.n_rows()),
                static_cast<std::int64_t>(checksum.crc32()));
  database.prepare("UPDATE identity SET n_transactions = n_transactions + 1").run();
  database.execute("COMMIT");
}

}  // namespace viscard
