// SPDX-License-Identifier: BSD-3-Clause
#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace lrrt::bench {
namespace {

constexpr std::size_t bar_width = 24;
constexpr double redraw_ms = 100.0;

/// Seconds as "0:07", "12:30" or "1:02:03".
std::string clock_text(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  char text[32];
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  }
  return text;
}

/// The beginning of a text, not cut inside a character of UTF-8.
std::string shortened(const std::string& text) {
  std::size_t end = std::min<std::size_t>(text.size(), 60);
  while (end < text.size() && end > 0 && (text[end] & 0xC0) == 0x80) --end;
  return text.substr(0, end);
}

}  // namespace

Progress::Progress(std::size_t done, std::size_t total, bool wanted)
    : before_(done), done_(done), total_(total), shown_(wanted && isatty(STDERR_FILENO) != 0) {
  draw("");
}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::step(const std::string& label) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++done_;
  draw(label);
}

void Progress::draw(const std::string& label) {
  const double now = watch_.total_ms();
  if (!shown_ || total_ == 0 || (now - drawn_at_ < redraw_ms && done_ < total_)) return;
  drawn_at_ = now;
  const std::size_t filled = bar_width * done_ / total_;
  std::string line = "\r\033[K" + std::string(filled, '#') + std::string(bar_width - filled, '.');
  line += "  " + std::to_string(done_) + "/" + std::to_string(total_);
  if (done_ > before_ && done_ < total_) {
    const double each = now / static_cast<double>(done_ - before_);
    line += "  " + clock_text(each * static_cast<double>(total_ - done_) * 1e-3) + " left";
  }
  line += "  " + shortened(label);
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace lrrt::bench
