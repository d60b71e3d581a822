// SPDX-License-Identifier: BSD-3-Clause
/// Input: a picture file.
#include "lrrt/io/read_map.hpp"
#include "support.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lrrt;
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
