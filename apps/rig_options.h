// How a rig is named on the command line.
#pragma once

#include <string>
#include <vector>

#include "pomona/rig.h"

namespace CLI {
class App;
}

namespace pomona {

struct RigPaths {
  std::vector<std::string> files;  ///< one file or folder, or left and right
  std::string unit;                ///< "m", "cm", "mm"; empty: as the format prescribes
  std::vector<int> cameras;        ///< none, or left and right
};

/// One of the renderer's own rigs (rigNames()), or else a file: what any verb's --rig or --calib may name.
StereoRig rigNamed(const std::string& name_or_path, const RigFileOptions& options = {});

void addRigPaths(CLI::App& verb, RigPaths& paths);
StereoRig readRig(const RigPaths& paths);

}  // namespace pomona
