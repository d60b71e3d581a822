// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "lrrt/map/image.hpp"

namespace lrrt::detail {

/// True for the first bytes of a portable any-map, P1 to P6.
bool is_pnm(std::string_view bytes);

/// Decodes a portable bit-, grey- or pixmap, text (P1 to P3) or binary (P4 to P6), with any maximum up to 65535.
///
/// Own code instead of OpenCV's decoder, which scales by the maximum in some of these variants and not in others.
/// Values above the stated maximum count as the maximum; bytes after the first picture are ignored.
/// @throws MapError that names the file: broken header, too large, data cut off.
Image decode_pnm(std::string_view bytes, const std::string& source);

}  // namespace lrrt::detail
