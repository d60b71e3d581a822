// SPDX-License-Identifier: BSD-3-Clause
#include "result_file.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <system_error>
#include <utility>

#include "outputs.hpp"
#include "row_check.hpp"

namespace lrrt::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* format = "lrrt_bench 1";
constexpr std::size_t longest_result = std::size_t{1} << 30;  // bytes

/// JSON, or a discarded value for what is none, such as the unfinished line of a run that was killed. Nesting that no
/// result has is none either: what works on JSON afterwards recurses.
template <typename Input>
Json parsed(Input&& input) {
  constexpr int deepest = 64;
  bool too_deep = false;
  const auto watch = [&](int depth, Json::parse_event_t, const Json&) {
    too_deep = too_deep || depth > deepest;
    return !too_deep;
  };
  Json json = Json::parse(std::forward<Input>(input), watch, false);
  return too_deep ? Json(Json::value_t::discarded) : json;
}

/// What a replay reads of a document, its rows left out, is what this program writes.
bool is_head(const Json& json) {
  const Json inputs = json.value("inputs", Json::object());
  return json.contains("suite") && json.value("folder", Json("")).is_string() && inputs.is_object() &&
         std::all_of(inputs.begin(), inputs.end(), [](const Json& kind) { return kind.is_object(); });
}

bool same_but_for_time(Json a, Json b) {
  if (!a.is_object() || !b.is_object()) return false;
  a.erase("started");
  b.erase("started");
  return a == b;
}

/// All of a stream, up to a limit: what comes through a pipe may have no end.
std::string text_of(std::istream& stream, const std::string& name) {
  std::string text;
  std::array<char, 1 << 16> block{};
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() <= longest_result) continue;
    throw ResultError(name + ": too large; expected a result of at most " + std::to_string(longest_result) + " bytes");
  }
  return text;
}

/// The document as text: indented, but every row on one line.
std::string text_of(const Json& document) {
  Json head = document;
  head.erase("rows");
  std::string text = dumped(head, 1);
  text.replace(text.rfind("\n}"), 2, ",\n \"rows\": [");
  const char* separator = "\n  ";
  for (const Json& row : document.at("rows")) {
    text += separator + dumped(row);
    separator = ",\n  ";
  }
  return text + "\n ]\n}\n";
}

}  // namespace

ResultFile::ResultFile(fs::path path, Json header) : path_(std::move(path)), header_(std::move(header)) {
  if (path_.empty()) return;
  std::error_code ignored;
  if (fs::is_regular_file(part(), ignored)) resume();
  // Written anew rather than appended to: a run that was killed may have left half a line.
  const fs::path fresh = with_suffix(part(), ".new");
  stream_.open(fresh, std::ios::trunc);
  stream_ << dumped(header_) << '\n';
  for (const auto& [id, row] : rows_) stream_ << dumped(row) << '\n';
  std::error_code error;
  if (stream_.flush()) fs::rename(fresh, part(), error);
  if (stream_ && !error) return;
  drop(fresh);
  cannot_write(part());
}

fs::path ResultFile::part() const {
  return with_suffix(path_, ".part");
}

void ResultFile::resume() {
  std::ifstream file(part());
  std::string line;
  std::getline(file, line);
  Json begun = parsed(line);
  if (!same_but_for_time(begun, parsed(dumped(header_)))) {
    throw ResultError(part().string() +
                      ": was begun with another suite, seed, map, model or version; give the command that began it to "
                      "go on, or remove the file to begin anew");
  }
  header_ = std::move(begun);
  const RowCheck is_whole(header_);
  while (std::getline(file, line)) {
    const Json row = parsed(line);
    if (is_whole(row)) rows_[row.at("id").get<std::string>()] = row;
  }
}

bool ResultFile::has(const std::string& id) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return rows_.count(id) != 0;
}

std::size_t ResultFile::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return rows_.size();
}

void ResultFile::add(const Json& row) {
  const std::lock_guard<std::mutex> lock(mutex_);
  rows_[row.at("id").get<std::string>()] = row;
  if (path_.empty()) return;
  stream_ << dumped(row) << '\n';
  if (!stream_.flush()) cannot_write(part());
}

Json ResultFile::document(const std::vector<std::string>& ids) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Json document = {{"format", format}};
  document.update(header_);
  document["rows"] = Json::array();
  for (const std::string& id : ids) document["rows"].push_back(rows_.at(id));
  return document;
}

void ResultFile::finish(const Json& document) {
  if (path_.empty()) return;
  write_file(path_, text_of(document));
  stream_.close();
  std::error_code ignored;
  fs::remove(part(), ignored);
}

Json read_result(const fs::path& path) {
  if (path == "-" || path == "/dev/stdin") return read_result(std::cin, "standard input");
  std::error_code ignored;
  std::ifstream file;
  if (fs::is_regular_file(path, ignored)) file.open(path);
  if (!file.is_open()) {
    throw ResultError(path.string() + ": cannot be read; expected a file that --json wrote, or - for standard input");
  }
  return read_result(file, path.string());
}

Json read_result(std::istream& stream, const std::string& name) {
  Json json = parsed(text_of(stream, name));
  const bool ours = json.is_object() && json.value("format", Json()) == format && is_head(json) &&
                    json.value("rows", Json()).is_array();
  if (!ours) {
    throw ResultError(name + ": is no result file; expected one that --json wrote ('format': '" + format +
                      "', a suite and rows)");
  }
  for (const Json& row : json.at("rows")) {
    if (is_row(row)) continue;
    throw ResultError(name + ": row " + dumped(row).substr(0, 60) +
                      " is none that --json wrote: expected an 'id', and either 'area' or 'iterations' and 'nodes'");
  }
  return json;
}

}  // namespace lrrt::bench
