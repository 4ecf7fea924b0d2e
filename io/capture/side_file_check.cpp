#include "io/capture/side_file_check.h"

#include "io/capture/capture_database.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>

namespace viscard {
namespace {

constexpr std::size_t kLogHeader_B = 32, kFrameHeader_B = 24;
constexpr std::size_t kSaltsInHeader = 16, kSaltsInFrame = 8, kSalts_B = 8;
constexpr std::uint32_t kLogMagic = 0x377f0682;  // the last bit: checksums of big-endian words

std::uint32_t word_at(std::string_view bytes, std::size_t at, bool is_big_endian = true) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto byte = static_cast<unsigned char>(bytes[at + (is_big_endian ? i : 3 - i)]);
    word = word << 8 | byte;
  }
  return word;
}

// The running checksum of header and frames.
struct LogSum {
  std::uint32_t first = 0, second = 0;
  bool is_big_endian = false;

  void add(std::string_view bytes) {
    for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
      first += word_at(bytes, at, is_big_endian) + second;
      second += word_at(bytes, at + 4, is_big_endian) + first;
    }
  }
  bool is_at(std::string_view bytes, std::size_t at) const {
    return word_at(bytes, at) == first && word_at(bytes, at + 4) == second;
  }
};

std::string read_up_to(std::istream& file, std::size_t size) {
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool is_page_size(std::uint32_t size) {
  return size >= 512 && size <= 65536 && (size & (size - 1)) == 0;
}

// Follows transactions from frame to frame. A frame that was written after a synced transaction shows
// that everything up to that transaction was safe on the disk.
class SyncTrail {
 public:
  // Precondition: the frame has its whole header.
  void take(std::string_view frame, bool is_behind_hole) {
    is_synced_ = is_synced_ || frame.find(kSyncedCount) != std::string_view::npos;
    const bool is_commit = word_at(frame, 4) != 0;
    if (!is_commit) return;
    has_synced_behind_ = has_synced_behind_ || (is_synced_ && is_behind_hole);
    is_synced_ = false;
  }
  // True if a synced transaction ended at the hole or behind it.
  bool has_synced_behind() const { return has_synced_behind_; }

 private:
  bool is_synced_ = false;  // of the transaction that the frame belongs to
  bool has_synced_behind_ = false;
};

// Salts of an earlier use of the log: every new use counts the first of them up.
bool is_of_earlier_use(std::string_view frame, std::string_view salts) {
  constexpr std::uint32_t kMostUses = 1u << 20;
  const std::uint32_t uses_ago = word_at(salts, 0) - word_at(frame, kSaltsInFrame);
  return uses_ago > 0 && uses_ago < kMostUses;
}

// True for what is neither a frame of a log of this run nor space that a file system has filled with
// zeros.
bool is_foreign_frame(std::string_view frame, std::string_view salts) {
  return frame.substr(kSaltsInFrame, kSalts_B) != salts && !is_of_earlier_use(frame, salts) &&
         frame.find_first_not_of('\0') != std::string_view::npos;
}

// Looks for frames of this use of the log in what lies at and behind the first bad frame, also at
// places where no frame should begin.
SideFileCheck judge_rest(std::string_view rest, std::string_view salts, std::size_t frame_B,
                         std::uint64_t n_sound, SyncTrail trail) {
  SideFileCheck check;
  std::size_t at = rest.find(salts, kSaltsInFrame);
  while (at != std::string_view::npos) {
    const std::size_t begin = at - kSaltsInFrame;
    if (trail.has_synced_behind()) {
      return {"frame " + std::to_string(n_sound + 1) + " (byte " +
              std::to_string(kLogHeader_B + n_sound * frame_B) +
              ") is not what was written, and cuts off the records behind it, which were safe"};
    }
    if (begin > 0) check.is_torn = true;
    const std::size_t next = rest.find(salts, at + kSalts_B);
    const std::string_view frame =
        rest.substr(begin, next == std::string_view::npos ? next : next - kSaltsInFrame - begin);
    if (frame.size() >= kFrameHeader_B) trail.take(frame, true);
    at = next;
  }
  for (at = 0; at + frame_B <= rest.size(); at += frame_B) {
    check.is_torn = check.is_torn || is_foreign_frame(rest.substr(at, frame_B), salts);
  }
  return check;
}

}  // namespace

SideFileCheck check_side_file(const std::filesystem::path& log) {
  std::ifstream file(log, std::ios::binary);
  const std::string header = read_up_to(file, kLogHeader_B);
  if (header.size() < kLogHeader_B) return {"it cannot be read, or is shorter than its header"};
  const std::uint32_t magic = word_at(header, 0), page_B = word_at(header, 8);
  if ((magic & ~1u) != kLogMagic || !is_page_size(page_B)) {
    return {"it does not begin as the log of a capture does, so that no record in it is read"};
  }
  LogSum sum{.is_big_endian = (magic & 1) != 0};
  sum.add(std::string_view(header).substr(0, 24));
  if (!sum.is_at(header, 24)) {
    return {"its header is not what was written, so that no record in it is read"};
  }
  const std::string_view salts = std::string_view(header).substr(kSaltsInHeader, kSalts_B);
  const std::size_t frame_B = kFrameHeader_B + page_B;
  SyncTrail trail;
  for (std::uint64_t n_sound = 0;; ++n_sound) {
    std::string frame = read_up_to(file, frame_B);
    if (frame.size() < frame_B) return {};  // the end, or a frame that was being written
    const std::string_view bytes = frame;
    sum.add(bytes.substr(0, 8));
    sum.add(bytes.substr(kFrameHeader_B));
    const bool is_sound = bytes.substr(kSaltsInFrame, kSalts_B) == salts &&
                          word_at(bytes, 0) != 0 && sum.is_at(bytes, 16);
    if (!is_sound) {
      frame.append(std::istreambuf_iterator<char>(file), {});
      return judge_rest(frame, salts, frame_B, n_sound, trail);
    }
    trail.take(bytes, false);
  }
}

}  // namespace viscard
