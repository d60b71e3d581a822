// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <map>
#include <mutex>
#include <string>

#include "json.hpp"
#include "lrrt/error.hpp"

namespace lrrt::bench {

/// A result file that cannot be read, written or continued.
class ResultError : public Error {
 public:
  using Error::Error;
};

/// The rows of a run while they are made.
///
/// With a file F they are kept in F.part as they come, one line of JSON each, so that an interrupted run loses nothing:
/// the next one with the same header goes on where it stopped. finish() writes F and removes F.part. Without a file the
/// rows are only kept in memory. Safe to use from many threads.
class ResultFile {
 public:
  /// @param path may be empty. @param header what all rows share; a part file with another header is refused.
  /// @throws ResultError when F.part cannot be written or belongs to something else.
  ResultFile(std::filesystem::path path, Json header);

  bool has(const std::string& id) const;
  std::size_t size() const;
  /// Keeps a finished row; its `id` tells it from the others. @throws ResultError when it cannot be written.
  void add(const Json& row);
  /// The header with `rows` in the order of the ids. @param ids of rows that all are there.
  Json document(const std::vector<std::string>& ids) const;
  /// Writes the document to F, complete or not at all. @throws ResultError when it cannot be written.
  void finish(const Json& document);

 private:
  std::filesystem::path part() const;
  void resume();

  std::filesystem::path path_;
  Json header_;
  std::map<std::string, Json> rows_;
  std::ofstream stream_;
  mutable std::mutex mutex_;
};

/// Reads a finished result file. @param path "-" or "/dev/stdin" for standard input, through a pipe or not.
/// @throws ResultError when it is missing, too large or none.
Json read_result(const std::filesystem::path& path);

/// The same from a stream. @param name of it in errors.
Json read_result(std::istream& stream, const std::string& name);

}  // namespace lrrt::bench
