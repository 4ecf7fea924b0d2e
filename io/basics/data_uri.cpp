#include "io/basics/data_uri.h"

#include "io/basics/atomic_file.h"

#include <openssl/evp.h>

#include <stdexcept>
#include <system_error>

namespace viscard {
namespace {

constexpr std::uintmax_t kLargest_B = std::uintmax_t{1} << 20;

std::string media_type(const std::string& bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
  if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
  const std::string head = bytes.substr(0, 1000);
  const bool is_text = head.find('\0') == std::string::npos;
  return is_text && head.find("<svg") != std::string::npos ? "image/svg+xml" : "";
}

std::string base64(const std::string& bytes) {
  std::string out(4 * ((bytes.size() + 2) / 3) + 1, '\0');  // OpenSSL ends it with a zero
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(out.data()),
                                     reinterpret_cast<const unsigned char*>(bytes.data()),
                                     static_cast<int>(bytes.size()));
  out.resize(static_cast<std::size_t>(length));
  return out;
}

}  // namespace

std::string data_uri_of_picture(const std::filesystem::path& path) {
  std::error_code unknown;
  const std::uintmax_t size_B = std::filesystem::file_size(path, unknown);
  if (!unknown && size_B > kLargest_B) {
    throw std::runtime_error(path.string() + ": is larger than 1 MiB, the limit of a logo");
  }
  const std::string bytes = read_file(path);
  const std::string type = media_type(bytes);
  if (type.empty()) {
    throw std::runtime_error(path.string() +
                             ": is no picture that a page can hold; a logo is a PNG, "
                             "JPEG or SVG file");
  }
  return "data:" + type + ";base64," + base64(bytes);
}

}  // namespace viscard
