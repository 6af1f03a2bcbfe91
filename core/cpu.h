// Which instruction sets were built, which this CPU has, and which one to use.
#pragma once

#include <string_view>
#include <vector>

namespace pomona {

enum class Isa { kScalar, kAvx2, kAvx512, kNeon };

std::string_view name(Isa isa);

/// Built into this library and supported by this CPU, slowest first. Never empty: scalar always works.
const std::vector<Isa>& usableIsas();
/// Built into this library, whether or not this CPU has them.
const std::vector<Isa>& builtIsas();

/// `request` names an instruction set; empty means the POMONA_ISA environment variable, or, without that, the
/// fastest usable one. Throws std::invalid_argument for a name that is unknown, not built or not supported.
Isa chooseIsa(std::string_view request);

/// What the CPU calls itself, for reports.
std::string_view cpuModel();

}  // namespace pomona
