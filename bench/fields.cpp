// SPDX-License-Identifier: BSD-3-Clause
#include "fields.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace lrrt::bench {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string result;
  for (const std::string& word : words) result += (result.empty() ? "" : ", ") + word;
  return result;
}

/// A value as it stands in the file, on one line and not too long.
std::string shown(const YAML::Node& node) {
  if (node.IsNull()) return "empty";
  constexpr std::size_t longest = 60;
  YAML::Emitter emitter;
  emitter << YAML::Flow << node;
  std::string text = emitter.c_str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

}  // namespace

std::optional<std::uint64_t> seed_from_string(const std::string& text) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

Fields::Fields(const YAML::Node& node, std::string file, std::string place)
    : node_(node), file_(std::move(file)), place_(std::move(place)) {
  if (node_.IsMap()) return;
  throw SuiteError(where(node_) + (place_.empty() ? "the file" : place_) + " is " + shown(node_) +
                   ": expected lines 'key: value'");
}

std::string Fields::where(const YAML::Node& node) const {
  const int line = node ? node.Mark().line : -1;
  return file_ + (line >= 0 ? ":" + std::to_string(line + 1) : "") + ": ";
}

void Fields::allow_only(const std::vector<std::string>& known) const {
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const auto key = entry.first.as<std::string>("");
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw SuiteError(where(entry.first) + "unknown key '" + path_of(key) + "': expected one of " + joined(known));
    }
    if (!seen.insert(key).second)
      throw SuiteError(where(entry.first) + path_of(key) + " is there twice: expected once");
  }
}

void Fields::require(const std::string& key, const std::string& expected) const {
  if (!has(key)) throw SuiteError(where(node_) + path_of(key) + " is missing: expected " + expected);
}

void Fields::refuse(const std::string& key, const std::string& expected) const {
  const YAML::Node node = node_[key];
  throw SuiteError(where(node ? node : node_) + path_of(key) + " is " + (node ? shown(node) : "missing") +
                   ": expected " + expected);
}

void Fields::refuse_all(const std::string& problem) const {
  throw SuiteError(where(node_) + (place_.empty() ? "" : place_ + ": ") + problem);
}

std::string Fields::text(const std::string& key, const std::string& fallback) const {
  if (!has(key)) return fallback;
  if (!node_[key].IsScalar() || node_[key].Scalar().empty()) refuse(key, "a text");
  return node_[key].Scalar();
}

std::string Fields::word(const std::string& key, const std::string& fallback,
                         const std::vector<std::string>& known) const {
  std::string result = text(key, fallback);
  if (std::find(known.begin(), known.end(), result) == known.end()) refuse(key, "one of " + joined(known));
  return result;
}

bool Fields::flag(const std::string& key, bool fallback) const {
  if (is_list(key)) refuse(key, "true or false");
  return flags(key, {fallback}).front();
}

double Fields::number(const std::string& key, double fallback, const NumberRule& rule) const {
  return has(key) ? number_in(node_[key], key, rule) : fallback;
}

std::int64_t Fields::count(const std::string& key, std::int64_t fallback, const NumberRule& rule) const {
  if (!has(key)) return fallback;
  const double value = number_in(node_[key], key, rule);
  if (value != std::floor(value)) refuse(key, rule.expected);
  return static_cast<std::int64_t>(value);
}

std::uint64_t Fields::seed(const std::string& key, std::uint64_t fallback) const {
  if (!has(key)) return fallback;
  const YAML::Node node = node_[key];
  const std::optional<std::uint64_t> value = node.IsScalar() ? seed_from_string(node.Scalar()) : std::nullopt;
  if (!value) refuse(key, "a whole number from 0 to 2^64 - 1");
  return *value;
}

std::vector<YAML::Node> Fields::items(const std::string& key, const char* expected) const {
  const YAML::Node node = node_[key];
  if (node.IsScalar()) return {node};
  if (!node.IsSequence() || node.size() == 0) refuse(key, std::string(expected) + ", or a list of such");
  return {node.begin(), node.end()};
}

std::vector<std::string> Fields::texts(const std::string& key, const std::vector<std::string>& fallback) const {
  if (!has(key)) return fallback;
  std::vector<std::string> result;
  for (const YAML::Node& node : items(key, "a text")) {
    if (!node.IsScalar() || node.Scalar().empty()) refuse(key, "a text, or a list of such");
    result.push_back(node.Scalar());
  }
  return result;
}

std::vector<bool> Fields::flags(const std::string& key, const std::vector<bool>& fallback) const {
  if (!has(key)) return fallback;
  std::vector<bool> result;
  for (const YAML::Node& node : items(key, "true or false")) {
    bool value = false;
    if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value)) refuse(key, "true or false, or a list of such");
    result.push_back(value);
  }
  return result;
}

std::vector<double> Fields::numbers(const std::string& key, const std::vector<double>& fallback,
                                    const NumberRule& rule) const {
  if (!has(key)) return fallback;
  std::vector<double> result;
  for (const YAML::Node& node : items(key, rule.expected)) result.push_back(number_in(node, key, rule));
  return result;
}

std::vector<int> Fields::counts(const std::string& key, const std::vector<int>& fallback,
                                const NumberRule& rule) const {
  if (!has(key)) return fallback;
  std::vector<int> result;
  for (const double value : numbers(key, {}, rule)) {
    if (value != std::floor(value)) refuse(key, rule.expected);
    result.push_back(static_cast<int>(value));
  }
  return result;
}

std::vector<Eigen::Vector2d> Fields::points(const std::string& key) const {
  constexpr NumberRule any{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max(),
                           "a list of points [x, y]"};
  std::vector<Eigen::Vector2d> result;
  if (!has(key)) return result;
  for (const YAML::Node& node : items(key, any.expected)) {
    if (!node.IsSequence() || node.size() != 2) refuse(key, any.expected);
    result.emplace_back(number_in(node[0], key, any), number_in(node[1], key, any));
  }
  return result;
}

std::vector<Fields> Fields::children(const std::string& key) const {
  if (!has(key)) return {};
  const YAML::Node node = node_[key];
  if (!node.IsSequence() || node.size() == 0) refuse(key, "a list of entries, each with lines 'key: value'");
  std::vector<Fields> result;
  for (std::size_t i = 0; i < node.size(); ++i) {
    result.emplace_back(node[i], file_, path_of(key) + "[" + std::to_string(i) + "]");
  }
  return result;
}

double Fields::number_in(const YAML::Node& node, const std::string& key, const NumberRule& rule) const {
  double value = 0.0;
  const bool number = node.IsScalar() && YAML::convert<double>::decode(node, value);
  if (!number || !(value >= rule.least && value <= rule.most)) refuse(key, rule.expected);
  return value;
}

}  // namespace lrrt::bench
