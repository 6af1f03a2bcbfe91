#include "apps/method_list.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <stdexcept>

#include "core/parallel.h"

namespace pomona {
namespace {

constexpr int kMostThreads = 1024;

std::string allNames() {
  std::string names;
  for (const MethodInfo& method : methods()) names += (names.empty() ? "" : ", ") + std::string(method.name);
  return names;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

}  // namespace

void addMethodOptions(CLI::App& verb, MethodArguments& arguments, std::vector<std::string> defaults) {
  arguments.names = std::move(defaults);
  verb.add_option(
          "--methods", arguments.names,
          "Separated by commas (default " + joined(arguments.names) + "); all, or any of " + allNames())
      ->delimiter(',');
  verb.add_option("--mode", arguments.mode,
                  "dense (default); sparse: measured pixels only; raw: winners, neither checked nor filled")
      ->check(CLI::IsMember({"dense", "sparse", "raw"}));
  PostProcessing& post = arguments.post_processing;
  const std::string own = " (default: each method's own)";
  verb.add_option("--left-right", post.left_right_px,
                  "Largest difference of left and right disparity, px; negative: any" + own);
  verb.add_option("--speckle", post.speckle_size_px, "Smaller regions are removed, pixels; 0: none" + own)
      ->check(CLI::Range(0, 1 << 30));
  verb.add_option("--median", post.median_size, "Side of the median filter: 0 (none), 3 or 5" + own)
      ->check(CLI::IsMember({0, 3, 5}));
  verb.add_option("--threads", arguments.threads, "Worker threads (default 0: one per processor)");
}

std::vector<NamedMethod> makeMethods(const MethodArguments& arguments) {
  if (arguments.threads < 0 || arguments.threads > kMostThreads)
    throw std::invalid_argument("--threads is " + std::to_string(arguments.threads) + "; allowed: 0 to " +
                                std::to_string(kMostThreads));
  if (const auto& px = arguments.post_processing.left_right_px; px && !(std::abs(*px) <= 1e6f))
    throw std::invalid_argument("--left-right is " + std::to_string(*px) + "; allowed: -1000000 to 1000000");
  // OpenCV's matchers ask OpenCV only. More threads than processors it would answer with a warning.
  if (arguments.threads > 0) cv::setNumThreads(std::min(arguments.threads, availableThreads()));
  std::vector<NamedMethod> chosen;
  if (arguments.names == std::vector<std::string>{"all"}) {
    for (const MethodInfo& method : methods()) chosen.push_back({std::string(method.name), method.make()});
    return chosen;
  }
  for (const std::string& name : arguments.names) {
    const auto same = [&](const NamedMethod& other) { return other.name == name; };
    if (std::any_of(chosen.begin(), chosen.end(), same))
      throw std::invalid_argument("--methods names '" + name + "' twice");
    chosen.push_back({name, makeMethod(name)});
  }
  return chosen;
}

MethodOptions methodOptions(const MethodArguments& arguments, int num_disparities) {
  MethodOptions options;
  options.num_disparities = num_disparities;
  options.mode = arguments.mode == "sparse" ? OutputMode::kSparse : OutputMode::kDense;
  options.raw = arguments.mode == "raw";
  options.post_processing = arguments.post_processing;
  options.threads = arguments.threads;
  return options;
}

}  // namespace pomona
