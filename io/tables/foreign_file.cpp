#include "io/tables/foreign_file.h"

#include "io/basics/file_kind.h"

#include <stdexcept>

namespace viscard {
namespace {

struct Magic {
  std::string_view bytes;
  const char* what;
};

using namespace std::string_view_literals;
constexpr const char* kSaveSheet = "no readable Excel workbook; save its sheet as CSV";
constexpr Magic kMagic[] = {
    {"\x89PNG\r\n"sv, "a PNG picture, not a table"},
    {"\xff\xd8\xff"sv, "a JPEG picture, not a table"},
    {"GIF8"sv, "a GIF picture, not a table"},
    {"II*\0"sv, "a TIFF picture, not a table"},
    {"MM\0*"sv, "a TIFF picture, not a table"},
    {"%PDF-"sv, "a PDF document, not a table; export the numbers as CSV"},
    {"\xd0\xcf\x11\xe0"sv,
     "an old Office document (.xls), not text; save its sheet as .xlsx or CSV"},
    {"\x1f\x8b"sv, "compressed with gzip; unpack it first"},
    {"<svg"sv, "an SVG picture, not a table"}};

}  // namespace

void refuse_foreign_file(std::string_view bytes, const std::string& name) {
  for (const Magic& magic : kMagic) {
    if (bytes.substr(0, magic.bytes.size()) == magic.bytes) {
      throw std::runtime_error(name + ": is " + magic.what);
    }
  }
  const std::string_view head = bytes.substr(0, 4096);
  if (head.substr(0, 4) == "PK\x03\x04") {
    const bool is_sheet = bytes.find("xl/worksheets") != std::string_view::npos;
    throw std::runtime_error(
        name + ": is " + (is_sheet ? kSaveSheet : "a zip archive, not a table; unpack it first"));
  }
  const std::string_view first = head.substr(0, head.find('\n'));
  if (first.find("Calc_Ramp_Ex_nm") != std::string_view::npos &&
      first.find("ime") == std::string_view::npos) {
    throw std::runtime_error(
        name +
        ": is a force curve that NanoScope exported, which has no times; add columns time_s (the "
        "ramp over its speed), force_N (deflection times sensitivity and spring constant) and "
        "depth_m");
  }
  // Makers' tables may have sections and keys above their numbers.
  const FileKind kind = kind_of_file(head);
  const bool is_database = kind == FileKind::kCapture || kind == FileKind::kStudyAnswers;
  const std::string_view text = head.substr(head.starts_with("\xef\xbb\xbf") ? 3 : 0);
  const bool is_page = kind == FileKind::kPage;
  if (!is_database && !is_page && !is_json_kind(kind) && !is_toml(text)) return;
  const std::string use = use_of_file_kind(kind);
  throw std::runtime_error(name + ": is " + file_kind_in_words(kind) + ", not a table; " +
                           (use.empty() ? "export the measured columns as text" : use));
}

}  // namespace viscard
