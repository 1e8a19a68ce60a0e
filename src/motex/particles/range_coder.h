// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace motex {

/// How probable a 0 is at one place of a stream, learned from the bits seen there: fast at first, then over 64 of them.
struct BitModel {
  std::uint16_t zero = 1U << 15;  ///< probability of 0, 16 bits
  std::uint8_t seen = 0;

  std::uint32_t share() const { return 1U + (zero >> 4U) - (zero >> 15U); }  ///< 1 … 4095 of 4096
  void learn(bool bit);
};

/// Adaptive binary range coder (Martin 1979): each bit costs −log₂ of the probability that its model gave it.
/// Writing and reading have the same calls, so that a format is one template for both: a writer takes the value and
/// returns it, a reader passes over the argument and returns what was written.
class RangeWriter {
 public:
  bool bit(BitModel& model, bool value);
  /// num_bits ≤ 16 equally probable bits.
  std::uint32_t raw(std::uint32_t value, int num_bits);
  /// The bytes; nothing may be written after.
  std::string finish();
  [[noreturn]] void fail(const char* message) const;

 private:
  void widen();  ///< a narrow range gives up its leading byte
  void shift_low();
  std::string bytes_;
  std::uint64_t low_ = 0;
  std::uint32_t range_ = 0xFFFFFFFF;
  std::uint8_t held_ = 0;
  std::uint64_t num_held_ = 1;
  bool is_first_ = true;
};

/// Throws ParseError (name, byte) when the bytes end before what is asked for.
class RangeReader {
 public:
  /// The bytes must outlive the reader; `offset` of them within their file, for messages.
  RangeReader(std::string_view bytes, std::string name, std::int64_t offset = 0);
  bool bit(BitModel& model, bool = false);
  std::uint32_t raw(std::uint32_t, int num_bits);
  /// ParseError at the present byte.
  [[noreturn]] void fail(const char* message) const;

 private:
  void widen();
  std::uint8_t next_byte();
  std::string_view bytes_;
  std::string name_;
  std::int64_t offset_;
  std::size_t at_ = 0;
  std::uint32_t code_ = 0, range_ = 0xFFFFFFFF;
};

/// Signed whole numbers whose distribution is not known: a flag for 0, the sign, the number of digits in unary, the
/// first two digits below the leading one by models, the rest as they are. |value| < 2³⁰.
struct NumberModel {
  BitModel zero, sign;
  std::array<BitModel, 30> longer;
  std::array<std::array<BitModel, 3>, 30> digits;
};

template <typename Coder>
std::int32_t code_number(Coder& coder, NumberModel& model, std::int32_t value = 0) {
  if (coder.bit(model.zero, value == 0)) return 0;
  const bool negative = coder.bit(model.sign, value < 0);
  const std::uint32_t size = value < 0 ? 0U - static_cast<std::uint32_t>(value) : static_cast<std::uint32_t>(value);
  int num_digits = 0;  // below the leading one
  while (coder.bit(model.longer[static_cast<std::size_t>(num_digits)], size >> (num_digits + 1) != 0))
    if (++num_digits == static_cast<int>(model.longer.size())) coder.fail("a number is too large");
  std::uint32_t coded = 1;
  int left = num_digits;
  auto& digits = model.digits[static_cast<std::size_t>(num_digits == 0 ? 0 : num_digits - 1)];
  for (int k = 0; k < 2 && left > 0; ++k) {
    --left;
    BitModel& digit = digits[k == 0 ? 0 : 1 + (coded & 1U)];
    coded = coded << 1U | static_cast<std::uint32_t>(coder.bit(digit, (size >> left & 1U) != 0));
  }
  while (left > 0) {
    const int num_bits = left < 16 ? left : 16;
    left -= num_bits;
    coded = coded << num_bits | coder.raw(size >> left & ((1U << num_bits) - 1), num_bits);
  }
  return negative ? -static_cast<std::int32_t>(coded) : static_cast<std::int32_t>(coded);
}

/// The same for numbers that are never negative.
template <typename Coder>
std::int32_t code_count(Coder& coder, NumberModel& model, std::int32_t value = 0) {
  const std::int32_t coded = code_number(coder, model, value);
  if (coded < 0) coder.fail("a count is negative");
  return coded;
}

}  // namespace motex
