// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <vector>

#include "../map/file_bytes.hpp"
#include "image_header.hpp"
#include "lrrt/error.hpp"
#include "lrrt/io/read_map.hpp"
#include "lrrt/map/read_map.hpp"
#include "pnm.hpp"

namespace lrrt {
namespace {

[[noreturn]] void fail_damaged(const std::string& source, const char* format, const std::string& why) {
  throw MapError(source + ": damaged " + format + " file (" + why + "); expected a complete picture; save it again");
}

std::uint8_t to_byte(std::uint8_t value) {
  return value;
}
std::uint8_t to_byte(std::uint16_t value) {
  return static_cast<std::uint8_t>((value + 128) / 257);
}

/// Copies a decoded matrix; OpenCV's channel order is B, G, R, alpha.
template <class Sample>
Image to_image(const cv::Mat& mat) {
  Image image{mat.cols, mat.rows, mat.channels(), {}};
  image.pixels.resize(mat.total() * static_cast<std::size_t>(mat.channels()));
  auto out = image.pixels.begin();
  const bool colors = image.channels >= 3;
  for (int r = 0; r < mat.rows; ++r) {
    const auto* row = mat.ptr<Sample>(r);
    for (int i = 0; i < mat.cols * image.channels; ++i) {
      const int channel = i % image.channels;
      *out++ = to_byte(row[colors && channel < 3 ? i + 2 - 2 * channel : i]);
    }
  }
  return image;
}

cv::Mat decode_with_opencv(std::string& bytes, const std::string& source, const char* format) {
  try {
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data());
    return cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
  } catch (const std::exception& error) {
    fail_damaged(source, format, error.what());
  }
}

/// OpenCV passes over the transparency of greys, which is no channel in the file.
cv::Mat with_alpha(const cv::Mat& greys, int transparent) {
  cv::Mat alpha = greys != transparent;
  if (greys.depth() == CV_16U) alpha.convertTo(alpha, CV_16U, 257.0);
  cv::Mat both;
  cv::merge(std::vector<cv::Mat>{greys, alpha}, both);
  return both;
}

}  // namespace

Image decode_image(const std::filesystem::path& path) {
  const std::string source = path.string();
  std::string bytes = detail::read_bytes(path);
  if (detail::is_pnm(bytes)) return detail::decode_pnm(bytes, source);
  const auto header = detail::read_image_header(bytes);
  if (!header) {
    throw MapError(source +
                   ": not a picture that can be read; expected PNG, PGM, PPM, PBM, BMP or JPEG (or a map_server " +
                   ".yaml, or a MovingAI .map that begins with 'type octile'); convert it to PNG");
  }
  check_map_size(header->width, header->height, source);
  if (!header->complete) fail_damaged(source, header->format, "it is cut off");
  cv::Mat mat = decode_with_opencv(bytes, source, header->format);
  const std::optional<int> transparent = detail::transparent_grey(bytes);
  if (transparent && mat.channels() == 1) mat = with_alpha(mat, *transparent);
  if (mat.empty()) fail_damaged(source, header->format, "its pixels cannot be decoded");
  if (mat.depth() == CV_8U) return to_image<std::uint8_t>(mat);
  if (mat.depth() == CV_16U) return to_image<std::uint16_t>(mat);
  fail_damaged(source, header->format, "neither 8 nor 16 bits per channel");
}

OccupancyMap read_map(const std::filesystem::path& path) {
  return read_map(path, decode_image);
}

}  // namespace lrrt
