// The methods named on the command line.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "baselines/method.h"

namespace CLI {
class App;
}

namespace pomona {

/// What --methods, --mode, --left-right, --speckle, --median and --threads say.
struct MethodArguments {
  std::vector<std::string> names;
  std::string mode = "dense";
  PostProcessing post_processing;
  int threads = 0;
};

/// Adds these options; `defaults` is what runs without --methods.
void addMethodOptions(CLI::App& verb, MethodArguments& arguments, std::vector<std::string> defaults);

struct NamedMethod {
  std::string name;
  std::unique_ptr<Method> method;
};

/// The methods in the order given; "all" stands for every one there is. Throws std::invalid_argument for an
/// unknown name, one given twice, or a number of threads that makes no sense.
std::vector<NamedMethod> makeMethods(const MethodArguments& arguments);

/// For a search of [0, num_disparities).
MethodOptions methodOptions(const MethodArguments& arguments, int num_disparities);

}  // namespace pomona
