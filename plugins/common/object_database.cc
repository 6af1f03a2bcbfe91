#include "plugins/common/object_database.h"

#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

#include "datasets/image_file.h"
#include "plugins/common/likeness.h"

namespace pomona {
namespace {

struct WarpedView {
  cv::Mat gray;
  cv::Matx23d picture_from_view;
};

// The picture as it looks from far away when turned about the vertical axis, on a margin of its border's
// colours. What becomes narrower is blurred first, as a camera would: sigma 0.8 sqrt(t^2 - 1) for a factor t
// (Yu & Morel 2011).
WarpedView turned(const cv::Mat& gray, double yaw_deg) {
  constexpr int kMargin_px = 16;
  const double narrower = std::cos(yaw_deg * CV_PI / 180);
  cv::Mat blurred = gray;
  if (narrower < 1) {
    const double sigma_px = 0.8 * std::sqrt(1 / (narrower * narrower) - 1);
    cv::GaussianBlur(gray, blurred, {2 * cvCeil(3 * sigma_px) + 1, 1}, sigma_px);
  }
  const cv::Size size(cvRound(gray.cols * narrower) + 2 * kMargin_px, gray.rows + 2 * kMargin_px);
  WarpedView view;
  view.picture_from_view = {1 / narrower, 0, -kMargin_px / narrower, 0, 1, -kMargin_px};
  cv::warpAffine(blurred, view.gray, cv::Mat(view.picture_from_view), size,
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return view;
}

void addView(const WarpedView& view, int number, const cv::Size& size, const FeatureFinder& finder,
             Features& all) {
  const Features seen = finder.find(view.gray);
  for (int i = 0; i < seen.count(); ++i) {
    cv::KeyPoint keypoint = seen.keypoints[i];
    const cv::Vec2d at = view.picture_from_view * cv::Vec3d(keypoint.pt.x, keypoint.pt.y, 1);
    if (at[0] < 0 || at[1] < 0 || at[0] > size.width - 1 || at[1] > size.height - 1) continue;
    keypoint.pt = cv::Point2f(static_cast<float>(at[0]), static_cast<float>(at[1]));
    keypoint.class_id = number;
    all.keypoints.push_back(keypoint);
    all.descriptors.push_back(seen.descriptors.row(i));
  }
}

}  // namespace

std::vector<double> wideYaws() {
  return {-60, -45, -30, 30, 45, 60};
}

KnownObject learnObject(const std::string& label, const cv::Mat& picture, const TrainingOptions& options) {
  const FeatureFinder finder(options.kind, options.sensitivity);
  const cv::Mat gray = grayOf(picture);
  KnownObject object{label, picture.size(), thumbnailOf(picture), {}};
  addView(turned(gray, 0), 0, object.size_px, finder, object.features);
  int number = 0;
  for (const double yaw : options.yaws_deg) {
    if (!(std::abs(yaw) <= 75)) {
      std::ostringstream message;
      message << label << ": yaws_deg is " << yaw << "; allowed: -75 to 75";
      throw std::invalid_argument(message.str());
    }
    addView(turned(gray, yaw), ++number, object.size_px, finder, object.features);
  }
  return object;
}

ObjectDatabase openObjects(const std::string& paths, const TrainingOptions& options) {
  ObjectDatabase database{options.kind, {}};
  std::istringstream list(paths);
  for (std::string path; std::getline(list, path, ',');) {
    if (path.empty())
      throw std::invalid_argument("objects is '" + paths +
                                  "': it has an empty name; allowed: names separated by "
                                  "single commas");
    const std::string extension = std::filesystem::path(path).extension();
    if (extension == ".objects" && path == paths) return readObjectDatabase(path);
    if (extension == ".objects")
      throw std::invalid_argument("objects is '" + paths + "'; allowed: one database, or pictures");
    const cv::Mat picture = readImage(path);
    if (picture.type() != CV_8UC1 && picture.type() != CV_8UC3)
      throw std::runtime_error(path + ": has " + describeType(picture) +
                               "; allowed: 1 or 3 channels of 8 bits");
    database.objects.push_back(learnObject(std::filesystem::path(path).stem(), picture, options));
  }
  if (database.objects.empty())
    throw std::invalid_argument(
        "objects is ''; allowed: a database (.objects), or pictures separated by commas");
  return database;
}

}  // namespace pomona
