#include "io/tables/hdf5_file.h"
#include "io/tables/matlab_file.h"
#include "io/tables/table_limits.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

namespace viscard {
namespace {

constexpr std::size_t kHeader = 128, kTag = 8;
constexpr std::uint32_t kMatrix = 14, kPacked = 15;
// Of cells in structs in cells. Measured data do not nest as deep; the library calls itself for each level.
constexpr int kDeepest = 64;

struct Element {
  std::uint32_t type = 0;
  std::string_view contents;
};

class Reader {
 public:
  // The header ends with "IM" in the order of the machine that wrote the file.
  explicit Reader(std::string_view header)
      : is_swapped_(header.substr(kHeader - 2, 2) !=
                    (std::endian::native == std::endian::little ? "IM" : "MI")) {}

  std::uint32_t word(const char* at) const {
    std::uint32_t value = 0;
    std::memcpy(&value, at, sizeof value);
    return is_swapped_ ? __builtin_bswap32(value) : value;
  }

  // The first of the elements: its type, its length and as many bytes. Up to 4 bytes may stand in the
  // tag, with the length in the upper half of the type.
  std::optional<Element> first(std::string_view elements) const {
    if (elements.size() < kTag) return {};
    const std::uint32_t type = word(elements.data()), small_length = type >> 16;
    if (small_length > 4) return {};
    if (small_length > 0) return Element{type & 0xffff, elements.substr(4, small_length)};
    const std::uint32_t length = word(elements.data() + 4);
    if (length > elements.size() - kTag) return {};
    return Element{type, elements.substr(kTag, length)};
  }

  // True if every element inside, at any depth, ends inside the one that holds it.
  bool lengths_fit(const Element& element, int depth = 0) const {
    if (element.type == kPacked || depth > kDeepest) return false;
    if (element.type != kMatrix) return true;
    Element flags, dimensions;  // flags: what kind of array it is
    int n_inner = 0;
    for (std::string_view rest = element.contents; !rest.empty(); ++n_inner) {
      const std::optional<Element> inner = first(rest);
      if (!inner || !lengths_fit(*inner, depth + 1)) return false;
      if (n_inner == 0) flags = *inner;
      if (n_inner == 1) dimensions = *inner;
      if (n_inner == 1 && !dimensions_fit(flags, *inner, element.contents.size())) return false;
      if (n_inner > 2 && !numbers_fit(flags, dimensions, *inner)) return false;
      // Each begins at a multiple of 8 bytes; the last one may lack its padding.
      const auto end = static_cast<std::size_t>(inner->contents.end() - rest.begin());
      rest.remove_prefix(std::min(rest.size(), (end + 7) / 8 * 8));
    }
    return true;
  }

 private:
  // True if an array, of whose numbers, letters or parts each takes a byte at least, can have these dimensions: the library
  // asks for the memory of all parts of a struct before it reads one.
  bool dimensions_fit(const Element& flags, const Element& dimensions, std::size_t n_bytes) const {
    constexpr std::uint32_t kUint32 = 6, kInt32 = 5, kSparse = 5, kLastWithDimensions = 15;
    if (flags.type != kUint32 || flags.contents.size() < 4) return false;
    const std::uint32_t kind = word(flags.contents.data()) & 0xff;
    if (kind == kSparse || kind > kLastWithDimensions) return true;
    if (dimensions.type != kInt32) return false;
    std::size_t left = n_bytes;
    for (std::size_t at = 0; at + 4 <= dimensions.contents.size(); at += 4) {
      const std::size_t size = word(dimensions.contents.data() + at);
      if (size == 0) return true;
      if (size > left) return false;
      left /= size;
    }
    return true;
  }

  // True unless these are the numbers of an array, and their bytes are not those of its dimensions. Numbers may be stored in
  // a smaller type than that of their array; only arrays of 64-bit integers have that type.
  bool numbers_fit(const Element& flags, const Element& dimensions, const Element& numbers) const {
    constexpr std::uint32_t kFirstNumeric = 6, kFirstOf64Bits = 14, kLastNumeric = 15;
    constexpr std::array<std::size_t, 14> kSizes{0, 1, 1, 2, 2, 4, 4,
                                                 4, 0, 8, 0, 0, 8, 8};  // by type
    const std::uint32_t kind = word(flags.contents.data()) & 0xff;
    if (kind < kFirstNumeric || kind > kLastNumeric) return true;
    const std::size_t size = numbers.type < kSizes.size() ? kSizes[numbers.type] : 0;
    if (size == 0 || (numbers.type > 9 && kind < kFirstOf64Bits)) return false;
    std::size_t count = 1;  // at most the bytes of the array (dimensions_fit())
    for (std::size_t at = 0; at + 4 <= dimensions.contents.size(); at += 4) {
      count *= word(dimensions.contents.data() + at);
    }
    return numbers.contents.size() == count * size;
  }

  bool is_swapped_;
};

// The element that was packed; empty if it is damaged: if it has another length than it claims or if its
// checksum is wrong. A missing checksum is no damage.
// left: bytes that may be unpacked still.
std::string unpacked(std::string_view packed, const Reader& reader, std::size_t& left) {
  struct Stream : z_stream {
    Stream() : z_stream{} {}
    ~Stream() { inflateEnd(this); }
  } stream;
  if (inflateInit(&stream) != Z_OK) return {};
  // zlib reads from there only.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  const auto is_filled = [&](char* begin, std::size_t length) {
    stream.next_out = reinterpret_cast<Bytef*>(begin);
    stream.avail_out = static_cast<uInt>(length);
    return inflate(&stream, Z_SYNC_FLUSH) != Z_DATA_ERROR && stream.avail_out == 0;
  };
  std::string element(kTag, '\0');
  if (!is_filled(element.data(), kTag)) return {};
  const std::size_t length = reader.word(element.data() + 4);
  if (length > kMostFromPacked * packed.size()) return {};
  if (length > left) refuse_unpacked_numbers();
  left -= length;
  element.resize(kTag + length);
  if (length > 0 && !is_filled(element.data() + kTag, length)) return {};
  char more = 0;
  const bool is_longer = is_filled(&more, 1);
  return is_longer || stream.msg != nullptr ? std::string() : element;
}

}  // namespace

std::string unpacked_matlab_file(std::string_view bytes) {
  if (bytes.size() < kHeader) return {};
  const Reader reader(bytes.substr(0, kHeader));
  std::string file(bytes.substr(0, kHeader));
  std::size_t left = kMostUnpackedNumbers * sizeof(double);
  for (std::string_view rest = bytes.substr(kHeader); !rest.empty();) {
    const std::optional<Element> outer = reader.first(rest);
    if (!outer) return {};
    const auto end = static_cast<std::size_t>(outer->contents.end() - rest.begin());
    const std::string inflated =
        outer->type == kPacked ? unpacked(outer->contents, reader, left) : std::string();
    const std::string_view element = outer->type == kPacked ? inflated : rest.substr(0, end);
    const std::optional<Element> plain = reader.first(element);
    if (!plain || !reader.lengths_fit(*plain)) return {};
    file += element;
    rest.remove_prefix(end);
  }
  return file;
}

}  // namespace viscard
