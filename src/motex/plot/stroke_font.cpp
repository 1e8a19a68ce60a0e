// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/plot/stroke_font.h"

#include <algorithm>
#include <cstdint>

namespace motex {
namespace {

// 20 units to the em. A point is two digits 0 … z (base 36): x from the left, y from 5 units below the base line.
// A stroke is a sequence of points; '~' makes it a quadratic B-spline (a point given twice is a corner), '@' a closed
// one.
struct Glyph {
  char32_t code;
  int advance;
  const char* strokes;
};

constexpr int kUnitsPerEm = 20, kBaseLine = 5, kTracking = 1;

constexpr Glyph kGlyphs[] = {
    {' ', 6, ""},
    {'!', 5, "2j2a 2526"},
    {'"', 7, "2j2f 5j5f"},
    {'#', 11, "253j 758j 1a9a 1e9e"},
    {'$', 11, "~9g9i1i1d9b961618 535l"},
    {'%', 13, "25bj @1d5d5j1j @85c5cb8b"},
    {'&', 12, "~a52f2j7j7f1a1575ab"},
    {'\'', 4, "2j2f"},
    {'(', 6, "~5k1h1652"},
    {')', 6, "~1k5h5612"},
    {'*', 8, "4j4d 1h7f 7h1f"},
    {'+', 11, "1a9a 565e"},
    {',', 4, "2613"},
    {'-', 7, "1a6a"},
    {'.', 4, "2526"},
    {'/', 8, "137k"},
    {'0', 11, "@15959c9j1j1c"},
    {'1', 11, "2g5j55"},
    {'2', 11, "~1g1j9j9c151595"},
    {'3', 11, "~1h1j8j8c4c ~4c9c951518"},
    {'4', 11, "757j19a9"},
    {'5', 11, "8j2j1c ~1c3e9e951518"},
    {'6', 11, "@15959d1d ~8j1h1a19"},
    {'7', 11, "1j9j45"},
    {'8', 11, "@15959c1c @2c8c8j2j"},
    {'9', 11, "@1b9b9j1j ~9f9e9725"},
    {':', 5, "2526 2c2d"},
    {';', 5, "2613 2c2d"},
    {'<', 10, "8f1a85"},
    {'=', 11, "1c9c 1898"},
    {'>', 10, "1f8a15"},
    {'?', 10, "~1g1j8j8d5c59 5556"},
    {'@', 15, "~b4141jdjd8a8ae @48a8ae4e"},
    {'A', 11, "055ja5 2a8a"},
    {'B', 12, "151j ~1j1j6j9j9c6c1c1c ~1c1c6caca5651515"},
    {'C', 12, "~ag9j1j1c1595a8"},
    {'D', 13, "151j ~1j1j5jbjbcb5551515"},
    {'E', 10, "85151j8j 1c7c"},
    {'F', 10, "151j8j 1c7c"},
    {'G', 13, "~ag9j1j1c15a5aba6b6b 6baba5"},
    {'H', 12, "151j 959j 1c9c"},
    {'I', 4, "252j"},
    {'J', 9, "~6j6c650508"},
    {'K', 11, "151j 9j1b 4e95"},
    {'L', 9, "1j1585"},
    {'M', 14, "151j69bjb5"},
    {'N', 12, "151j959j"},
    {'O', 13, "@15b5bcbj1j1c"},
    {'P', 11, "151j ~1j1j5j9j9b5b1b1b"},
    {'Q', 13, "@15b5bcbj1j1c 79b4"},
    {'R', 11, "151j ~1j1j5j9j9b5b1b1b 5b95"},
    {'S', 11, "~9g9j1j1d9b951518"},
    {'T', 10, "0jaj 555j"},
    {'U', 12, "~1j1c15959c 9c9j"},
    {'V', 11, "0j55aj"},
    {'W', 15,
     "0j357h"
     "b5ej"},
    {'X', 11, "159j 1j95"},
    {'Y', 10, "0j5caj 5c55"},
    {'Z', 11, "1j9j1595"},
    {'[', 6, "5k1k1252"},
    {'\\', 8, "1k73"},
    {']', 6, "1k5k5212"},
    {'^', 10, "1d5j9d"},
    {'_', 10, "0393"},
    {'`', 5, "1j3g"},
    {'a', 10, "@15858a8f1f1a 8f85"},
    {'b', 10, "1j15 @15858a8f1f1a"},
    {'c', 9, "~8d7f1f1a157587"},
    {'d', 10, "8j85 @15858a8f1f1a"},
    {'e', 10, "~1a1a8a8a8f1f1a157587"},
    {'f', 7, "~6j3j3f3535 1f6f"},
    {'g', 10, "@15858a8f1f1a ~8f8f85801012"},
    {'h', 10, "151j ~1a1f8f8a8585"},
    {'i', 4, "252f 2i2j"},
    {'j', 5, "~3f3f353000 3i3j"},
    {'k', 9, "151j 7f19 4c85"},
    {'l', 4, "252j"},
    {'m', 15, "151f ~1a1f7f7a7575 ~7a7fdfdad5d5"},
    {'n', 10, "151f ~1a1f8f8a8585"},
    {'o', 10, "@15959a9f1f1a"},
    {'p', 10, "101f @15858a8f1f1a"},
    {'q', 10, "808f @15858a8f1f1a"},
    {'r', 7, "151f ~1a1f6f6f"},
    {'s', 9, "~7d7f1f1b79751517"},
    {'t', 7, "~3j3j3a3565 1f6f"},
    {'u', 10, "~1f1f1a15858a 8f85"},
    {'v', 9, "0f458f"},
    {'w', 13, "0f356e95cf"},
    {'x', 9, "158f 1f85"},
    {'y', 9, "0f45 8f20"},
    {'z', 9, "1f8f1585"},
    {'{', 7, "~5k3k3c1b ~1b3a3252"},
    {'|', 5, "222k"},
    {'}', 7, "~1k3k3c5b ~5b3a3212"},
    {'~', 10, "~1a3d688b"},
    {0xb0, 7, "@1e5e5j1j"},
    {0xb2, 7, "~1g1j5j5g1c1c5c"},
    {0xb5, 10, "101f ~1f1f1a15858a 8f85"},
    {0xb7, 5, "2a2b"},
    {0xd7, 11, "268c 2c86"},
    {0x2013, 11, "1a9a"},
    {0x2014, 15, "0aea"},
    {0x2026, 14, "2526 6566 a5a6"},
    {0x2192, 15,
     "1ada ad"
     "daa7"},
    {0x2212, 11, "1a9a"},
    {0x2264, 11, "9h1d99 1595"},
    {0x2265, 11, "1h9d19 1595"},
};

constexpr Glyph kMissing{0, 12, "15a5aj1j15"};

const Glyph& find_glyph(char32_t code) {
  const auto* found =
      std::find_if(std::begin(kGlyphs), std::end(kGlyphs), [&](const Glyph& g) { return g.code == code; });
  return found == std::end(kGlyphs) ? kMissing : *found;
}

// A byte that is no valid start or continuation yields U+FFFD, which has no glyph.
std::u32string decode_utf8(std::string_view text) {
  std::u32string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    const std::size_t more = lead < 0x80   ? 0
                             : lead < 0xc0 ? 9
                             : lead < 0xe0 ? 1
                             : lead < 0xf0 ? 2
                             : lead < 0xf8 ? 3
                                           : 9;
    char32_t code = more == 0 ? lead : lead & (0x3FU >> more);
    std::size_t k = 0;
    for (; k < more && i + k < text.size() && (text[i + k] & 0xc0) == 0x80; ++k)
      code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3fU);
    i += k == more ? more : 0;
    out += k == more ? code : char32_t{0xfffd};
  }
  return out;
}

Point middle(Point a, Point b) { return {(a.x + b.x) / 2, (a.y + b.y) / 2}; }

void append_quadratic(std::vector<Point>& out, Point from, Point control, Point to) {
  constexpr int kSteps = 6;
  for (int i = 1; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps, s = 1 - t;
    out.push_back(
        {s * s * from.x + 2 * s * t * control.x + t * t * to.x, s * s * from.y + 2 * s * t * control.y + t * t * to.y});
  }
}

std::vector<Point> spline(const std::vector<Point>& controls, bool closed) {
  const std::size_t n = controls.size();
  std::vector<Point> out;
  if (closed) {
    out.push_back(middle(controls[n - 1], controls[0]));
    for (std::size_t i = 0; i < n; ++i)
      append_quadratic(out, out.back(), controls[i], middle(controls[i], controls[(i + 1) % n]));
    return out;
  }
  out.push_back(controls[0]);
  for (std::size_t i = 1; i + 1 < n; ++i)
    append_quadratic(out, out.back(), controls[i], i + 2 == n ? controls[i + 1] : middle(controls[i], controls[i + 1]));
  if (n == 2) out.push_back(controls[1]);
  return out;
}

int digit(char c) { return c <= '9' ? c - '0' : c - 'a' + 10; }

std::vector<Point> parse_stroke(std::string_view code, double x, double unit) {
  const bool closed = code[0] == '@', curved = closed || code[0] == '~';
  if (curved) code.remove_prefix(1);
  std::vector<Point> points;
  for (std::size_t i = 0; i + 1 < code.size(); i += 2)
    points.push_back({x + digit(code[i]) * unit, (kBaseLine - digit(code[i + 1])) * unit});
  return curved ? spline(points, closed) : points;
}

}  // namespace

double text_width(std::string_view utf8, double size) {
  int units = 0;
  for (const char32_t c : decode_utf8(utf8)) units += find_glyph(c).advance + kTracking;
  return units * size / kUnitsPerEm;
}

std::vector<std::vector<Point>> text_strokes(std::string_view utf8, double size) {
  const double unit = size / kUnitsPerEm;
  std::vector<std::vector<Point>> out;
  double x = 0;
  for (const char32_t c : decode_utf8(utf8)) {
    const Glyph& glyph = find_glyph(c);
    for (std::string_view rest = glyph.strokes; !rest.empty();) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      out.push_back(parse_stroke(rest.substr(0, end), x, unit));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    x += (glyph.advance + kTracking) * unit;
  }
  return out;
}

double pen_width(double size, bool bold) { return size * (bold ? 0.12 : 0.085); }

}  // namespace motex
