#include "io/basics/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace viscard {

struct Sha256::Context {
  EVP_MD_CTX* of_openssl = EVP_MD_CTX_new();
  Context() = default;
  ~Context() { EVP_MD_CTX_free(of_openssl); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

namespace {

void require(bool is_done) {
  if (is_done) return;
  throw std::runtime_error("SHA-256 failed in OpenSSL; check the installation of libssl");
}

}  // namespace

Sha256::Sha256() : context_(std::make_unique<Context>()) {
  require(EVP_DigestInit_ex(context_->of_openssl, EVP_sha256(), nullptr) == 1);
}
Sha256::~Sha256() = default;

void Sha256::add(const char* bytes, std::size_t n_bytes) {
  require(EVP_DigestUpdate(context_->of_openssl, bytes, n_bytes) == 1);
}

std::string Sha256::digits() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  require(EVP_DigestFinal_ex(context_->of_openssl, digest.data(), &size) == 1);
  constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (unsigned int i = 0; i < size; ++i) {
    out += kDigits[digest[i] >> 4];
    out += kDigits[digest[i] & 15];
  }
  return out;
}

std::string sha256_of_text(const std::string& contents) {
  Sha256 sum;
  sum.add(contents.data(), contents.size());
  return sum.digits();
}

}  // namespace viscard
