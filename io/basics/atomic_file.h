#pragma once

#include "io/basics/sha256.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace viscard {

// Writes a file so that a reader sees either the old or the new contents, never a part: it writes a
// temporary file in the same folder, syncs it, renames it and syncs the folder.
// Throws std::runtime_error with the path, the reason and the next step if the target exists and
// overwrite is false, if it is a folder, device or pipe, if no output may have its name (output_name.h), or if
// a step fails. The temporary file is
// removed in every case; one that a power cut or kill has left behind is removed by the next call for
// the same file. A folder that cannot be synced is an error too: the file is there, but a power cut
// may lose it. A file that the running command has read (is_input()) is never replaced.
void write_file(const std::filesystem::path& path, const std::string& contents, bool overwrite);
// Throws std::runtime_error if write_file() would not replace this file because it is read.
void refuse_input(const std::filesystem::path& path);
// The same for a file that is read to be changed, such as a rig file that gets its calibration.
void rewrite_file(const std::filesystem::path& path, const std::string& contents);

// The rights of a file that will be replaced (as for chmod), if there is one: what was private stays
// private.
std::optional<unsigned> rights_of_file(const std::filesystem::path& path);

// Makes new, renamed and removed entries of the folder survive a power cut. Throws
// std::runtime_error naming the folder and the reason. File systems that cannot sync a folder (some
// network shares) are accepted.
void sync_folder(const std::filesystem::path& folder);

// What anybody writes by hand or for one material is far smaller; tables and captures are not.
inline constexpr std::size_t kLongestText = std::size_t{64} << 20,
                             kLongestTable = std::size_t{512} << 20;

// Returns the contents of a file, which inputs.h records. Throws std::runtime_error naming the file and
// the reason, such as that it has more than `most` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t most = kLongestText);
// The same for a file that this program wrote itself for its own use; it is no input.
std::string read_own_file(const std::filesystem::path& path, std::size_t most = kLongestTable);

// SHA-256 (FIPS 180-4) of a file of any size, as 64 lower-case hexadecimal digits; inputs.h records it.
// Throws std::runtime_error naming the file if it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);
// That of what was read last from the file, which may have changed since (inputs.h); that of its contents now only if
// no recorder has seen it. What a result states of its inputs.
std::string sha256_as_read(const std::filesystem::path& path);

// Records a file that is not read as a whole, such as a capture (inputs.h). Reads it only if somebody records.
void record_input_file(const std::filesystem::path& path);

}  // namespace viscard
