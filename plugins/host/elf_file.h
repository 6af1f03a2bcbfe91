// A look at a shared library before it is loaded.
#pragma once

#include <string>

namespace pomona {

/// Throws std::runtime_error "path: reason" for a file that is no library for this kind of machine, or that
/// ends before its last segment: the dynamic loader maps such a one all the same, and the program dies of
/// SIGBUS.
void requireWholeLibrary(const std::string& path);

}  // namespace pomona
