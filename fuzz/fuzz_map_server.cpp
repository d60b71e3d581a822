// SPDX-License-Identifier: BSD-3-Clause
/// Input: a map_server YAML file. Beside it lie the pictures grey.pgm and colour.ppm, a folder and a FIFO.
#include <sys/stat.h>

#include "lrrt/io/read_map.hpp"
#include "lrrt/map/map_server.hpp"
#include "support.hpp"

namespace {

const lrrt::fuzz::Folder& folder() {
  static const lrrt::fuzz::Folder made;
  static const bool filled = [] {
    made.write("grey.pgm", std::string("P5 3 2 255\n\x00\x40\x80\xc0\xfe\xff", 17));
    made.write("colour.ppm", std::string("P6 1 2 255\n\x00\x40\x80\xc0\xfe\xff", 17));
    std::filesystem::create_directory(made.path() / "folder");
    mkfifo((made.path() / "fifo").c_str(), 0600);
    return true;
  }();
  lrrt::fuzz::require(filled, "the pictures are there");
  return made;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lrrt;
  const auto file = folder().write("map.yaml", fuzz::text_of(data, size));
  fuzz::answer_or_typed_error([&] {
    const OccupancyMap map = read_map(file);
    fuzz::require(map.resolution() > 0.0, "a pixel has a size");
    const Eigen::Vector2d back = map.to_pixel(map.to_world({0.5, 0.5}));
    fuzz::require(back.allFinite(), "the frame is finite");
  });
  return 0;
}
