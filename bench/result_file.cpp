// SPDX-License-Identifier: BSD-3-Clause
#include "result_file.hpp"

#include <sstream>
#include <system_error>

namespace lrrt::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* format = "lrrt_bench 1";

fs::path with_suffix(fs::path path, const char* suffix) {
  path += suffix;
  return path;
}

[[noreturn]] void cannot_write(const fs::path& path) {
  throw ResultError(path.string() + ": cannot be written; expected a folder that exists, may be written and has room");
}

/// A line of JSON, or null for the unfinished line of a run that was killed.
Json parsed(const std::string& line) {
  return Json::parse(line, nullptr, false);
}

bool same_but_for_time(Json a, Json b) {
  if (!a.is_object() || !b.is_object()) return false;
  a.erase("started");
  b.erase("started");
  return a == b;
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
  if (fs::exists(part(), ignored)) resume();
  // Written anew rather than appended to: a run that was killed may have left half a line.
  stream_.open(with_suffix(part(), ".new"), std::ios::trunc);
  stream_ << dumped(header_) << '\n';
  for (const auto& [id, row] : rows_) stream_ << dumped(row) << '\n';
  if (!stream_.flush()) cannot_write(part());
  fs::rename(with_suffix(part(), ".new"), part());
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
  while (std::getline(file, line)) {
    const Json row = parsed(line);
    if (row.is_object() && row.contains("id")) rows_[row.at("id").get<std::string>()] = row;
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
  std::ifstream file(path);
  if (!file) throw ResultError(path.string() + ": cannot be read; expected a file that --json wrote");
  Json json = Json::parse(file, nullptr, false);
  const bool ours = json.is_object() && json.value("format", Json()) == format && json.contains("suite") &&
                    json.value("rows", Json()).is_array();
  if (!ours) {
    throw ResultError(path.string() + ": is no result file; expected one that --json wrote ('format': '" + format +
                      "', a suite and rows)");
  }
  return json;
}

void write_file(const fs::path& path, const std::string& text) {
  const fs::path fresh = with_suffix(path, ".new");
  std::ofstream file(fresh, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) cannot_write(path);
  std::error_code error;
  fs::rename(fresh, path, error);
  if (error) cannot_write(path);
}

}  // namespace lrrt::bench
