// SPDX-License-Identifier: GPL-3.0-or-later
// Time, host and checksums.
#include "mortise/store/provenance.hpp"

#include <openssl/evp.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>

#include "mortise/core/errors.hpp"
#include "mortise/core/version.hpp"

namespace mortise {

Provenance make_provenance(const std::string& command_line, const std::string& options_json,
                           std::uint64_t seed) {
  Provenance result;
  result.mortise_version = kVersion;
  result.command_line = command_line;
  std::error_code ignored;
  result.working_directory = std::filesystem::current_path(ignored).string();
  result.options_json = options_json;
  result.seed = seed;
  result.utc_time = utc_now();
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) == 0) result.host = host.data();
  return result;
}

std::string utc_now() {
  std::time_t now = std::time(nullptr);
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH"); epoch != nullptr && *epoch != '\0') {
    const std::string text = epoch;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), now);
    if (error != std::errc() || end != text.data() + text.size() || now < 0)
      throw InputError("SOURCE_DATE_EPOCH: expected seconds since 1970, got \"" + text + "\"");
  }
  std::tm utc{};
  std::array<char, 64> buffer{};
  if (gmtime_r(&now, &utc) == nullptr ||
      std::strftime(buffer.data(), buffer.size(), "%Y-%m-%dT%H:%M:%SZ", &utc) == 0)
    throw InputError("SOURCE_DATE_EPOCH: time out of range");
  return buffer.data();
}

std::string sha256_of_file(const std::string& path) {
  if (std::filesystem::is_directory(path))
    throw FileError(path, "expected a file, found a directory");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(path, "cannot be opened: missing or not readable");
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                        &EVP_MD_CTX_free);
  if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("sha256_of_file: the SHA-256 of libcrypto is not available");
  std::array<char, 1 << 16> buffer;
  while (in) {
    in.read(buffer.data(), buffer.size());
    EVP_DigestUpdate(context.get(), buffer.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) throw FileError(path, "reading failed");
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  EVP_DigestFinal_ex(context.get(), digest.data(), &size);
  std::string hex;
  for (unsigned int i = 0; i < size; ++i) {
    hex += "0123456789abcdef"[digest[i] >> 4];
    hex += "0123456789abcdef"[digest[i] & 15];
  }
  return hex;
}

}  // namespace mortise
