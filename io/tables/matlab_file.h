#pragma once

#include "io/tables/workbook.h"

#include <string>
#include <string_view>

namespace viscard {

// MATLAB files of level 4 (save -v4), 5 (save -v6 or -v7) and 7.3 (HDF5), which SciPy and Octave write,
// too (MathWorks, "MAT-File Format").
bool is_matlab_file(std::string_view bytes);

// A table in such a file as text: its arrays of real numbers with as many rows as most of them, by
// name in a header; rows of a matrix M become M_1, M_2 .... Vectors may lie along rows or columns. The
// variables of the file are one table, and so are the fields of each struct.
// table: a struct's name; empty: the table with most numbers. Throws std::runtime_error naming the file
// if it is damaged, if it has no array of numbers, or with a list of the structs if none has that name.
SheetText matlab_table_text(std::string_view bytes, const std::string& name,
                            const std::string& table);

// A MATLAB file of level 5 with the same contents and no packed element. Empty if the file is damaged:
// if an element, or one in it, claims more bytes than there are, or does not unpack. Throws std::runtime_error,
// without the file, beyond kMostUnpackedNumbers. libmatio asks for
// the memory that an element claims before it looks whether the file has as much.
// Source: MathWorks, "MAT-File Format", the chapter on level 5.
std::string unpacked_matlab_file(std::string_view bytes);

}  // namespace viscard
