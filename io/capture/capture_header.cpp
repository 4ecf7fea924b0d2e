#include "io/capture/capture_header.h"

#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/basics/missing_file.h"
#include "io/capture/capture_database.h"
#include "io/capture/capture_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

namespace fs = std::filesystem;

// First 100 bytes of an SQLite file, numbers big-endian:
// https://www.sqlite.org/fileformat2.html 1.3
using Header = std::array<unsigned char, 100>;
constexpr std::string_view kMagic{"SQLite format 3\0", 16};

std::uint32_t big_endian(const Header& header, std::size_t from, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = from; i < from + size; ++i) value = value << 8 | header[i];
  return value;
}

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + " " + what);
}

// Reads with read(2), because a stream does not report why it fails.
std::size_t read_header(const fs::path& path, Header& header) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (fd < 0) throw std::runtime_error(path.string() + ": " + why_not_opened(path, errno));
  const ssize_t count = ::read(fd, header.data(), header.size());
  ::close(fd);
  return count < 0 ? 0 : static_cast<std::size_t>(count);
}

[[noreturn]] void refuse_text(const fs::path& path) {
  const FileKind kind = kind_of_file(read_file(path, kLongestTable));
  // By its name viscard fit takes it for a capture, so that its use would lead back to here.
  const bool is_misnamed = kind == FileKind::kTable && path.extension() == ".viscap";
  const std::string use =
      is_misnamed ? "give it a name that ends in .csv instead of .viscap" : use_of_file_kind(kind);
  fail(path, "is " + file_kind_in_words(kind) + ", not a capture; " +
                 (use.empty() ? "viscard capture writes captures, *.viscap" : use));
}

bool has_magic(const Header& header, std::size_t size) {
  return size >= kMagic.size() && std::memcmp(header.data(), kMagic.data(), kMagic.size()) == 0;
}

}  // namespace

void check_capture_header(const fs::path& path) {
  if (fs::is_directory(path)) fail(path, "is a folder; name the capture file in it");
  Header header{};
  const std::size_t size = read_header(path, header);
  if (size == 0)
    fail(path, "is empty: the capture ended before it wrote anything; there is nothing to read");
  if (!has_magic(header, size)) refuse_text(path);
  if (size < header.size())
    fail(path, "is truncated: its header is not complete; use a copy of it");
  if (big_endian(header, 68, 4) != kCaptureApplicationId) {
    fail(path,
         "is an SQLite database, but not a capture: the points of a sweep (viscard sweep --out "
         "continues it, and --csv writes them as a table), or a database of another program");
  }
  const std::uint32_t version = big_endian(header, 60, 4);
  if (version > kCaptureSchemaVersion) {
    fail(path, "was written by a newer viscard (schema " + std::to_string(version) +
                   ", this one reads up to " + std::to_string(kCaptureSchemaVersion) +
                   "); update viscard");
  }
  // With a journal beside it, the main file may be shorter than its header states.
  const std::uint64_t page = big_endian(header, 16, 2) == 1 ? 65536 : big_endian(header, 16, 2);
  const std::uint64_t expected = page * big_endian(header, 28, 4);
  if (!has_journal(path) && fs::file_size(path) < expected) {
    fail(path, "is truncated: " + std::to_string(fs::file_size(path)) + " of " +
                   std::to_string(expected) +
                   " bytes are there; use a whole copy, or save what is left with: sqlite3 " +
                   path.string() + " .recover");
  }
}

bool has_journal(const fs::path& path) {
  std::error_code ignored;
  const auto size = fs::file_size(path.string() + "-wal", ignored);
  return !ignored && size > 0;
}

bool is_log_expected(const fs::path& path) {
  constexpr unsigned char kWithLog = 2;  // the version of the format for reading, byte 19
  Header header{};
  return read_header(path, header) == header.size() && header[19] == kWithLog;
}

bool looks_like_capture(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  if (path.extension() == ".viscap") return true;
  Header header{};
  return has_magic(header, read_header(path, header));
}

void refuse_other_than_capture(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return;  // the writer reports what is wrong
  Header header{};
  const std::size_t size = read_header(path, header);
  if (size == 0) return;
  const bool is_ours = big_endian(header, 68, 4) == kCaptureApplicationId;
  if (has_magic(header, size) && (is_ours || path.extension() == ".viscap")) return;
  fail(path, "is no capture, so --force does not replace it by one; choose another name");
}

}  // namespace viscard
