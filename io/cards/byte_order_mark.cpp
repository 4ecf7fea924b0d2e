#include "io/cards/byte_order_mark.h"

#include <string_view>

namespace viscard {

std::string without_byte_order_mark(const std::string& text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.substr(text.rfind(kMark, 0) == 0 ? kMark.size() : 0);
}

CardFinding byte_order_mark_finding(const CardTarget& target) {
  const std::string effect = target.reads_fortran_numbers
                                 ? target.code + " would read as a part of line 1"
                                 : "some readers take for text";
  return {"byte-order-mark",
          "the file begins with a byte order mark (U+FEFF), which " + effect +
              "; save it as UTF-8 without BOM",
          target.reads_fortran_numbers};
}

}  // namespace viscard
