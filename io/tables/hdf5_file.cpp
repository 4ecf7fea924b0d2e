#include "io/tables/hdf5_file.h"

#include "io/tables/table_limits.h"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// A handle of the library with the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t id() const { return id_; }
  bool is_open() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// How many numbers a file may have.
struct NumberLimit {
  std::size_t possible = 0;  // of one array, packed as well as can be
  std::size_t left = 0;      // of those that are read
  std::size_t objects_left = kMostHdf5Objects;
};

[[noreturn]] void refuse_other_file(const std::string& what) {
  throw std::runtime_error("has " + what +
                           " in another file, which is not read; save all columns in one file");
}

// Whether parts of an array stand in other files; "." is the file itself.
bool has_parts_elsewhere(hid_t made) {
  if (H5Pget_layout(made) != H5D_VIRTUAL) return false;
  std::size_t count = 0;
  if (H5Pget_virtual_count(made, &count) < 0) return true;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<char, 2> file{};
    if (H5Pget_virtual_filename(made, i, file.data(), file.size()) != 1 || file[0] != '.') {
      return true;
    }
  }
  return false;
}

// The numbers of an array must stand in the file itself, whose sum is recorded.
void refuse_numbers_elsewhere(hid_t data, const char* name) {
  const Handle made(H5Dget_create_plist(data), H5Pclose);
  if (has_parts_elsewhere(made.id()) || H5Pget_external_count(made.id()) > 0)
    refuse_other_file(std::string("the numbers of '") + name + "'");
}

// The library also converts what a damaged description makes of numbers, such as a mantissa that begins three bits later.
bool is_usual_number(hid_t type) {
  if (H5Tget_class(type) == H5T_INTEGER) {
    return H5Tget_offset(type) == 0 && H5Tget_precision(type) == 8 * H5Tget_size(type);
  }
  const std::array<hid_t, 4> known{H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_IEEE_F64BE, H5T_IEEE_F32BE};
  return std::any_of(known.begin(), known.end(),
                     [&](hid_t one) { return H5Tequal(type, one) > 0; });
}

void read_numbers(hid_t group, const char* name, NumberLimit& most,
                  std::vector<NamedColumn>& columns) {
  const Handle data(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose);
  if (!data.is_open()) return;
  const Handle type(H5Dget_type(data.id()), H5Tclose);
  const H5T_class_t number = H5Tget_class(type.id());
  if (number != H5T_FLOAT && number != H5T_INTEGER) return;
  const Handle space(H5Dget_space(data.id()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  std::array<hsize_t, 2> size{1, 1};
  if (rank < 1 || rank > 2) return;
  H5Sget_simple_extent_dims(space.id(), size.data(), nullptr);
  if (size[0] == 0 || size[1] == 0 || size[0] > most.possible / size[1]) return;
  if (size[0] > most.left / size[1]) refuse_unpacked_numbers();
  refuse_numbers_elsewhere(data.id(), name);
  if (!is_usual_number(type.id())) {
    throw std::runtime_error(
        std::string("has an array '") + name +
        "' whose numbers are neither integers nor floats of 32 or 64 bits: the file is "
        "damaged or has a type of its own; save the array as 64-bit numbers");
  }
  most.left -= size[0] * size[1];
  std::vector<double> values(size[0] * size[1]);
  if (H5Dread(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    throw std::runtime_error(std::string("has an array '") + name +
                             "' that is damaged or packed by a filter that is not there; save it "
                             "again");
  }
  add_columns(values, size[0], size[1], name, columns);
}

// The numbers in a group; those of its own groups are tables of their own.
void read_group(hid_t group, const std::string& name, NumberLimit& most, int depth,
                ColumnsOfTables& tables) {
  constexpr int kDeepest = 4;
  H5G_info_t info{};
  if (H5Gget_info(group, &info) < 0) return;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    std::array<char, 256> text{};
    const ssize_t length = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i,
                                              text.data(), text.size(), H5P_DEFAULT);
    if (most.objects_left-- == 0) {
      throw std::runtime_error("has more than " + std::to_string(kMostHdf5Objects) +
                               " arrays and groups, the limit; save the measured columns alone");
    }
    const bool is_plain = length > 0 && static_cast<std::size_t>(length) < text.size();
    if (!is_plain || text[0] == '#') continue;  // "#refs#" of MATLAB
    H5L_info_t link{};
    if (H5Lget_info(group, text.data(), &link, H5P_DEFAULT) < 0) continue;
    if (link.type == H5L_TYPE_SOFT) continue;  // its array is read where it stands
    if (link.type != H5L_TYPE_HARD) refuse_other_file(std::string("'") + text.data() + "'");
    const Handle object(H5Oopen(group, text.data(), H5P_DEFAULT), H5Oclose);
    if (!object.is_open()) continue;
    const H5I_type_t kind = H5Iget_type(object.id());
    if (kind == H5I_DATASET) read_numbers(group, text.data(), most, tables[name]);
    if (kind == H5I_GROUP && depth < kDeepest) {
      read_group(object.id(), name.empty() ? text.data() : name + "/" + text.data(), most,
                 depth + 1, tables);
    }
  }
}

}  // namespace

void refuse_unpacked_numbers() {
  throw std::runtime_error(
      "holds more than " + std::to_string(kMostUnpackedNumbers) +
      " numbers once it is unpacked, the limit; save the measured columns alone");
}

void add_columns(const std::vector<double>& values, std::size_t rows, std::size_t width,
                 const std::string& name, std::vector<NamedColumn>& columns) {
  const bool lies_along_rows = rows < width;
  const std::size_t length = std::max(rows, width), n = std::min(rows, width);
  for (std::size_t c = 0; c < n; ++c) {
    NamedColumn column{n == 1 ? name : name + "_" + std::to_string(c + 1), {}};
    column.values.reserve(length);
    for (std::size_t i = 0; i < length; ++i) {
      column.values.push_back(values[lies_along_rows ? c * width + i : i * width + c]);
    }
    columns.push_back(std::move(column));
  }
}

bool is_hdf5_file(std::string_view bytes) {
  return bytes.starts_with("MATLAB 7.3 MAT-file") ||
         bytes.starts_with(std::string_view("\x89HDF\r\n\x1a\n", 8));
}

ColumnsOfTables columns_of_hdf5(std::string_view bytes, const std::string& name) {
  // Debian's library is not built for several threads.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // it prints nothing
  // The file stays in memory.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t kGrowth = 1U << 16;
  H5Pset_fapl_core(access.id(), kGrowth, 0);
  H5Pset_file_image(access.id(), const_cast<char*>(bytes.data()), bytes.size());
  const Handle file(H5Fopen("table", H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (!file.is_open()) throw std::runtime_error(name + ": is a damaged HDF5 file; save it again");
  ColumnsOfTables tables;
  // What is not packed takes as much memory as the file.
  NumberLimit most{kMostFromPacked * bytes.size() / sizeof(double),
                   std::max(kMostUnpackedNumbers, bytes.size())};
  read_group(file.id(), "", most, 0, tables);
  return tables;
}

}  // namespace viscard
