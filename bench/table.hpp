// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace lrrt::bench {

/// A table of text with aligned columns: the first to the left, the others to the right.
class Table {
 public:
  explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}

  /// Missing cells at the end stay empty.
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  /// Every line ends in a line feed.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// A number to three significant digits (two below 0.1), from five digits on thousands apart: "0.0123", "12.3", "1234",
/// "63 508"; "-" for NaN.
std::string short_number(double value);

/// A number with a fixed count of decimals; "-" for NaN.
std::string fixed_number(double value, int decimals);

/// A text as a CSV field (RFC 4180): in quotes, which are doubled inside.
std::string quoted(const std::string& text);

}  // namespace lrrt::bench
