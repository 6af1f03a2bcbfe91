// The stages of a dense map, each with what is done without it.
#pragma once

#include <span>

#include "pomona/options.h"

namespace pomona {

struct Rung {
  const char* preset;
  const char* stage;
  const char* instead;          ///< what is done without it
  void (*take_away)(Options&);  ///< from the preset's options
};

/// By preset; the first rung of each takes nothing away.
std::span<const Rung> rungs();

}  // namespace pomona
