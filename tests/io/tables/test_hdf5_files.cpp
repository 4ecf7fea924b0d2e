#include "io/basics/atomic_file.h"
#include "io/tables/csv_table.h"
#include "tests/support/error_text.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <hdf5.h>

#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

// An HDF5 file with time_s and what `add` puts beside it.
template <typename Add>
std::string hdf5_file(const std::string& path, const Add& add) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  REQUIRE(file >= 0);
  const hsize_t size = 4;
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  const std::vector<double> time_s{0.0, 1.0, 2.0, 3.0};
  const hid_t time =
      H5Dcreate2(file, "time_s", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(time, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, time_s.data());
  H5Dclose(time);
  add(file, space);
  H5Sclose(space);
  H5Fclose(file);
  return read_file(path);
}

std::string hdf5_refusal(const std::string& bytes) {
  return error_text([&] { csv_from_text(bytes, "a.h5"); });
}

}  // namespace

TEST_CASE("numbers of an HDF5 file that stand in another file are not read", "[io][csv]") {
  const ScratchFolder folder;
  const std::string path = (folder.path() / "a.h5").string();
  write_file(folder.path() / "E.raw", std::string(32, '\x40'), false);
  const std::string raw = (folder.path() / "E.raw").string();
  const std::string stored = hdf5_file(path, [&](hid_t file, hid_t space) {
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(made, raw.c_str(), 0, 32);
    H5Dclose(
        H5Dcreate2(file, "modulus_Pa", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, made, H5P_DEFAULT));
    H5Pclose(made);
  });
  CHECK(hdf5_refusal(stored).find("the numbers of 'modulus_Pa' in another file") !=
        std::string::npos);
  const std::string linked = hdf5_file(path, [&](hid_t file, hid_t) {
    H5Lcreate_external("/tmp/other.h5", "/E", file, "modulus_Pa", H5P_DEFAULT, H5P_DEFAULT);
  });
  CHECK(hdf5_refusal(linked).find("'modulus_Pa' in another file") != std::string::npos);
  const std::string virtual_data = hdf5_file(path, [&](hid_t file, hid_t space) {
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_virtual(made, space, "other.h5", "/E", space);
    H5Dclose(
        H5Dcreate2(file, "modulus_Pa", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, made, H5P_DEFAULT));
    H5Pclose(made);
  });
  CHECK(hdf5_refusal(virtual_data).find("in another file") != std::string::npos);
  const std::string within = hdf5_file(path, [&](hid_t file, hid_t space) {
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_virtual(made, space, ".", "/time_s", space);
    H5Dclose(H5Dcreate2(file, "copy_s", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, made, H5P_DEFAULT));
    H5Pclose(made);
  });
  CHECK(csv_from_text(within, "a.h5").columns.size() == 2);
}

TEST_CASE("a second name of an array within an HDF5 file is no second column", "[io][csv]") {
  const ScratchFolder folder;
  const std::string bytes = hdf5_file((folder.path() / "a.h5").string(), [](hid_t file, hid_t) {
    H5Lcreate_soft("/time_s", file, "t", H5P_DEFAULT, H5P_DEFAULT);
  });
  CHECK(csv_from_text(bytes, "a.h5").columns.size() == 1);
}

TEST_CASE("an array of an HDF5 file whose checksum fails is refused, not left out", "[io][csv]") {
  const ScratchFolder folder;
  const std::vector<double> modulus_Pa{1.5e6, 1.4e6, 1.3e6, 1.25e6};
  std::string bytes = hdf5_file((folder.path() / "a.h5").string(), [&](hid_t file, hid_t space) {
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk = 4;
    H5Pset_chunk(made, 1, &chunk);
    H5Pset_fletcher32(made);
    const hid_t data =
        H5Dcreate2(file, "modulus_Pa", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, made, H5P_DEFAULT);
    H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, modulus_Pa.data());
    H5Dclose(data);
    H5Pclose(made);
  });
  CHECK(csv_from_text(bytes, "a.h5").columns.size() == 2);
  const std::string third(reinterpret_cast<const char*>(&modulus_Pa[2]), sizeof(double));
  const std::size_t at = bytes.find(third);
  REQUIRE(at != std::string::npos);
  bytes[at + 5] = static_cast<char>(bytes[at + 5] ^ 0x10);
  CHECK(hdf5_refusal(bytes).find("'modulus_Pa' that is damaged") != std::string::npos);
}

TEST_CASE("numbers of an HDF5 file with another mantissa or another width are refused",
          "[io][csv]") {
  const ScratchFolder folder;
  const auto file_of = [&](hid_t type) {
    return hdf5_file((folder.path() / "a.h5").string(), [&](hid_t file, hid_t space) {
      const std::vector<double> modulus_Pa{1.5e6, 1.4e6, 1.3e6, 1.25e6};
      const hid_t data =
          H5Dcreate2(file, "modulus_Pa", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, modulus_Pa.data());
      H5Dclose(data);
    });
  };
  for (const hid_t usual : {H5T_IEEE_F32BE, H5T_IEEE_F64BE, H5T_STD_I32LE, H5T_STD_U64BE}) {
    CHECK(csv_from_text(file_of(usual), "a.h5").columns.size() == 2);
  }
  const hid_t shorter = H5Tcopy(H5T_IEEE_F64LE);
  H5Tset_fields(shorter, 63, 52, 11, 8, 44);
  const hid_t narrow = H5Tcopy(H5T_STD_I32LE);
  H5Tset_precision(narrow, 24);
  for (const hid_t unusual : {shorter, narrow}) {
    CHECK(hdf5_refusal(file_of(unusual)).find("'modulus_Pa' whose numbers are neither") !=
          std::string::npos);
    H5Tclose(unusual);
  }
}
