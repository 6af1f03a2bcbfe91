#include "camera/calibrate.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <opencv2/calib3d.hpp>
#include <sstream>
#include <stdexcept>

#include "camera/board_views.h"
#include "camera/deviations.h"

namespace pomona {
namespace {

constexpr int kFewestViews = 3;

double fit(const std::vector<const BoardView*>& views, cv::Size size, const BoardSize& board, bool rational,
           StereoRig& rig) {
  std::vector<cv::Point3f> target;
  for (const cv::Vec3d& corner : boardCorners(board)) target.emplace_back(corner);
  const std::vector<std::vector<cv::Point3f>> targets(views.size(), target);
  std::vector<std::vector<cv::Point2f>> left, right;
  for (const BoardView* view : views) {
    left.push_back(view->left);
    right.push_back(view->right);
  }
  const int flags = rational ? cv::CALIB_RATIONAL_MODEL : 0;
  const cv::TermCriteria until(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 200, 1e-10);
  cv::Mat m[2], d[2], r, t, e, f;
  cv::calibrateCamera(targets, left, size, m[0], d[0], cv::noArray(), cv::noArray(), flags, until);
  cv::calibrateCamera(targets, right, size, m[1], d[1], cv::noArray(), cv::noArray(), flags, until);
  const double rms = cv::stereoCalibrate(targets, left, right, m[0], d[0], m[1], d[1], size, r, t, e, f,
                                         flags | cv::CALIB_USE_INTRINSIC_GUESS, until);
  for (int i = 0; i < 2; ++i) {
    CameraModel& camera = i == 0 ? rig.left : rig.right;
    camera.width = size.width;
    camera.height = size.height;
    camera.fx_px = m[i].at<double>(0, 0);
    camera.fy_px = m[i].at<double>(1, 1);
    camera.cx_px = m[i].at<double>(0, 2);
    camera.cy_px = m[i].at<double>(1, 2);
    const int count = std::min(static_cast<int>(d[i].total()), rational ? 8 : 5);
    for (int k = 0; k < count; ++k) camera.distortion[static_cast<std::size_t>(k)] = d[i].at<double>(k);
  }
  rig.right_from_left_rotation = r;
  rig.right_from_left_m = t;
  return rms;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string shown(double value, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

// |y_left - y_right| of every corner of a view, rectified.
std::vector<double> epipolarErrors(const BoardView& view, const StereoRig& rig, const Rectification& r) {
  const auto rowOf = [&](const CameraModel& camera, const cv::Matx33d& rotation, const cv::Point2f& corner) {
    const cv::Vec2d d = camera.directionOf({corner.x, corner.y});
    const cv::Vec3d turned = rotation * cv::Vec3d(d[0], d[1], 1);
    return r.calibration.focal_px * turned[1] / turned[2];
  };
  std::vector<double> errors;
  for (std::size_t i = 0; i < view.left.size(); ++i)
    errors.push_back(std::abs(rowOf(rig.left, r.left_rotation, view.left[i]) -
                              rowOf(rig.right, r.right_rotation, view.right[i])));
  return errors;
}

// Judges the views by the fit; those far worse than the rest are marked. True if there were such.
bool rejectOutliers(const std::vector<Sighting>& sightings, double factor, CalibrationReport& report) {
  std::vector<double> rms;
  for (const Sighting& s : sightings)
    rms.push_back(std::sqrt(s.squared_error_px2 / (2.0 * static_cast<double>(s.view->left.size()))));
  const double usual = median(rms);
  bool any = false;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    CalibrationReport::View& view = report.views[sightings[i].index];
    view.rms_px = rms[i];
    if (factor <= 0 || rms[i] <= factor * usual) continue;
    view.rejected = "rms " + shown(rms[i], 2) + " px, the median is " + shown(usual, 2);
    any = true;
  }
  return any;
}

void measureEpipolarErrors(const std::vector<Sighting>& sightings, CalibrationReport& report) {
  std::vector<double> all;
  for (const Sighting& s : sightings) {
    const std::vector<double> errors = epipolarErrors(*s.view, report.rig, *report.rig.rectification);
    double sum = 0;
    for (const double e : errors) sum += e;
    report.views[s.index].epipolar_px = sum / static_cast<double>(errors.size());
    all.insert(all.end(), errors.begin(), errors.end());
  }
  double sum = 0;
  for (const double e : all) sum += e;
  report.epipolar_mean_px = sum / static_cast<double>(all.size());
  const auto p95 = all.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(all.size()));
  std::nth_element(all.begin(), p95, all.end());
  report.epipolar_p95_px = *p95;
}

bool isLike(const Sighting& a, const Sighting& b) {
  constexpr double kAngle = 0.05;     // radians
  constexpr double kDistance = 0.03;  // of the board's distance
  cv::Matx33d ra, rb;
  cv::Rodrigues(a.rotation, ra);
  cv::Rodrigues(b.rotation, rb);
  cv::Vec3d between;
  cv::Rodrigues(ra * rb.t(), between);
  return cv::norm(between) < kAngle &&
         cv::norm(a.translation_m - b.translation_m) < kDistance * cv::norm(a.translation_m);
}

// The largest angle between two positions of the board, whatever the turn in its own plane.
double largestTilt(const std::vector<Sighting>& sightings) {
  double largest = 0;
  std::vector<cv::Vec3d> normals;
  for (const Sighting& s : sightings) {
    cv::Matx33d r;
    cv::Rodrigues(s.rotation, r);
    normals.emplace_back(r(0, 2), r(1, 2), r(2, 2));
    for (const cv::Vec3d& n : normals)
      largest = std::max(largest, std::acos(std::clamp(n.dot(normals.back()), -1.0, 1.0)));
  }
  return largest;
}

void addWarnings(const std::vector<Sighting>& sightings, CalibrationReport& report) {
  constexpr std::size_t kEnoughViews = 10;
  constexpr double kEnoughCoverage = 0.5, kEnoughTilt = 0.35;  // radians
  constexpr double kGoodRms_px = 0.5, kGoodEpipolar_px = 0.3;
  auto& warnings = report.warnings;
  if (sightings.size() < kEnoughViews)
    warnings.push_back("only " + std::to_string(sightings.size()) + " views; 10 to 30 are good");
  std::size_t repeats = 0;
  for (std::size_t i = 0; i < sightings.size(); ++i)
    repeats += std::any_of(sightings.begin(), sightings.begin() + static_cast<std::ptrdiff_t>(i),
                           [&](const Sighting& other) { return isLike(sightings[i], other); });
  if (repeats > 0)
    warnings.push_back(std::to_string(repeats) +
                       (repeats == 1 ? " view repeats another" : " views repeat others") +
                       ": board in the same place within 3 %, turned "
                       "by less than 3 degrees");
  if (largestTilt(sightings) < kEnoughTilt)
    warnings.push_back(
        "the board was never tilted by more than 20 degrees: focal length and distance cannot be "
        "told apart well");
  const auto covered = [&](const char* side, double share) {
    if (share < kEnoughCoverage)
      warnings.push_back(std::string("corners in only ") + shown(100 * share, 0) + " % of the " + side +
                         " image: the lens is guessed elsewhere (see the coverage picture)");
  };
  covered("left", report.left_coverage);
  covered("right", report.right_coverage);
  if (report.rms_px > kGoodRms_px)
    warnings.push_back("rms " + shown(report.rms_px, 2) +
                       " px is more than 0.5: blurred pictures, a bent board, or "
                       "cameras that did not expose at the same time?");
  if (report.epipolar_mean_px > kGoodEpipolar_px)
    warnings.push_back("epipolar error " + shown(report.epipolar_mean_px, 2) +
                       " px is more than 0.3: matching will "
                       "suffer");
}

}  // namespace

CalibrationReport calibrateStereo(const std::vector<BoardView>& views, cv::Size image_size,
                                  const BoardSize& board, const CalibrateOptions& options) {
  board.validate();
  const std::vector<cv::Vec3d> corners = boardCorners(board);
  CalibrationReport report;
  for (const BoardView& view : views) report.views.push_back({view.name, view.rejected, 0, 0});
  rejectAlike(views, report);
  std::vector<const BoardView*> used;
  std::vector<Sighting> sightings;
  for (bool again = true; again;) {
    used.clear();
    for (std::size_t i = 0; i < views.size(); ++i)
      if (report.views[i].rejected.empty()) used.push_back(&views[i]);
    if (static_cast<int>(used.size()) < kFewestViews)
      throw std::invalid_argument(tooFewViews(report, kFewestViews));
    report.rig = {};
    report.rms_px = fit(used, image_size, board, options.rational, report.rig);
    sightings.clear();
    for (const BoardView* view : used) {
      sightings.push_back(locateBoard(*view, report.rig, corners));
      sightings.back().index = static_cast<std::size_t>(view - views.data());
    }
    again = rejectOutliers(sightings, options.outlier_factor, report);
  }
  report.used_views = static_cast<int>(used.size());
  try {
    report.rig.rectification = rectificationOf(report.rig);
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(impossibleCameras(views, report, image_size, e.what()));
  }
  measureEpipolarErrors(sightings, report);
  estimateDeviations(sightings, corners, options.rational ? 8 : 5, report);
  std::vector<BoardView> kept;
  for (const BoardView* view : used) kept.push_back(*view);
  const auto coverage = coverageOf(kept, image_size);
  report.left_coverage = coverage[0];
  report.right_coverage = coverage[1];
  addWarnings(sightings, report);
  return report;
}

}  // namespace pomona
