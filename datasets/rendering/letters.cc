#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "datasets/rendering/paint.h"

namespace pomona {
namespace {

constexpr int kColumns = 5, kRows = 7;

// Rows from the top; the bit of value 16 is the leftmost column.
constexpr std::array<std::array<std::uint8_t, kRows>, 26> kLetters = {{
    {14, 17, 17, 31, 17, 17, 17}, {30, 17, 17, 30, 17, 17, 30}, {14, 17, 16, 16, 16, 17, 14},
    {30, 17, 17, 17, 17, 17, 30}, {31, 16, 16, 30, 16, 16, 31}, {31, 16, 16, 30, 16, 16, 16},
    {14, 17, 16, 23, 17, 17, 14}, {17, 17, 17, 31, 17, 17, 17}, {14, 4, 4, 4, 4, 4, 14},
    {7, 2, 2, 2, 2, 18, 12},      {17, 18, 20, 24, 20, 18, 17}, {16, 16, 16, 16, 16, 16, 31},
    {17, 27, 21, 21, 17, 17, 17}, {17, 25, 21, 19, 17, 17, 17}, {14, 17, 17, 17, 17, 17, 14},
    {30, 17, 17, 30, 16, 16, 16}, {14, 17, 17, 17, 21, 18, 13}, {30, 17, 17, 30, 20, 18, 17},
    {15, 16, 16, 14, 1, 1, 30},   {31, 4, 4, 4, 4, 4, 4},       {17, 17, 17, 17, 17, 17, 14},
    {17, 17, 17, 17, 17, 10, 4},  {17, 17, 17, 21, 21, 27, 17}, {17, 17, 10, 4, 10, 17, 17},
    {17, 17, 10, 4, 4, 4, 4},     {31, 1, 2, 4, 8, 16, 31},
}};

}  // namespace

bool isInText(const std::string& text, double x, double y) {
  if (!(x >= 0 && x < 1 && y >= 0 && y < 1)) return false;
  // One empty column between letters.
  const double columns = static_cast<double>(text.size()) * (kColumns + 1) - 1;
  const int at = static_cast<int>(x * columns), row = static_cast<int>(y * kRows);
  const char letter = text[at / (kColumns + 1)];
  const int column = at % (kColumns + 1);
  if (column == kColumns || letter < 'A' || letter > 'Z') return false;
  return kLetters[letter - 'A'][row] >> (kColumns - 1 - column) & 1;
}

}  // namespace pomona
