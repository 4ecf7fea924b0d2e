#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Columns of one length.
struct NamedColumn {
  std::string name;
  std::vector<double> values;
};
// By the name of the struct or group; of the file's own variables: "".
using ColumnsOfTables = std::map<std::string, std::vector<NamedColumn>>;

// Adds the columns of a matrix of values in the order of rows; its samples lie along its longer side.
void add_columns(const std::vector<double>& values, std::size_t rows, std::size_t width,
                 const std::string& name, std::vector<NamedColumn>& columns);

// Throws std::runtime_error that names kMostUnpackedNumbers, without the file.
[[noreturn]] void refuse_unpacked_numbers();

// MATLAB files of version 7.3 and other HDF5 files.
bool is_hdf5_file(std::string_view bytes);

// The vectors and matrices of real numbers in the file, and in its groups (structs in MATLAB). name: of
// the file, for messages. Throws std::runtime_error for a damaged file.
ColumnsOfTables columns_of_hdf5(std::string_view bytes, const std::string& name);

}  // namespace viscard
