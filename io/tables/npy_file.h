#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

// The bytes of a .npy file, which numpy.load() reads: doubles of a matrix, row by row. Format 1.0 of
// NumPy Enhancement Proposal 1: magic, version, length of the header, header padded to 64 bytes, data.
// Throws std::invalid_argument unless there are rows x columns values.
std::string npy_from_matrix(const std::vector<double>& values, std::size_t rows,
                            std::size_t columns);

}  // namespace viscard
