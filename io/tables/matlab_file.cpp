#include "io/tables/matlab_file.h"

#include "io/basics/number_text.h"
#include "io/basics/words.h"
#include "io/tables/hdf5_file.h"

#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

// The library opens files by name only; this one is in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : descriptor_(::memfd_create("matlab", MFD_CLOEXEC)) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written <= 0) throw std::runtime_error("there is no memory for the MATLAB file");
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(descriptor_); }

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

bool is_level_5(std::string_view bytes) {
  return bytes.starts_with("MATLAB 5.0 MAT-file");
}

// Level 4 has no mark: every variable has a head of five numbers, a name and its data, and the last one
// ends with the file (MathWorks, "MAT-File Format", the chapter on level 4).
bool is_level_4(std::string_view bytes) {
  constexpr std::size_t kHead = 20;
  constexpr std::size_t kSizes[] = {8, 4, 4, 2, 2, 1};  // of a number, by its type
  constexpr std::uint32_t kMost = 1U << 30, kLongestName = 256;
  if (bytes.size() <= kHead) return false;
  for (std::string_view rest = bytes; !rest.empty();) {
    if (rest.size() < kHead) return false;
    std::uint32_t head[5];
    std::memcpy(head, rest.data(), kHead);
    const bool is_swapped = head[0] > 0xffff;
    if (is_swapped) {
      for (std::uint32_t& word : head) word = __builtin_bswap32(word);
    }
    const auto [type, rows, columns, is_complex, name_length] = head;
    const std::uint32_t order = type / 1000, number = type / 10 % 10, matrix = type % 10;
    const bool is_known = order == (is_swapped ? 1U : 0U) && type / 100 % 10 == 0 && number < 6 &&
                          matrix < 3 && is_complex < 2;
    const bool is_sized =
        rows <= kMost && columns <= kMost && name_length > 1 && name_length <= kLongestName;
    if (!is_known || !is_sized) return false;
    const std::size_t count = std::size_t{rows} * columns * (is_complex + 1);
    if (count > rest.size()) return false;
    const std::size_t length = kHead + name_length + count * kSizes[number];
    if (length > rest.size() || rest[kHead + name_length - 1] != '\0') return false;
    rest.remove_prefix(length);
  }
  return true;
}

struct CloseMatlab {
  void operator()(mat_t* file) const { Mat_Close(file); }
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatlabFile = std::unique_ptr<mat_t, CloseMatlab>;
using MatlabVariable = std::unique_ptr<matvar_t, CloseMatlab>;

template <typename Number>
std::vector<double> as_doubles(const void* data, std::size_t count) {
  const auto* begin = static_cast<const Number*>(data);
  return {begin, begin + count};
}

// The numbers column by column; empty if they are not real numbers.
std::vector<double> numbers_of(const matvar_t& variable, std::size_t count) {
  if (variable.data == nullptr || variable.isComplex != 0 || variable.isLogical != 0) return {};
  if (variable.nbytes < count * static_cast<std::size_t>(variable.data_size)) return {};
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      return as_doubles<double>(variable.data, count);
    case MAT_T_SINGLE:
      return as_doubles<float>(variable.data, count);
    case MAT_T_INT8:
      return as_doubles<std::int8_t>(variable.data, count);
    case MAT_T_UINT8:
      return as_doubles<std::uint8_t>(variable.data, count);
    case MAT_T_INT16:
      return as_doubles<std::int16_t>(variable.data, count);
    case MAT_T_UINT16:
      return as_doubles<std::uint16_t>(variable.data, count);
    case MAT_T_INT32:
      return as_doubles<std::int32_t>(variable.data, count);
    case MAT_T_UINT32:
      return as_doubles<std::uint32_t>(variable.data, count);
    default:
      return {};
  }
}

bool is_numeric(const matvar_t& variable) {
  return variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT32;
}

// The numbers of a matrix, row by row.
void add_columns(const matvar_t& variable, const std::string& name,
                 std::vector<NamedColumn>& columns) {
  if (!is_numeric(variable) || variable.rank != 2) return;
  const std::size_t rows = variable.dims[0], width = variable.dims[1];
  constexpr std::size_t kMost = std::size_t{1} << 31;
  if (rows == 0 || width == 0 || rows > kMost / width) return;
  const std::vector<double> values = numbers_of(variable, rows * width);
  // The file has them column by column.
  if (!values.empty()) add_columns(values, width, rows, name, columns);
}

// Names and contents of the first element's fields. A damaged struct has names without data, which the library
// would read all the same.
std::vector<std::pair<std::string, matvar_t*>> fields_of(matvar_t& variable) {
  std::vector<std::pair<std::string, matvar_t*>> fields;
  char* const* names = Mat_VarGetStructFieldnames(&variable);
  if (names == nullptr || variable.data == nullptr) return fields;
  for (unsigned i = 0; i < Mat_VarGetNumberOfFields(&variable); ++i) {
    matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, i, 0);
    if (field != nullptr && names[i] != nullptr) fields.emplace_back(names[i], field);
  }
  return fields;
}

void add_fields(matvar_t& variable, std::vector<NamedColumn>& columns) {
  for (const auto& [name, field] : fields_of(variable)) add_columns(*field, name, columns);
}

// True if a variable, or a field of it, claims more numbers than the file has bytes: the library
// would ask for their memory before it reads them. A sparse matrix has fewer than its size.
bool claims_too_much(matvar_t& variable, std::size_t n_bytes) {
  if (variable.class_type == MAT_C_SPARSE) return false;
  std::size_t left = n_bytes;
  for (int i = 0; i < variable.rank && left > 0; ++i) {
    left /= std::max<std::size_t>(variable.dims[i], 1);
  }
  if (left == 0) return true;
  if (variable.class_type != MAT_C_STRUCT) return false;
  const auto fields = fields_of(variable);
  return std::any_of(fields.begin(), fields.end(),
                     [&](const auto& named) { return claims_too_much(*named.second, n_bytes); });
}

bool claims_too_much(mat_t* file, std::size_t n_bytes) {
  while (const MatlabVariable variable{Mat_VarReadNextInfo(file)}) {
    if (claims_too_much(*variable, n_bytes)) return true;
  }
  return Mat_Rewind(file) != 0;
}

ColumnsOfTables columns_of_tables(std::string_view bytes, const std::string& name) {
  // A damaged file is reported once, by the first missing part.
  Mat_LogInitFunc("viscard", [](int, char*) {});
  if (is_hdf5_file(bytes)) return columns_of_hdf5(bytes, name);
  std::string unpacked = is_level_5(bytes) ? unpacked_matlab_file(bytes) : std::string(bytes);
  const std::size_t n_bytes = unpacked.size();
  const MemoryFile memory(unpacked);
  std::string().swap(unpacked);
  const MatlabFile file(Mat_Open(memory.path().c_str(), MAT_ACC_RDONLY));
  if (n_bytes == 0 || !file || claims_too_much(file.get(), n_bytes)) {
    throw std::runtime_error(name + ": is a damaged MATLAB file; save it again");
  }
  ColumnsOfTables tables;
  while (const MatlabVariable variable{Mat_VarReadNext(file.get())}) {
    if (variable->name == nullptr) continue;
    const bool is_struct = variable->class_type == MAT_C_STRUCT && variable->rank == 2 &&
                           variable->dims[0] == 1 && variable->dims[1] == 1;
    if (is_struct) {
      add_fields(*variable, tables[variable->name]);
    } else {
      add_columns(*variable, variable->name, tables[""]);
    }
  }
  return tables;
}

// The same with the file in front of every message.
ColumnsOfTables named_columns_of_tables(std::string_view bytes, const std::string& name) {
  try {
    return columns_of_tables(bytes, name);
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    if (text.starts_with(name)) throw;
    throw std::runtime_error(name + ": " + text);
  }
}

// Keeps the columns of that length that holds most numbers.
void keep_one_length(std::vector<NamedColumn>& columns) {
  std::map<std::size_t, std::size_t> numbers;
  for (const NamedColumn& column : columns) {
    if (column.values.size() > 1) numbers[column.values.size()] += column.values.size();
  }
  const auto most =
      std::max_element(numbers.begin(), numbers.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  const std::size_t length = most == numbers.end() ? 0 : most->first;
  std::erase_if(columns, [&](const NamedColumn& column) { return column.values.size() != length; });
}

std::string text_of_columns(const std::vector<NamedColumn>& columns) {
  std::string text;
  for (const NamedColumn& column : columns) text += (text.empty() ? "" : "\t") + column.name;
  text += '\n';
  for (std::size_t row = 0; row < columns.front().values.size(); ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (c > 0) text += '\t';
      text += text_from_number(columns[c].values[row]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

bool is_matlab_file(std::string_view bytes) {
  return is_level_5(bytes) || is_hdf5_file(bytes) || is_level_4(bytes);
}

SheetText matlab_table_text(std::string_view bytes, const std::string& name,
                            const std::string& table) {
  ColumnsOfTables tables = named_columns_of_tables(bytes, name);
  for (auto& [key, columns] : tables) keep_one_length(columns);
  std::erase_if(tables, [](const auto& entry) { return entry.second.empty(); });
  if (tables.empty()) {
    throw std::runtime_error(
        name +
        ": has no vector or matrix of real numbers, of its own or in a struct or "
        "group; export the measured columns as CSV");
  }
  const auto numbers = [](const auto& entry) {
    return entry.second.size() * entry.second.front().values.size();
  };
  auto chosen = std::max_element(tables.begin(), tables.end(), [&](const auto& a, const auto& b) {
    return numbers(a) < numbers(b);
  });
  if (!table.empty()) chosen = tables.find(table);
  if (chosen == tables.end()) {
    std::vector<std::string> names;
    for (const auto& entry : tables) {
      if (!entry.first.empty()) names.push_back(entry.first);
    }
    throw std::runtime_error(name + ": " + no_such_word("struct", table, names));
  }
  return {chosen->first, text_of_columns(chosen->second), tables.size()};
}

}  // namespace viscard
