#pragma once

#include <filesystem>
#include <string>

namespace viscard {

// Endings of the files of an SQLite database. SQLite finds the others by the name of the first, reads them as
// part of it, and deletes those that it finds beside a new one.
inline constexpr const char* kDatabaseParts[] = {"", "-wal", "-shm", "-journal"};

// Throws std::runtime_error if no output may have this name: that of a link that leads to nothing, which the
// output would replace, or that of a side file of an existing database, which would be damaged.
void refuse_output_name(const std::filesystem::path& path);

// Throws std::runtime_error if a database that was moved away has left its log here: a new one of this name would
// delete it, and with it the newest records. An index (-shm) holds none. what: the database, "capture".
void refuse_orphaned_log(const std::filesystem::path& path, const std::string& what);

}  // namespace viscard
