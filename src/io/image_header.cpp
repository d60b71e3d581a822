// SPDX-License-Identifier: BSD-3-Clause
#include "image_header.hpp"

#include <cstddef>
#include <cstdlib>

namespace lrrt::detail {
namespace {

using std::literals::operator""sv;

std::int64_t byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

std::int64_t big_endian(std::string_view bytes, std::size_t at, std::size_t count) {
  std::int64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value * 256 + byte_at(bytes, at + i);
  return value;
}

std::int64_t little_endian(std::string_view bytes, std::size_t at, std::size_t count) {
  std::int64_t value = 0;
  for (std::size_t i = count; i > 0; --i) value = value * 256 + byte_at(bytes, at + i - 1);
  return value;
}

ImageHeader png_header(std::string_view bytes) {
  if (bytes.size() < 24) return {"PNG"};
  return {"PNG", big_endian(bytes, 16, 4), big_endian(bytes, 20, 4)};
}

ImageHeader bmp_header(std::string_view bytes) {
  if (bytes.size() < 26) return {"BMP"};
  const bool core = little_endian(bytes, 14, 4) == 12;  // the oldest header has 16-bit sides
  if (core) return {"BMP", little_endian(bytes, 18, 2), little_endian(bytes, 20, 2)};
  const auto height = static_cast<std::int32_t>(little_endian(bytes, 22, 4));  // negative: top row first
  return {"BMP", little_endian(bytes, 18, 4), std::abs(static_cast<std::int64_t>(height))};
}

bool is_start_of_frame(std::int64_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

/// Whether an end-of-image marker follows the last scan; neither marker can occur inside compressed data.
bool has_jpeg_end(std::string_view bytes) {
  const std::size_t scan = bytes.rfind("\xff\xda"sv);
  return scan != std::string_view::npos && bytes.find("\xff\xd9"sv, scan) != std::string_view::npos;
}

/// Hops from segment to segment up to the one that states the size.
ImageHeader jpeg_header(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 9 <= bytes.size() && byte_at(bytes, at) == 0xFF) {
    const std::int64_t marker = byte_at(bytes, at + 1);
    if (marker == 0xFF) {  // a fill byte before the marker
      ++at;
      continue;
    }
    if (is_start_of_frame(marker)) {
      return {"JPEG", big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2), has_jpeg_end(bytes)};
    }
    at += 2 + static_cast<std::size_t>(big_endian(bytes, at + 2, 2));
  }
  return {"JPEG"};
}

bool starts_with(std::string_view bytes, std::string_view magic) {
  return bytes.substr(0, magic.size()) == magic;
}

constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n"sv;

/// The data of a PNG's first chunk of a name; empty where there is none before the pixels.
std::string_view png_chunk(std::string_view bytes, std::string_view name) {
  std::size_t at = png_signature.size();
  while (at + 12 <= bytes.size() && bytes.substr(at + 4, 4) != "IDAT"sv) {
    const auto length = static_cast<std::size_t>(big_endian(bytes, at, 4));
    if (bytes.substr(at + 4, 4) == name) return bytes.substr(at + 8, length);
    at += 12 + length;
  }
  return {};
}

}  // namespace

std::optional<int> transparent_grey(std::string_view bytes) {
  if (!starts_with(bytes, png_signature)) return std::nullopt;
  const std::string_view header = png_chunk(bytes, "IHDR"sv);
  const std::string_view value = png_chunk(bytes, "tRNS"sv);
  const bool grey = header.size() == 13 && byte_at(header, 9) == 0;
  if (!grey || value.size() != 2) return std::nullopt;
  const std::int64_t depth = byte_at(header, 8);
  const std::int64_t sample = big_endian(value, 0, 2);
  if (depth == 16) return static_cast<int>(sample);
  if (depth < 1 || depth > 8) return std::nullopt;
  return static_cast<int>(sample * 255 / ((1 << depth) - 1));
}

std::optional<ImageHeader> read_image_header(std::string_view bytes) {
  if (starts_with(bytes, png_signature)) return png_header(bytes);
  if (starts_with(bytes, "BM"sv)) return bmp_header(bytes);
  if (starts_with(bytes, "\xff\xd8\xff"sv)) return jpeg_header(bytes);
  return std::nullopt;
}

}  // namespace lrrt::detail
