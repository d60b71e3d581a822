// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lrrt::detail {

/// What the first bytes of a compressed picture tell, without decoding it.
struct ImageHeader {
  const char* format = "";
  std::int64_t width = 0;
  std::int64_t height = 0;
  bool complete = true;  ///< false for a JPEG without an end marker, whose lost part decoders fill with grey
};

/// Format and size of a PNG, BMP or JPEG file; nothing for another format. A header that is cut off has size 0×0.
std::optional<ImageHeader> read_image_header(std::string_view bytes);

/// The value that stands for transparent in a PNG of greys, as decoders scale its pixels: to 8 bits, or 16. Nothing for
/// other pictures; what is transparent in those, decoders tell by an alpha channel.
std::optional<int> transparent_grey(std::string_view bytes);

}  // namespace lrrt::detail
