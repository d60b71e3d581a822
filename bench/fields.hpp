// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lrrt/error.hpp"

namespace lrrt::bench {

/// A suite that cannot be read or makes no sense. The text names file, line and key, the value and what was expected.
class SuiteError : public Error {
 public:
  using Error::Error;
};

/// What a number has to be, and how to say so.
struct NumberRule {
  double least;
  double most;
  const char* expected;
};

/// A seed from its decimal digits, zeros before them allowed; nothing for any other text and above 2^64 - 1.
std::optional<std::uint64_t> seed_from_string(const std::string& text);

/// The fields of one YAML mapping, read with errors that name file, line, key, value and expectation.
///
/// Every getter takes a fallback for a key that is missing; require() refuses that first.
class Fields {
 public:
  /// @param place the way to this mapping, e.g. "maps[2]"; empty at the top.
  /// @throws SuiteError when the node is no mapping.
  Fields(const YAML::Node& node, std::string file, std::string place);

  /// @throws SuiteError for a key that is not in the list, when the text lists the known ones, or is there twice.
  void allow_only(const std::vector<std::string>& known) const;
  /// @throws SuiteError when the key is missing.
  void require(const std::string& key, const std::string& expected) const;
  bool has(const std::string& key) const { return static_cast<bool>(node_[key]); }
  bool is_list(const std::string& key) const { return has(key) && node_[key].IsSequence(); }

  std::string text(const std::string& key, const std::string& fallback) const;
  std::string word(const std::string& key, const std::string& fallback, const std::vector<std::string>& known) const;
  bool flag(const std::string& key, bool fallback) const;
  double number(const std::string& key, double fallback, const NumberRule& rule) const;
  /// A whole number.
  std::int64_t count(const std::string& key, std::int64_t fallback, const NumberRule& rule) const;
  /// Decimal digits, as seed_from_string() reads them.
  std::uint64_t seed(const std::string& key, std::uint64_t fallback) const;

  /// One value or a list of them.
  std::vector<std::string> texts(const std::string& key, const std::vector<std::string>& fallback) const;
  std::vector<bool> flags(const std::string& key, const std::vector<bool>& fallback) const;
  std::vector<double> numbers(const std::string& key, const std::vector<double>& fallback,
                              const NumberRule& rule) const;
  std::vector<int> counts(const std::string& key, const std::vector<int>& fallback, const NumberRule& rule) const;
  /// Points of the plane, a list of [x, y]; none when the key is missing.
  std::vector<Eigen::Vector2d> points(const std::string& key) const;
  /// The mappings in a list; none when the key is missing.
  std::vector<Fields> children(const std::string& key) const;

  /// Says that a value is not as expected. @throws SuiteError always.
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const;
  /// Says that the mapping as a whole is wrong. @throws SuiteError always.
  [[noreturn]] void refuse_all(const std::string& problem) const;

 private:
  std::vector<YAML::Node> items(const std::string& key, const char* expected) const;
  double number_in(const YAML::Node& node, const std::string& key, const NumberRule& rule) const;
  std::string where(const YAML::Node& node) const;
  std::string path_of(const std::string& key) const { return place_.empty() ? key : place_ + "." + key; }

  YAML::Node node_;
  std::string file_;
  std::string place_;
};

}  // namespace lrrt::bench
