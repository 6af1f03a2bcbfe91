// A whole plugin: the strongest corners of the left view, ranged by the engine's dense map.
//
//   POMONA_PLUGIN_PATH=build pomona range LEFT RIGHT --calib calib.txt --plugin corners --draw corners.png
#include <pomona/plugin.h>

#include <opencv2/imgproc.hpp>

namespace {

class Corners final : public pomona::SparseStereoPlugin {
 public:
  std::string name() const override { return "corners"; }
  std::string description() const override { return "The strongest corners, ranged by the dense map"; }
  std::vector<pomona::PluginParameter> parameters() const override {
    return {pomona::integerParameter("count", "How many at most", 200, 1, 10000),
            pomona::realParameter("spacing_px", "Smallest distance between two", 8, 1, 1000)};
  }

  pomona::SparseResult run(const pomona::RectifiedPair& pair, const pomona::StereoCalibration& rig,
                           const pomona::PluginInputs& inputs) override {
    cv::Mat gray = pair.left;
    if (gray.channels() == 3) cv::cvtColor(pair.left, gray, cv::COLOR_BGR2GRAY);
    std::vector<cv::Point> corners;
    cv::goodFeaturesToTrack(gray, corners, inputs.settings.integer("count"), 0.01,
                            inputs.settings.real("spacing_px"), inputs.mask);
    const pomona::StereoResult& dense = inputs.dense();
    const cv::Mat points = pomona::pointsFromDisparity(dense.disparity, rig);
    pomona::SparseResult result;
    for (const cv::Point corner : corners) {
      if (!isMeasured(dense.stateAt(corner.y, corner.x))) continue;  // filled is not good enough here
      pomona::SparsePoint point;
      point.disparity_px = dense.disparity.at<float>(corner);
      point.sigma_px = dense.sigma_px.at<float>(corner);
      point.left_px = corner;
      point.right_px = cv::Point2f(corner.x - point.disparity_px, corner.y);
      point.point_m = cv::Point3f(points.at<cv::Vec3f>(corner));
      result.points.push_back(point);
    }
    result.figures = {{"corners", static_cast<double>(corners.size()), ""}};
    return result;
  }
};

}  // namespace

POMONA_PLUGIN(Corners)
