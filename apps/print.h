// Lines of text for people.
#pragma once

namespace pomona {

/// A line on the standard output, of at most 511 characters; `format` as for printf.
[[gnu::format(printf, 1, 2)]] void print(const char* format, ...);

}  // namespace pomona
