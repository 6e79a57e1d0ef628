#include "extract/pose/tflite/flatbuffer.h"

#include <cstdint>

namespace stride::tflite {
namespace {

/// Where the offset at a byte leads.
std::size_t followed(std::string_view bytes, std::size_t at) {
  return at + read_scalar<std::uint32_t>(bytes, at);
}

}  // namespace

FlatVector::FlatVector(std::string_view bytes, std::size_t at, std::size_t element_bytes)
    : bytes_(bytes), element_bytes_(element_bytes) {
  size_ = read_scalar<std::uint32_t>(bytes, at);
  first_ = at + 4;
  require(size_ <= (bytes.size() - first_) / element_bytes,
          "damaged: a list of {} at byte {} reaches past the end, {}", size_, at, bytes.size());
}

void FlatVector::check(std::size_t i) const {
  require(i < size_, "damaged: element {} of a list of {}", i, size_);
}

FlatTable FlatVector::table(std::size_t i) const {
  check(i);
  return {bytes_, followed(bytes_, first_ + 4 * i)};
}

FlatTable::FlatTable(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at) {
  const auto back = read_scalar<std::int32_t>(bytes, at);
  const std::int64_t fields = static_cast<std::int64_t>(at) - back;
  require(fields >= 0, "damaged: the table at byte {} has no field list", at);
  fields_ = static_cast<std::size_t>(fields);
  fields_bytes_ = read_scalar<std::uint16_t>(bytes, fields_);
}

std::optional<std::size_t> FlatTable::place(int field) const {
  const std::size_t entry = 4 + 2 * static_cast<std::size_t>(field);
  if (entry + 2 > fields_bytes_) return std::nullopt;
  const auto offset = read_scalar<std::uint16_t>(bytes_, fields_ + entry);
  if (offset == 0) return std::nullopt;
  return at_ + offset;
}

std::optional<FlatTable> FlatTable::table(int field) const {
  const std::optional<std::size_t> at = place(field);
  if (!at) return std::nullopt;
  return FlatTable(bytes_, followed(bytes_, *at));
}

FlatVector FlatTable::vector(int field, std::size_t element_bytes) const {
  const std::optional<std::size_t> at = place(field);
  return at ? FlatVector(bytes_, followed(bytes_, *at), element_bytes) : FlatVector();
}

FlatTable root_table(std::string_view bytes, std::string_view identifier) {
  require(bytes.size() >= 8 && bytes.substr(4, identifier.size()) == identifier,
          "is no flatbuffer of the kind \"{}\"", identifier);
  return {bytes, followed(bytes, 0)};
}

}  // namespace stride::tflite
