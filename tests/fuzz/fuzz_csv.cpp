// Any bytes are read as a table or refused by one exception with a text.
#include "io/tables/column_map.h"
#include "io/tables/column_names.h"

#include <cstdint>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscard;
  try {
    const CsvTable table = csv_from_text({reinterpret_cast<const char*>(data), size}, "fuzz");
    for (const CsvColumn& column : table.columns) {
      if (column.values.size() != table.lines.size()) __builtin_trap();
      if (!column.text.empty() && column.text.size() != table.lines.size()) __builtin_trap();
    }
    for (const std::string& name : column_names()) {
      try {
        (void)column_text(table, name);
        (void)column_SI(table, name, {{name, "-2*1 [ms]"}});
      } catch (const std::runtime_error&) {
      }
    }
  } catch (const std::runtime_error&) {
  }
  return 0;
}
