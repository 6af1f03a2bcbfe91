#include "bench/accuracy/methods.h"

#include "bench/accuracy/opencv_peer.h"
#include "pomona/engine.h"

namespace pomona {
namespace {

Method preset(const std::string& name, OutputMode mode) {
  const bool dense = mode == OutputMode::kDense;
  return {name + (dense ? " dense" : " sparse"), dense, name != "paper",
          [name, mode](const cv::Mat& left, const cv::Mat& right, int num_disparities) {
            Options options = Options::preset(name);
            options.mode = mode;
            options.num_disparities = num_disparities;
            return computeDisparity(left, right, options).disparity;
          }};
}

Method peer(bool dense) {
  return {std::string(kPeer) + (dense ? " dense" : " sparse"), dense, false,
          [dense](const cv::Mat& left, const cv::Mat& right, int num_disparities) {
            cv::Mat disparity = matchWithOpenCv(left, right, num_disparities);
            if (dense) fillRowsFromBackground(disparity);
            return disparity;
          }};
}

}  // namespace

std::vector<Method> accuracyMethods() {
  std::vector<Method> methods;
  for (const OutputMode mode : {OutputMode::kDense, OutputMode::kSparse}) {
    for (const char* name : {"fast", "balanced", "quality", "paper"}) methods.push_back(preset(name, mode));
    methods.push_back(peer(mode == OutputMode::kDense));
  }
  return methods;
}

}  // namespace pomona
