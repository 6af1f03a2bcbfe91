#include "core/cpu.h"

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

namespace pomona {
namespace {

struct Entry {
  Isa isa;
  bool built;
  bool supported;
};

#if defined(POMONA_WITH_AVX2)
constexpr bool kBuiltAvx2 = true;
#else
constexpr bool kBuiltAvx2 = false;
#endif
#if defined(POMONA_WITH_AVX512)
constexpr bool kBuiltAvx512 = true;
#else
constexpr bool kBuiltAvx512 = false;
#endif
#if defined(POMONA_WITH_NEON)
constexpr bool kBuiltNeon = true;
#else
constexpr bool kBuiltNeon = false;
#endif

bool cpuHasAvx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
#else
  return false;
#endif
}

bool cpuHasAvx512() {
#if defined(__x86_64__)
  return cpuHasAvx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512bitalg");
#else
  return false;
#endif
}

constexpr bool cpuHasNeon() {
#if defined(__aarch64__)
  return true;
#else
  return false;
#endif
}

std::vector<Isa> select(bool need_support) {
  const Entry entries[] = {{Isa::kScalar, true, true},
                           {Isa::kNeon, kBuiltNeon, cpuHasNeon()},
                           {Isa::kAvx2, kBuiltAvx2, cpuHasAvx2()},
                           {Isa::kAvx512, kBuiltAvx512, cpuHasAvx512()}};
  std::vector<Isa> result;
  for (const Entry& e : entries)
    if (e.built && (e.supported || !need_support)) result.push_back(e.isa);
  return result;
}

}  // namespace

std::string_view name(Isa isa) {
  switch (isa) {
    case Isa::kScalar:
      return "scalar";
    case Isa::kAvx2:
      return "avx2";
    case Isa::kAvx512:
      return "avx512";
    case Isa::kNeon:
      return "neon";
  }
  return "unknown";
}

const std::vector<Isa>& usableIsas() {
  static const std::vector<Isa> isas = select(true);
  return isas;
}

const std::vector<Isa>& builtIsas() {
  static const std::vector<Isa> isas = select(false);
  return isas;
}

Isa chooseIsa(std::string_view request) {
  const char* source = "isa";
  if (request.empty()) {
    if (const char* variable = std::getenv("POMONA_ISA")) {
      request = variable;
      source = "POMONA_ISA";
    }
  }
  if (request.empty()) return usableIsas().back();
  std::string allowed;
  for (Isa isa : usableIsas()) {
    if (name(isa) == request) return isa;
    allowed += (allowed.empty() ? "" : ", ") + std::string(name(isa));
  }
  throw std::invalid_argument(std::string(source) + " is '" + std::string(request) +
                              "'; this build on this CPU offers: " + allowed);
}

std::string_view cpuModel() {
  static const std::string model = [] {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
      if (line.starts_with("model name") && line.find(':') + 2 < line.size())
        return line.substr(line.find(':') + 2);
    return std::string("unknown CPU");
  }();
  return model;
}

}  // namespace pomona
