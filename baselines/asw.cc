#include "baselines/asw.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "baselines/asw_rows.h"
#include "baselines/window_method.h"

namespace pomona {

std::span<const MethodInfo> aswMethods();

namespace {

void requireUsable(const AswOptions& options) {
  if (options.radius < 1 || options.radius > kLargestAswRadius)
    throw std::invalid_argument("radius is " + std::to_string(options.radius) + "; allowed: 1 to " +
                                std::to_string(kLargestAswRadius));
  const std::pair<const char*, float> positive[] = {{"color_gamma", options.color_gamma},
                                                    {"proximity_gamma", options.proximity_gamma},
                                                    {"truncation", options.truncation}};
  for (const auto& [name, value] : positive)
    if (!(value > 0 && std::isfinite(value)))
      throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) + "; allowed: above 0");
}

class Asw : public WindowMethod {
  WindowMaps match(const cv::Mat& left, const cv::Mat& right, SearchRange range, WinnerPosition position,
                   int threads) override {
    return matchAsw(left, right, {}, range, position, chooseIsa(""), threads);
  }
};

constexpr MethodInfo kMethods[] = {
    {"asw", "adaptive support weights (Yoon and Kweon 2006), 35x35 window",
     [] { return std::unique_ptr<Method>(new Asw); }},
};

}  // namespace

WindowMaps matchAsw(const cv::Mat& left, const cv::Mat& right, const AswOptions& options, SearchRange range,
                    WinnerPosition position, Isa isa, int threads) {
  requireUsable(options);
  const AswPair pair(left, right, options, range, aswKernels(isa), threads);
  return pickWinners(left.cols, left.rows, range, position, threads,
                     [&](int first_row) { return aswRows(pair, first_row); });
}

std::span<const MethodInfo> aswMethods() {
  return kMethods;
}

}  // namespace pomona
