#include "drawing.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/highgui.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace {

constexpr const char* kWindow = "harvest";

cv::Mat draw(const cv::Mat& bgr, const std::vector<Pick>& picks) {
  cv::Mat picture = bgr.clone();
  for (const auto& [box, where] : picks) {
    const cv::Scalar color = where.ok() ? cv::Scalar(255, 255, 255) : cv::Scalar(128, 128, 128);
    cv::rectangle(picture, box, color, 2);
    const std::string text = where.ok() ? cv::format("%.0f +- %.0f mm", 1000 * where.distance_m,
                                                     std::ceil(2000 * where.distance_sigma_m))
                                        : "?";
    cv::putText(picture, text, box.tl() + cv::Point(0, -6), cv::FONT_HERSHEY_SIMPLEX, 0.5, color, 1,
                cv::LINE_AA);
  }
  return picture;
}

}  // namespace

Drawing::Drawing(const std::string& target) {
  if (target == "window") {
    if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY"))
      throw std::runtime_error("window: there is no display to show it on");
    cv::namedWindow(kWindow);
    return;
  }
  if (!std::filesystem::is_directory(target) || ::access(target.c_str(), W_OK | X_OK) != 0)
    throw std::runtime_error(target + ": is no folder that can be written to");
  folder_ = target;
}

bool Drawing::show(int frame, const cv::Mat& bgr, const std::vector<Pick>& picks) const {
  const cv::Mat picture = draw(bgr, picks);
  if (folder_.empty()) {
    constexpr int kEscape = 27;
    cv::imshow(kWindow, picture);
    return cv::waitKey(1) != kEscape;
  }
  const std::string file = cv::format("%s/frame%04d.jpg", folder_.c_str(), frame);
  if (!cv::imwrite(file, picture)) throw std::runtime_error(file + ": cannot be written");
  return true;
}
