// SPDX-License-Identifier: BSD-3-Clause
/// Input: a picture file.
#include "io/image_header.hpp"
#include "lrrt/io/read_map.hpp"
#include "support.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lrrt;
  // A few bytes may stand for many pixels of one colour: seconds under the sanitizers, and nothing new.
  constexpr std::int64_t most_pixels = 1 << 22;
  const auto header = detail::read_image_header({reinterpret_cast<const char*>(data), size});
  if (header && header->height > 0 && header->width > most_pixels / header->height &&
      header->width < (std::int64_t{1} << 28) / header->height) {
    return 0;
  }
  static const fuzz::Folder folder;
  const auto file = folder.write("picture", fuzz::text_of(data, size));
  fuzz::answer_or_typed_error([&] {
    const Image image = decode_image(file);
    check_image(image);
    const OccupancyMap map = map_from_image(image);
    fuzz::require(map.width() == image.width && map.height() == image.height, "a map is as large as its picture");
  });
  return 0;
}
