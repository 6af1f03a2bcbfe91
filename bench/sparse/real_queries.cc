#include "bench/sparse/real_queries.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "datasets/scene.h"

namespace pomona {

const std::vector<RealQuery>& realQueries() {
  static const std::vector<RealQuery> queries = {
      {"Books", "proceedings", {186, 8, 116, 128}, 1.4, 12, 0.8, 0},
      {"Books", "green cover", {340, 20, 110, 110}, 0.8, -15, 1.1, 10},
      {"Books", "page", {64, 158, 62, 150}, 1.3, 8, 1.2, 5},
      {"Reindeer", "box", {50, 292, 130, 70}, 1.5, -10, 1.3, 0},
      {"Monopoly", "board", {325, 60, 50, 150}, 1.3, 10, 0.85, 0},
      {"Baby1", "map", {342, 90, 68, 130}, 1.3, -20, 0.8, 15},
      {"Motorcycle", "shelf with boxes", {525, 30, 110, 75}, 1.2, 10, 1.2, 0},
      {"venus", "newspaper", {300, 215, 110, 110}, 0.9, 15, 0.8, 0},
      {"barn1", "newspaper", {20, 180, 105, 100}, 0.8, 10, 1.1, 0},
  };
  return queries;
}

cv::Mat pictureOf(const RealQuery& query, const cv::Mat& left) {
  const cv::Rect& place = query.place;
  const cv::Size size(cvRound(place.width * query.scale), cvRound(place.height * query.scale));
  const cv::Point2f middle(static_cast<float>(place.x) + static_cast<float>(place.width - 1) / 2,
                           static_cast<float>(place.y) + static_cast<float>(place.height - 1) / 2);
  cv::Mat to_picture = cv::getRotationMatrix2D(middle, query.turn_deg, query.scale);
  to_picture.at<double>(0, 2) += (size.width - 1) / 2.0 - middle.x;
  to_picture.at<double>(1, 2) += (size.height - 1) / 2.0 - middle.y;
  cv::Mat picture;
  cv::warpAffine(left, picture, to_picture, size, cv::INTER_CUBIC, cv::BORDER_REFLECT);
  picture.convertTo(picture, -1, query.gain, query.offset);
  return picture;
}

RealPair realPair(const RealQuery& query, const std::string& folder) {
  namespace fs = std::filesystem;
  fs::path found = fs::path(folder) / query.scene;
  for (auto entry = fs::directory_iterator(folder); !fs::exists(found) && entry != fs::directory_iterator();
       ++entry)
    found = entry->path() / query.scene;
  if (!fs::exists(found)) throw std::runtime_error(folder + ": has no scene " + query.scene);
  const Scene scene = readScene(found.string());
  RealPair pair{scene.left, scene.right, {}, medianDisparity(scene.ground_truth, query.place)};
  if (scene.calibration) {
    pair.calibration = scene.calibration->stereo;
  } else {
    pair.calibration.focal_px = scene.left.cols;
    pair.calibration.cx_px = scene.left.cols / 2.0;
    pair.calibration.cy_px = scene.left.rows / 2.0;
    pair.calibration.baseline_m = 0.1;
  }
  return pair;
}

double disparityOf(const StereoCalibration& calibration, double z_m) {
  return calibration.focal_px * calibration.baseline_m / z_m - calibration.doffs_px;
}

double medianDisparity(const cv::Mat& disparity, const cv::Rect& place) {
  const cv::Rect middle(place.x + place.width / 3, place.y + place.height / 3, std::max(1, place.width / 3),
                        std::max(1, place.height / 3));
  std::vector<float> known;
  for (int y = middle.y; y < middle.br().y; ++y)
    for (int x = middle.x; x < middle.br().x; ++x)
      if (std::isfinite(disparity.at<float>(y, x))) known.push_back(disparity.at<float>(y, x));
  if (known.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::nth_element(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2), known.end());
  return known[known.size() / 2];
}

}  // namespace pomona
