#include "output/npy.hpp"

#include <bit>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace contensou::program {

std::string npy_header(const std::vector<long>& shape) {
  constexpr char byte_order = std::endian::native == std::endian::little ? '<' : '>';
  constexpr std::size_t preamble = 10;   // magic, version, length
  constexpr std::size_t alignment = 64;  // of the doubles
  std::string dictionary =
      fmt::format("{{'descr': '{}f8', 'fortran_order': False, 'shape': ({}), }}", byte_order, fmt::join(shape, ", "));
  const std::size_t used = preamble + dictionary.size() + 1;
  dictionary.append((alignment - used % alignment) % alignment, ' ') += '\n';
  const std::size_t length = dictionary.size();
  const char length_bytes[]{static_cast<char>(length & 0xFF), static_cast<char>(length >> 8)};
  return std::string("\x93NUMPY\x01\x00", 8) + std::string(length_bytes, 2) + dictionary;
}

}  // namespace contensou::program
