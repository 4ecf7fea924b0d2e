#pragma once

#include <filesystem>

namespace viscard {

// Checks the first bytes and the size of a capture, because SQLite's own messages would not help a
// user. Throws std::runtime_error if this is no capture, a truncated one or one of a newer viscard.
void check_capture_header(const std::filesystem::path& capture);

// True if the capture has a write-ahead log beside it.
bool has_journal(const std::filesystem::path& capture);

// False if the file itself states that it needs no log, as that of a finished run does. Throws
// std::runtime_error if it cannot be read.
bool is_log_expected(const std::filesystem::path& capture);

// True if the file is named *.viscap or begins like an SQLite database, so that a command can
// distinguish a capture, even a damaged one, from a table.
bool looks_like_capture(const std::filesystem::path& path);

// Throws std::runtime_error for a file with contents that are no capture (nor one that was
// interrupted before its first record): a new capture does not replace it.
void refuse_other_than_capture(const std::filesystem::path& path);

}  // namespace viscard
