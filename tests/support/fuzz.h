#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "extract/io/error.h"

namespace stride {

/// One input of libFuzzer: whatever the bytes, `read` reads them or throws Error.
template <typename Read>
int read_or_refuse(const std::uint8_t* bytes, std::size_t size, Read read) {
  try {
    read(std::string_view(reinterpret_cast<const char*>(bytes), size));
  } catch (const Error&) {
  }
  return 0;
}

}  // namespace stride
