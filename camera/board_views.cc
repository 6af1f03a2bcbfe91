#include "camera/board_views.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pomona {
namespace {

// Corners of a picture taken once more scatter by some hundredths of a pixel; another place of the board, or
// of the camera, moves them by many pixels.
constexpr double kLeastMotion_px = 0.5;

bool coincide(const std::vector<cv::Point2f>& a, const std::vector<cv::Point2f>& b) {
  return cv::norm(a, b, cv::NORM_INF) < kLeastMotion_px;
}

// The longest way of a corner's mean motion from one used view to another, in the left image.
double largestMotionPx(const std::vector<BoardView>& views, const CalibrationReport& report) {
  std::vector<cv::Point2d> means;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!report.views[i].rejected.empty()) continue;
    cv::Point2d mean;
    for (const cv::Point2f& corner : views[i].left)
      mean += cv::Point2d(corner) / static_cast<double>(views[i].left.size());
    means.push_back(mean);
  }
  double largest = 0;
  for (const cv::Point2d& a : means)
    for (const cv::Point2d& b : means) largest = std::max(largest, cv::norm(a - b));
  return largest;
}

std::string listOf(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 3;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) list += (i > 0 ? ", " : "") + names[i];
  return names.size() > kMost ? list + " and " + std::to_string(names.size() - kMost) + " more" : list;
}

}  // namespace

void rejectAlike(const std::vector<BoardView>& views, CalibrationReport& report) {
  std::vector<const BoardView*> different;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const BoardView& view = views[i];
    std::string& rejected = report.views[i].rejected;
    if (!rejected.empty()) continue;
    const auto repeated = std::find_if(different.begin(), different.end(), [&](const BoardView* other) {
      return coincide(view.left, other->left) && coincide(view.right, other->right);
    });
    if (coincide(view.left, view.right))
      rejected = "left and right show the board in the same place: is it one picture, or one camera, twice?";
    else if (repeated != different.end())
      rejected = "the board is in the same place as in " + (*repeated)->name;
    else
      different.push_back(&view);
  }
}

std::string tooFewViews(const CalibrationReport& report, int needed) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;  // in the order of the views
  for (const CalibrationReport::View& view : report.views) {
    if (view.rejected.empty()) continue;
    auto reason = std::find_if(reasons.begin(), reasons.end(),
                               [&](const auto& known) { return known.first == view.rejected; });
    if (reason == reasons.end()) reason = reasons.insert(reason, {view.rejected, {}});
    reason->second.push_back(view.name);
  }
  const auto used = std::count_if(report.views.begin(), report.views.end(),
                                  [](const CalibrationReport::View& view) { return view.rejected.empty(); });
  std::string text = std::to_string(used) + " of " + std::to_string(report.views.size()) +
                     " views can be used; at least " + std::to_string(needed) + " are needed";
  const char* separator = "; rejected: ";
  for (const auto& [reason, names] : reasons) {
    text += separator + listOf(names) + " (" + reason + ")";
    separator = ", ";
  }
  return text;
}

std::string impossibleCameras(const std::vector<BoardView>& views, const CalibrationReport& report,
                              cv::Size image_size, const std::string& reason) {
  constexpr double kLittle = 0.1;  // of the image's width
  const double motion_px = largestMotionPx(views, report);
  if (motion_px < kLittle * image_size.width)
    return "the views are too alike to calibrate by: the board moves by " +
           std::to_string(std::lround(motion_px)) +
           " px at most (the cameras that fit them best have: " + reason + ")";
  return "no possible cameras fit the views: " + reason +
         " (do the pictures belong together, and was the board tilted?)";
}

}  // namespace pomona
