// Files are written byte by byte after MathWorks' description, and by the library that reads them.
#include "io/basics/atomic_file.h"
#include "io/tables/column_map.h"
#include "io/tables/csv_table.h"
#include "tests/support/error_text.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <matio.h>
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace viscard {
namespace {

using test::contains;
using test::error_text;
using Numbers = std::vector<double>;

template <typename Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

// A data element: type, length, contents, padding to 8 bytes.
std::string element(std::uint32_t type, const std::string& contents) {
  const std::string head =
      bytes_of(std::vector<std::uint32_t>{type, static_cast<std::uint32_t>(contents.size())});
  return head + contents + std::string((8 - contents.size() % 8) % 8, '\0');
}

// An array of doubles (class 6), column by column.
std::string array(const std::string& name, std::int32_t rows, std::int32_t columns,
                  const Numbers& values) {
  constexpr std::uint32_t kInt8 = 1, kInt32 = 5, kUint32 = 6, kDouble = 9, kMatrix = 14;
  return element(kMatrix, element(kUint32, bytes_of(std::vector<std::uint32_t>{6, 0})) +
                              element(kInt32, bytes_of(std::vector<std::int32_t>{rows, columns})) +
                              element(kInt8, name) + element(kDouble, bytes_of(values)));
}

std::string matlab_file(const std::string& arrays) {
  std::string head = "MATLAB 5.0 MAT-file, written by hand";
  head.resize(124, ' ');
  return head + std::string("\x00\x01IM", 4) + arrays;
}

// A file with the struct run of two vectors, a text and a number, beside a short vector.
std::string file_with_struct(matio_compression compression) {
  const test::ScratchFolder folder;
  const std::string path = (folder / "run.mat").string();
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
  REQUIRE(file != nullptr);
  const char* fields[] = {"time_s", "force_mN", "label"};
  std::size_t one[] = {1, 1}, four[] = {4, 1}, three[] = {1, 3};
  double time_s[] = {0.0, 1.0, 2.0, 3.0}, other[] = {1.0, 2.0, 3.0};
  float force_mN[] = {8.0F, 6.0F, 5.0F, 4.5F};
  char label[] = "abc";
  matvar_t* run = Mat_VarCreateStruct("run", 2, one, fields, 3);
  Mat_VarSetStructFieldByName(
      run, "time_s", 0, Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, four, time_s, 0));
  Mat_VarSetStructFieldByName(
      run, "force_mN", 0, Mat_VarCreate(nullptr, MAT_C_SINGLE, MAT_T_SINGLE, 2, four, force_mN, 0));
  Mat_VarSetStructFieldByName(run, "label", 0,
                              Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, three, label, 0));
  matvar_t* vector = Mat_VarCreate("other", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, three, other, 0);
  for (matvar_t* variable : {run, vector}) {
    REQUIRE(Mat_VarWrite(file, variable, compression) == 0);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
  return read_file(path);
}

std::string refusal_of(const std::string& bytes) {
  return error_text([&] { csv_from_text(bytes, "a.mat"); });
}

TEST_CASE("vectors of a MATLAB file are columns by their names", "[io][csv]") {
  const std::string bytes =
      matlab_file(array("rate", 1, 1, {10.0}) + array("t", 1, 3, {0.5, 1.0, 1.0 / 3.0}) +
                  array("force_mN", 3, 1, {4.0, 2.0, 1.0}));
  const CsvTable table = csv_from_text(bytes, "run.mat");
  CHECK(table.maker == "MATLAB file");
  REQUIRE(table.columns.size() == 2);
  CHECK(column_SI(table, "time_s") == Numbers{0.5, 1.0, 1.0 / 3.0});
  CHECK(column_SI(table, "force_N") == Numbers{4e-3, 2e-3, 1e-3});
}

TEST_CASE("a matrix of a MATLAB file has its samples along its longer side", "[io][csv]") {
  const Numbers by_columns{0.0, 1.0, 2.0, 9.0, 8.0, 7.0}, by_rows{0.0, 9.0, 1.0, 8.0, 2.0, 7.0};
  for (const std::string& bytes :
       {matlab_file(array("data", 3, 2, by_columns)), matlab_file(array("data", 2, 3, by_rows))}) {
    CsvTable table = csv_from_text(bytes, "m.mat");
    table.judged = Plausible::kOff;  // the numbers are chosen to be told apart
    REQUIRE(table.columns.size() == 2);
    CHECK(table.columns[0].header == "data_1");
    CHECK(column_SI(table, "modulus_Pa", {{"modulus_Pa", "data_2"}}) == Numbers{9.0, 8.0, 7.0});
  }
}

TEST_CASE("a struct of a MATLAB file is a table of its own", "[io][csv]") {
  for (const matio_compression compression : {MAT_COMPRESSION_ZLIB, MAT_COMPRESSION_NONE}) {
    const std::string bytes = file_with_struct(compression);
    const CsvTable table = csv_from_text(bytes, "run.mat");
    CHECK(table.maker == "MATLAB file, struct 'run'");
    CHECK(column_SI(table, "time_s") == Numbers{0.0, 1.0, 2.0, 3.0});
    CHECK(column_SI(table, "force_N")[3] == Approx(4.5e-3).epsilon(1e-15));
    CHECK(csv_from_text(bytes, "run.mat", {"run"}).columns.size() == 2);
    CHECK(contains(error_text([&] { csv_from_text(bytes, "run.mat", {"rnu"}); }),
                   "run.mat: there is no struct 'rnu'; did you mean 'run'?"));
  }
}

TEST_CASE("a MATLAB file without measured numbers is refused by what it lacks", "[io][csv]") {
  CHECK(contains(refusal_of(matlab_file(array("k", 1, 1, {3.0}))),
                 "a.mat: has no vector or matrix of real numbers"));
  const std::string whole = matlab_file(array("t", 1, 3, {0.5, 1.0, 1.5}));
  for (const std::size_t n :
       {std::size_t{40}, std::size_t{140}, whole.size() - 12, whole.size() - 1}) {
    CHECK(contains(refusal_of(whole.substr(0, n)), "a.mat: is a damaged MATLAB file"));
  }
  CHECK(contains(refusal_of("MATLAB 7.3 MAT-file, HDF5"), "a.mat: is a damaged HDF5 file"));
}

// Packed as MATLAB packs its variables.
std::string packed(const std::string& bytes) {
  uLongf length = compressBound(bytes.size());
  std::string result(length, '\0');
  REQUIRE(compress(reinterpret_cast<Bytef*>(result.data()), &length,
                   reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) == Z_OK);
  const std::string tag =
      bytes_of(std::vector<std::uint32_t>{15, static_cast<std::uint32_t>(length)});
  return tag + result.substr(0, length);
}

// Found by the fuzzer: a struct whose dimensions had another type had names and no data, which the library read.
TEST_CASE("a MATLAB file with any bit flipped is read or refused", "[io][csv]") {
  const std::string good = file_with_struct(MAT_COMPRESSION_NONE);
  int refused = 0, read = 0;
  for (std::size_t at = 128; at < good.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
      try {
        csv_from_text(bytes, "a.mat");
        ++read;
      } catch (const std::runtime_error& error) {
        CHECK(contains(error.what(), "a.mat"));
        ++refused;
      }
    }
  }
  CHECK(refused > 100);
  CHECK(read > 100);
}

// Found by the fuzzer: the library asked for 8.6 GB, and for 1.9 GB for a name.
TEST_CASE("a MATLAB file that claims more than it holds is refused as damaged", "[io][csv]") {
  const std::string damaged = "a.mat: is a damaged MATLAB file";
  const std::string good = array("t", 1, 3, {0.5, 1.0, 1.5});
  CHECK(csv_from_text(matlab_file(packed(good)), "a.mat").columns.size() == 1);
  const std::string claims = array("t", 0x10000004, 1, {0.5, 1.0, 1.5});
  CHECK(contains(refusal_of(matlab_file(claims)), damaged));
  CHECK(contains(refusal_of(matlab_file(packed(claims))), damaged));
  // Every length in the file: of the matrix, its flags, dimensions, name and numbers.
  for (const std::size_t at : std::vector<std::size_t>{4, 12, 28, 44, 60}) {
    std::string bytes = good;
    bytes[at + 3] = 0x72;
    CAPTURE(at);
    CHECK(contains(refusal_of(matlab_file(bytes)), damaged));
    CHECK(contains(refusal_of(matlab_file(packed(bytes))), damaged));
  }
}

TEST_CASE("numbers of a MATLAB file whose bytes are not those of their type are refused as damaged",
          "[io][csv]") {
  const std::string good = array("t", 1, 3, {0.5, 1.0, 1.5});
  constexpr std::size_t kTypeOfNumbers = 56;
  REQUIRE(good[kTypeOfNumbers] == 9);
  for (const int type : {1, 8, 11, 12, 13, 25}) {  // 13: integers of as many bytes
    std::string bytes = good;
    bytes[kTypeOfNumbers] = static_cast<char>(type);
    CAPTURE(type);
    CHECK(contains(refusal_of(matlab_file(bytes)), "a.mat: is a damaged MATLAB file"));
  }
}

TEST_CASE("a packed element of a MATLAB file with a flipped byte is refused as damaged",
          "[io][csv]") {
  const std::string whole = packed(array("t", 1, 3, {0.5, 1.0, 1.5}));
  const std::string damaged = "a.mat: is a damaged MATLAB file";
  for (std::size_t at = 8; at < whole.size(); ++at) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(~bytes[at]);
    CAPTURE(at);
    CHECK(contains(refusal_of(matlab_file(bytes)), damaged));
  }
  CHECK(contains(refusal_of(matlab_file(packed(whole))), damaged));
  const std::string two = array("t", 1, 3, {0.5, 1.0, 1.5}) + array("x", 1, 3, {0.5, 1.0, 1.5});
  CHECK(contains(refusal_of(matlab_file(packed(two))), damaged));
  // Writers that end a packed element without its checksum of four bytes lose nothing.
  std::string bytes = whole.substr(0, whole.size() - 4);
  bytes[4] = static_cast<char>(bytes[4] - 4);
  CHECK(csv_from_text(matlab_file(bytes), "a.mat").columns.size() == 1);
}

// Every number of so many bytes the other way round.
std::string swapped(std::string bytes, std::ptrdiff_t width) {
  for (auto at = bytes.begin(); at != bytes.end(); at += width) std::reverse(at, at + width);
  return bytes;
}

TEST_CASE("a MATLAB file of a machine with the other byte order is read, its lengths checked",
          "[io][csv]") {
  // The same elements as array() writes, number by number.
  std::string bytes = array("t", 1, 3, {0.5, 1.0, 1.5});
  const auto swap_part = [&](std::size_t begin, std::size_t length, std::ptrdiff_t width) {
    bytes.replace(begin, length, swapped(bytes.substr(begin, length), width));
  };
  swap_part(0, 48, 4);  // up to the name
  swap_part(56, 8, 4);
  swap_part(64, 24, 8);
  std::string file = matlab_file(bytes);
  std::swap(file[126], file[127]);
  std::swap(file[124], file[125]);
  const CsvTable table = csv_from_text(file, "a.mat");
  REQUIRE(table.columns.size() == 1);
  CHECK(table.columns[0].values == Numbers{0.5, 1.0, 1.5});
  file[128 + 40 + 4] = 0x72;  // the length of the name, most significant byte first
  CHECK(contains(refusal_of(file), "a.mat: is a damaged MATLAB file"));
}

TEST_CASE("a sparse matrix in a MATLAB file does not hide the vectors beside it", "[io][csv]") {
  // Class 5: two numbers in a column of 268 million.
  const std::string sparse = element(
      14, element(6, bytes_of(std::vector<std::uint32_t>{5, 2})) +
              element(5, bytes_of(std::vector<std::int32_t>{0x10000004, 1})) +
              element(1, "pattern") + element(5, bytes_of(std::vector<std::int32_t>{3, 9})) +
              element(5, bytes_of(std::vector<std::int32_t>{0, 2})) +
              element(9, bytes_of(Numbers{1.0, 2.0})));
  const CsvTable table =
      csv_from_text(matlab_file(sparse + array("t", 1, 3, {0.5, 1.0, 1.5})), "a.mat");
  REQUIRE(table.columns.size() == 1);
  CHECK(table.columns[0].header == "t");
}

TEST_CASE("a MATLAB file that unpacks to more than any use is refused by what it claims",
          "[io][csv]") {
  // It claims 160 MB, and has enough packed bytes for as many.
  std::string contents = bytes_of(std::vector<std::uint32_t>{14, 160'000'000});
  for (std::uint32_t i = 0, noise = 1; i < 50'000; ++i, noise = noise * 1664525U + 1013904223U) {
    contents += bytes_of(std::vector<std::uint32_t>{noise});
  }
  CHECK(refusal_of(matlab_file(packed(contents))) ==
        "a.mat: holds more than 16777216 numbers once it is unpacked, the limit; save the measured "
        "columns alone");
}

TEST_CASE("structs nested ten thousand deep in a MATLAB file are refused as damaged", "[io][csv]") {
  std::string nested;
  for (int i = 0; i < 10000; ++i) {
    const auto length = static_cast<std::uint32_t>(nested.size());
    nested.insert(0, bytes_of(std::vector<std::uint32_t>{14, length}));
  }
  CHECK(contains(refusal_of(matlab_file(nested)), "a.mat: is a damaged MATLAB file"));
}

}  // namespace
}  // namespace viscard
