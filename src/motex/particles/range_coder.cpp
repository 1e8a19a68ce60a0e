// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/particles/range_coder.h"

#include <algorithm>

#include "motex/core/error.h"

namespace motex {
namespace {

constexpr std::uint32_t kLeastRange = 1U << 24U;
constexpr int kSlowest = 6;  // a model follows the last 2⁶ bits
constexpr int kShareBits = 12;

}  // namespace

void BitModel::learn(bool bit) {
  // 1 / (n + 1.5) while little was seen, as shifts: 1/2, 1/4, 1/4, 1/8 …
  constexpr std::array<std::uint8_t, 20> kShift{1, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5};
  int shift = kSlowest;
  if (seen < 36) shift = seen < kShift.size() ? kShift[seen] : 5;
  if (seen < 36) ++seen;
  if (bit)
    zero = static_cast<std::uint16_t>(zero - (zero >> shift));
  else
    zero = static_cast<std::uint16_t>(zero + ((0xFFFFU - zero) >> shift));
}

bool RangeWriter::bit(BitModel& model, bool value) {
  const std::uint32_t bound = (range_ >> kShareBits) * model.share();
  if (value) {
    low_ += bound;
    range_ -= bound;
  } else {
    range_ = bound;
  }
  model.learn(value);
  widen();
  return value;
}

void RangeWriter::widen() {
  while (range_ < kLeastRange) {
    range_ <<= 8U;
    shift_low();
  }
}

std::uint32_t RangeWriter::raw(std::uint32_t value, int num_bits) {
  for (int k = num_bits - 1; k >= 0; --k) {
    range_ >>= 1U;
    if ((value >> k & 1U) != 0) low_ += range_;
    widen();
  }
  return value;
}

/// A byte leaves only when no carry can reach it any more.
void RangeWriter::shift_low() {
  if (low_ < 0xFF000000U || low_ > 0xFFFFFFFFU) {
    const auto carry = static_cast<std::uint8_t>(low_ >> 32U);
    for (std::uint8_t byte = held_; num_held_ > 0; --num_held_, byte = 0xFF) {
      if (!is_first_) bytes_ += static_cast<char>(static_cast<std::uint8_t>(byte + carry));
      is_first_ = false;  // the first byte is always 0
    }
    held_ = static_cast<std::uint8_t>(low_ >> 24U & 0xFFU);
  }
  ++num_held_;
  low_ = (low_ & 0x00FFFFFFU) << 8U;
}

std::string RangeWriter::finish() {
  for (int k = 0; k < 5; ++k) shift_low();
  return std::move(bytes_);
}

void RangeWriter::fail(const char* message) const { throw InvalidInput(message); }

RangeReader::RangeReader(std::string_view bytes, std::string name, std::int64_t offset)
    : bytes_(bytes), name_(std::move(name)), offset_(offset) {
  for (int k = 0; k < 4; ++k) code_ = code_ << 8U | next_byte();
}

std::uint8_t RangeReader::next_byte() {
  if (at_ >= bytes_.size()) fail("ends too early; the file is cut off or damaged");
  return static_cast<std::uint8_t>(bytes_[at_++]);
}

void RangeReader::fail(const char* message) const {
  throw ParseError(name_, ParseError::Unit::kByte, offset_ + static_cast<std::int64_t>(at_), message);
}

bool RangeReader::bit(BitModel& model, bool) {
  const std::uint32_t bound = (range_ >> kShareBits) * model.share();
  const bool value = code_ >= bound;
  if (value) {
    code_ -= bound;
    range_ -= bound;
  } else {
    range_ = bound;
  }
  model.learn(value);
  widen();
  return value;
}

void RangeReader::widen() {
  while (range_ < kLeastRange) {
    range_ <<= 8U;
    code_ = code_ << 8U | next_byte();
  }
}

std::uint32_t RangeReader::raw(std::uint32_t, int num_bits) {
  std::uint32_t value = 0;
  for (int k = 0; k < num_bits; ++k) {
    range_ >>= 1U;
    const bool bit = code_ >= range_;
    if (bit) code_ -= range_;
    value = value << 1U | static_cast<std::uint32_t>(bit);
    widen();
  }
  return value;
}

}  // namespace motex
