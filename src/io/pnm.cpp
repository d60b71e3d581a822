// SPDX-License-Identifier: BSD-3-Clause
#include "pnm.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "lrrt/error.hpp"

namespace lrrt::detail {
namespace {

constexpr int max_sample = 65535;

bool is_blank(char letter) {
  return letter == ' ' || (letter >= '\t' && letter <= '\r');
}
bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

/// Reads the numbers and bytes of one any-map from front to back.
class Reader {
 public:
  Reader(std::string_view bytes, std::string source) : rest_(bytes), source_(std::move(source)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw MapError(source_ + ": damaged PBM/PGM/PPM file: " + what + "; save the picture again, or as PNG");
  }

  /// Whole number in text form, after blanks and comments.
  int number(const std::string& what, int largest) {
    skip_blanks();
    if (rest_.empty()) fail("it ends where " + what + " is expected");
    if (!is_digit(rest_.front())) fail(what + " is not a whole number");
    std::int64_t value = 0;
    for (; !rest_.empty() && is_digit(rest_.front()); rest_.remove_prefix(1)) {
      value = value * 10 + (rest_.front() - '0');
      if (value > largest) fail(what + " is above " + std::to_string(largest));
    }
    return static_cast<int>(value);
  }

  /// One digit of a text bitmap, where blanks between digits may be left out.
  bool bit() {
    skip_blanks();
    if (rest_.empty()) fail("it ends where a pixel is expected");
    const char digit = rest_.front();
    if (digit != '0' && digit != '1') fail("a pixel of a bitmap is neither 0 nor 1");
    rest_.remove_prefix(1);
    return digit == '1';
  }

  /// The bytes after the single blank that ends a binary header.
  std::string_view raster(std::size_t size) {
    if (rest_.empty() || !is_blank(rest_.front())) fail("no blank between header and pixels");
    rest_.remove_prefix(1);
    if (rest_.size() < size) {
      fail(std::to_string(rest_.size()) + " bytes of pixels where " + std::to_string(size) + " are expected");
    }
    return rest_.substr(0, size);
  }

  /// Refuses a text file that is too short for its pixels, before memory is taken for them.
  void require_at_least(std::size_t bytes) const {
    if (rest_.size() < bytes) fail("too few pixels for the size in its header");
  }

 private:
  void skip_blanks() {
    while (!rest_.empty() && (is_blank(rest_.front()) || rest_.front() == '#')) {
      if (rest_.front() == '#') {
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
      } else {
        rest_.remove_prefix(1);
      }
    }
  }

  std::string_view rest_;
  std::string source_;
};

std::uint8_t scaled(int sample, int maximum) {
  return static_cast<std::uint8_t>((std::min(sample, maximum) * 255 + maximum / 2) / maximum);
}

std::size_t samples_of(const Image& image) {
  return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
         static_cast<std::size_t>(image.channels);
}

void read_text_bits(Reader& reader, Image& image) {
  reader.require_at_least(samples_of(image));
  image.pixels.resize(samples_of(image));
  for (auto& pixel : image.pixels) pixel = reader.bit() ? 0 : 255;
}

void read_binary_bits(Reader& reader, Image& image) {
  const auto width = static_cast<std::size_t>(image.width);
  const std::size_t row_bytes = (width + 7) / 8;
  const auto raster = reader.raster(row_bytes * static_cast<std::size_t>(image.height));
  image.pixels.resize(samples_of(image));
  for (std::size_t row = 0; row < static_cast<std::size_t>(image.height); ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const auto byte = static_cast<unsigned char>(raster[row * row_bytes + column / 8]);
      image.pixels[row * width + column] = (byte >> (7 - column % 8) & 1) != 0 ? 0 : 255;  // a set bit is black
    }
  }
}

void read_text_samples(Reader& reader, Image& image, int maximum) {
  reader.require_at_least(samples_of(image) * 2 - 1);
  image.pixels.resize(samples_of(image));
  for (auto& pixel : image.pixels) pixel = scaled(reader.number("a pixel", max_sample), maximum);
}

void read_binary_samples(Reader& reader, Image& image, int maximum) {
  const std::size_t bytes = maximum > 255 ? 2 : 1;
  const auto raster = reader.raster(samples_of(image) * bytes);
  image.pixels.resize(samples_of(image));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    int sample = static_cast<unsigned char>(raster[i * bytes]);
    if (bytes == 2) sample = sample * 256 + static_cast<unsigned char>(raster[2 * i + 1]);  // most significant first
    image.pixels[i] = scaled(sample, maximum);
  }
}

}  // namespace

bool is_pnm(std::string_view bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
         (is_blank(bytes[2]) || bytes[2] == '#');
}

Image decode_pnm(std::string_view bytes, const std::string& source) {
  const char kind = bytes[1];
  Reader reader(bytes.substr(2), source);
  Image image;
  image.width = reader.number("the width", static_cast<int>(max_map_pixels));
  image.height = reader.number("the height", static_cast<int>(max_map_pixels));
  image.channels = kind == '3' || kind == '6' ? 3 : 1;
  check_map_size(image.width, image.height, source);
  if (kind == '1' || kind == '4') {
    kind == '1' ? read_text_bits(reader, image) : read_binary_bits(reader, image);
    return image;
  }
  const int maximum = reader.number("the largest value", max_sample);
  if (maximum == 0) reader.fail("the largest value is 0");
  kind <= '3' ? read_text_samples(reader, image, maximum) : read_binary_samples(reader, image, maximum);
  return image;
}

}  // namespace lrrt::detail
