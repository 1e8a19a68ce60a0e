// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace motex {

/// Base of everything that motex throws. what() is one sentence for a person: what is wrong, where, what to do.
/// Doors (command line, server, Python) catch it once: InvalidInput and its children are the user's (exit code 2),
/// Cancelled is 130, the rest are ours or the machine's (1).
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An argument or a file that cannot be used as it is.
class InvalidInput : public Error {
 public:
  using Error::Error;
};

/// A file whose text or bytes are broken at a known place.
class ParseError : public InvalidInput {
 public:
  enum class Unit { kLine, kByte };
  /// what() is "file:12: message" for lines (from 1) and "file: byte 12: message" for bytes (from 0).
  ParseError(const std::string& file, Unit unit, std::int64_t position, const std::string& message);
  Unit unit() const { return unit_; }
  std::int64_t position() const { return position_; }

 private:
  Unit unit_;
  std::int64_t position_;
};

/// A file of a kind, or with a feature, that motex does not read.
class UnsupportedFile : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// A disk that filled or failed while writing; the old file, if any, is untouched.
class WriteError : public Error {
 public:
  using Error::Error;
};

/// A computation that has no usable result (a matrix that cannot be factored, a NaN that appeared).
class NumericalFailure : public Error {
 public:
  using Error::Error;
};

/// The caller asked to stop; nothing was written.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace motex
