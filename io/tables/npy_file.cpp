#include "io/tables/npy_file.h"

#include <bit>
#include <stdexcept>

namespace viscard {

std::string npy_from_matrix(const std::vector<double>& values, std::size_t rows,
                            std::size_t columns) {
  if (values.size() != rows * columns) {
    throw std::invalid_argument("a matrix of " + std::to_string(rows) + " x " +
                                std::to_string(columns) + " cannot hold " +
                                std::to_string(values.size()) + " values");
  }
  const char* const order = std::endian::native == std::endian::little ? "<" : ">";
  std::string header = std::string("{'descr': '") + order +
                       "f8', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", " +
                       std::to_string(columns) + "), }";
  constexpr std::size_t kBefore = 10;  // bytes before the header
  constexpr std::size_t kBlock = 64;   // the data begin at a multiple of it
  while ((kBefore + header.size() + 1) % kBlock != 0) header += ' ';
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += '\x01';
  bytes += '\x00';
  bytes += static_cast<char>(header.size() % 256);  // the length is little-endian
  bytes += static_cast<char>(header.size() / 256);
  bytes += header;
  return bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
}

}  // namespace viscard
