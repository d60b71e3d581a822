// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include "lrrt/error.hpp"
#include "lrrt/io/read_map.hpp"

namespace lrrt {
namespace {

/// Pixels in OpenCV's order B, G, R, alpha; grey + alpha becomes four channels, since OpenCV writes no two-channel PNG.
cv::Mat to_mat(const Image& image) {
  const int channels = image.channels == 2 ? 4 : image.channels;
  cv::Mat mat(image.height, image.width, CV_8UC(channels));
  const std::uint8_t* pixel = image.pixels.data();
  for (int r = 0; r < mat.rows; ++r) {
    auto* out = mat.ptr<std::uint8_t>(r);
    for (int c = 0; c < mat.cols; ++c, pixel += image.channels, out += channels) {
      const bool grey = image.channels < 3;
      for (int k = 0; k < channels && k < 3; ++k) out[k] = pixel[grey ? 0 : 2 - k];
      if (image.has_alpha()) out[3] = pixel[image.color_channels()];
    }
  }
  return mat;
}

std::vector<std::uint8_t> encode(const Image& image, const std::string& target) {
  std::vector<std::uint8_t> bytes;
  try {
    if (cv::imencode(".png", to_mat(image), bytes)) return bytes;
  } catch (const cv::Exception& error) {
    throw MapError(target + ": the picture cannot be encoded as PNG (" + error.what() + ")");
  }
  throw MapError(target + ": the picture cannot be encoded as PNG");
}

/// A name beside the target that no other writer uses.
std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  std::filesystem::path name = path;
  name += "." + std::to_string(std::random_device{}()) + ".tmp";
  return name;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image) {
  check_image(image);
  const auto bytes = encode(image, path.string());
  const auto temporary = temporary_beside(path);
  std::error_code error;
  {
    std::ofstream stream(temporary, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) error = std::make_error_code(std::errc::io_error);
  }
  if (!error) std::filesystem::rename(temporary, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw MapError(path.string() + ": cannot be written (" + error.message() +
                   "); expected a folder that exists and is writable, and free space");
  }
}

}  // namespace lrrt
