#pragma once

#include <cstddef>

namespace viscard {

// How much of a file is read, in one place. A packed file of a megabyte may hold gigabytes, and what is read takes
// several times as much memory. A file beyond a limit is refused by a message that names the limit.

inline constexpr std::size_t kMostFromPacked = 1032;  // bytes from one (zlib, "Technical Details")

// Of a sheet in Excel, by the standard; a table of text has as many columns at most.
inline constexpr std::size_t kSheetColumns = 16384, kSheetRows = 1048576;
inline constexpr std::size_t kLongestCell = 32767;  // characters, by the standard

// Of a workbook.
inline constexpr std::size_t kMostSheets = 1000;
inline constexpr std::size_t kMostSheetBytes = std::size_t{256} << 20;  // of the text of one sheet
inline constexpr std::size_t kMostPartBytes = std::size_t{512} << 20;   // of one part, unpacked
inline constexpr std::size_t kMostWorkbookBytes = std::size_t{1}
                                                  << 30;             // of all parts that are read
inline constexpr std::size_t kMostPartTags = std::size_t{32} << 20;  // 64 bytes of memory each
inline constexpr std::size_t kMostSharedTexts = std::size_t{2}
                                                << 20;  // two columns of different texts

// Numbers of all arrays of a MATLAB or HDF5 file that were packed: four columns of four million rows.
inline constexpr std::size_t kMostUnpackedNumbers = std::size_t{16} << 20;
inline constexpr std::size_t kMostHdf5Objects = 10000;  // groups may hold themselves, several times

}  // namespace viscard
