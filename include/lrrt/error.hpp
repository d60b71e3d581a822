// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace lrrt {

/// Base of every exception that the library throws on purpose. The text names the file or field, the value found, what
/// was expected and what to do about it.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A map that cannot be read or makes no sense: missing file, broken header, sizes that do not fit the data.
class MapError : public Error {
 public:
  using Error::Error;
};

/// A model that cannot be loaded or run: missing runtime, broken file, metadata that do not fit the library.
class ModelError : public Error {
 public:
  using Error::Error;
};

/// A request or an option out of its range: a share above one, an unknown planner, a point that is not a number.
class RequestError : public Error {
 public:
  using Error::Error;
};

}  // namespace lrrt
