#include "extract/io/file.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>

#include "extract/io/csv.h"
#include "extract/io/error.h"

namespace stride {
namespace fs = std::filesystem;
namespace {

std::ifstream open_for_reading(const fs::path& file) {
  require(fs::exists(file), "{}: no such file", file.string());
  require(!fs::is_directory(file), "{}: is a folder, a file is needed", file.string());
  require(!fs::is_fifo(file), "{}: is a pipe, a file is needed", file.string());
  std::ifstream in(file, std::ios::binary);
  require(in.good(), "{}: cannot be read ({})", file.string(), std::strerror(errno));
  return in;
}

/// A file being written, removed again unless it was committed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target)
      : target_(target), path_(fmt::format("{}.tmp{}", target.string(), ::getpid())) {
    descriptor_ = ::open(path_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0644);
    if (descriptor_ < 0) fail("cannot be created");
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!committed_) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail("cannot be written");
      content.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void commit() {
    if (::fsync(descriptor_) != 0) fail("cannot be flushed to disk");
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail("cannot be replaced");
    committed_ = true;
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw Error(fmt::format("{}: {} ({})", target_.string(), what, std::strerror(errno)));
  }

  fs::path target_;
  std::string path_;
  int descriptor_ = -1;
  bool committed_ = false;
};

}  // namespace

std::string read_file(const fs::path& file) {
  std::ifstream in = open_for_reading(file);
  std::ostringstream content;
  content << in.rdbuf();
  require(!in.bad(), "{}: cannot be read ({})", file.string(), std::strerror(errno));
  return std::move(content).str();
}

void write_file_atomically(const fs::path& file, std::string_view content) {
  if (file.has_parent_path()) {
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    require(!error, "{}: its folder cannot be created ({})", file.string(), error.message());
  }
  require(!fs::is_directory(file), "{}: is a folder: name a file in it", file.string());
  if (fs::exists(file) && !fs::is_regular_file(file)) {  // /dev/stdout is written, not replaced
    std::ofstream out(file, std::ios::binary);
    out << content << std::flush;
    require(out.good(), "{}: cannot be written ({})", file.string(), std::strerror(errno));
    return;
  }
  TemporaryFile temporary(file);
  temporary.write(content);
  temporary.commit();
}

namespace {

/// SHA-256 in steps.
class Digest {
 public:
  Digest() { EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr); }
  void add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned int size = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    std::string text;
    for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_{EVP_MD_CTX_new(),
                                                                   &EVP_MD_CTX_free};
};

}  // namespace

std::string sha256_of_file(const fs::path& file) {
  std::ifstream in = open_for_reading(file);
  Digest digest;
  std::array<char, 1 << 16> block;
  while (in.read(block.data(), block.size()) || in.gcount() > 0)
    digest.add({block.data(), static_cast<std::size_t>(in.gcount())});
  return digest.hex();
}

std::string sha256_of(std::string_view content) {
  Digest digest;
  digest.add(content);
  return digest.hex();
}

std::string base64_of(std::string_view content) {
  std::string text(4 * ((content.size() + 2) / 3) + 1, '\0');  // and the zero that OpenSSL adds
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                  reinterpret_cast<const unsigned char*>(content.data()),
                  static_cast<int>(content.size()));
  text.pop_back();
  return text;
}

}  // namespace stride
