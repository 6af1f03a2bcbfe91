#include "plugins/common/object_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace pomona {
namespace {

std::string few(std::size_t count, int needed, const char* what) {
  return std::to_string(count) + " of at least " + std::to_string(needed) + " " + what;
}

cv::Point2d middleOf(cv::Size size) {
  return {(size.width - 1) / 2.0, (size.height - 1) / 2.0};
}

std::vector<cv::Point2f> outlineOf(const cv::Matx33d& image_from_picture, cv::Size size) {
  const double right = size.width - 1, bottom = size.height - 1;
  std::vector<cv::Point2f> outline;
  for (const cv::Point2d corner : {cv::Point2d(0, 0), {right, 0}, {right, bottom}, {0, bottom}})
    outline.emplace_back(mapped(image_from_picture, corner));
  return outline;
}

// Whether the picture's corners are all in front of the camera, in their order, around a sensible area.
bool isPlausible(const cv::Matx33d& h, const std::vector<cv::Point2f>& outline, cv::Size size,
                 const LocateOptions& options) {
  const double right = size.width - 1, bottom = size.height - 1;
  for (const cv::Vec3d& corner :
       {cv::Vec3d(0, 0, 1), cv::Vec3d(right, 0, 1), cv::Vec3d(right, bottom, 1), cv::Vec3d(0, bottom, 1)})
    if ((h * corner)[2] * h(2, 2) <= 0) return false;
  constexpr bool kSigned = true;
  return cv::isContourConvex(outline) && cv::contourArea(outline, kSigned) >= options.min_area_px;
}

struct PlacedMatch {
  ObjectMatch match;
  cv::KeyPoint in_picture, in_image;
};

struct Agreement {
  cv::Matx33d image_from_picture = cv::Matx33d::eye();
  std::vector<PlacedMatch> matches;
};

// Matches whose features are turned by nearly the same angle: those of one object are, whatever its slant, to
// within some 25 degrees (Lowe 2004 votes likewise).
std::vector<PlacedMatch> turnedAlike(const std::vector<PlacedMatch>& matches) {
  constexpr int kBins = 36, kReach = 2;
  const auto bin_of = [](const PlacedMatch& m) {
    const double turn = std::fmod(m.in_image.angle - m.in_picture.angle + 720, 360.0);
    return std::min(kBins - 1, static_cast<int>(turn * kBins / 360));
  };
  std::array<int, kBins> counts{};
  for (const PlacedMatch& m : matches)
    for (int k = -kReach; k <= kReach; ++k) ++counts[(bin_of(m) + k + kBins) % kBins];
  const int best = static_cast<int>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  std::vector<PlacedMatch> alike;
  for (const PlacedMatch& m : matches) {
    const int off = std::abs(bin_of(m) - best);
    if (std::min(off, kBins - off) <= kReach) alike.push_back(m);
  }
  return alike;
}

Agreement agreementWith(const cv::Matx33d& image_from_picture, const std::vector<PlacedMatch>& matches,
                        double reach_px) {
  Agreement agreement{image_from_picture, {}};
  for (const PlacedMatch& m : matches) {
    const cv::Point2d expected = mapped(image_from_picture, m.in_picture.pt);
    if (std::hypot(expected.x - m.in_image.pt.x, expected.y - m.in_image.pt.y) <= reach_px)
      agreement.matches.push_back(m);
  }
  return agreement;
}

constexpr int kTries = 5000;
constexpr double kCertainty = 0.9999;

void placesOf(const std::vector<PlacedMatch>& matches, std::vector<cv::Point2f>& in_picture,
              std::vector<cv::Point2f>& in_image) {
  for (const PlacedMatch& m : matches) {
    in_picture.push_back(m.in_picture.pt);
    in_image.push_back(m.in_image.pt);
  }
}

Agreement homography(const std::vector<PlacedMatch>& matches, double reach_px) {
  if (matches.size() < 4) return {};
  std::vector<cv::Point2f> in_picture, in_image;
  placesOf(matches, in_picture, in_image);
  const cv::Mat h =
      cv::findHomography(in_picture, in_image, cv::RANSAC, reach_px, cv::noArray(), kTries, kCertainty);
  return h.empty() ? Agreement() : agreementWith(h, matches, reach_px);
}

std::optional<cv::Matx33d> affineMap(const std::vector<cv::Point2f>& from, const std::vector<cv::Point2f>& to,
                                     double reach_px) {
  const cv::Mat a = cv::estimateAffine2D(from, to, cv::noArray(), cv::RANSAC, reach_px, kTries, kCertainty);
  if (a.empty()) return std::nullopt;
  return cv::Matx33d(a.at<double>(0, 0), a.at<double>(0, 1), a.at<double>(0, 2), a.at<double>(1, 0),
                     a.at<double>(1, 1), a.at<double>(1, 2), 0, 0, 1);
}

// Small or distant objects show next to no perspective: a homography of their few matches bends at will.
Agreement affineFirst(const std::vector<PlacedMatch>& matches, double reach_px) {
  constexpr double kBend = 3;  // how much farther off than `reach_px` perspective may put a match
  std::vector<cv::Point2f> in_picture, in_image;
  placesOf(matches, in_picture, in_image);
  const std::optional<cv::Matx33d> affine = affineMap(in_picture, in_image, reach_px);
  if (!affine) return {};
  Agreement flat = agreementWith(*affine, matches, reach_px);
  Agreement bent = homography(agreementWith(*affine, matches, kBend * reach_px).matches, reach_px);
  return bent.matches.size() > flat.matches.size() ? bent : flat;
}

// The affine map into a plane whose perspective is known: `plane` gives 1/Z, up to a factor, so it says where
// the plane's horizon is (Hartley & Zisserman 2004, 8.6), and x / plane(x, y), y / plane(x, y) are affine
// coordinates on it. They are scaled to be pixels at the plane's origin.
Agreement affineOnPlane(const std::vector<PlacedMatch>& matches, const DisparityPlane& plane,
                        double reach_px) {
  const double d0 = plane.disparity_px, x0 = plane.origin_px.x, y0 = plane.origin_px.y;
  const cv::Matx33d flat_from_image(d0, 0, -x0 * d0, 0, d0, -y0 * d0, plane.slope_x, plane.slope_y,
                                    d0 - plane.slope_x * x0 - plane.slope_y * y0);
  std::vector<PlacedMatch> before_horizon;
  for (const PlacedMatch& m : matches)
    if (plane.at(m.in_image.pt) > 0) before_horizon.push_back(m);
  std::vector<cv::Point2f> in_picture, in_plane;
  placesOf(before_horizon, in_picture, in_plane);
  for (cv::Point2f& at : in_plane) at = mapped(flat_from_image, at);
  if (d0 <= 0 || in_plane.size() < 3) return {};
  const std::optional<cv::Matx33d> affine = affineMap(in_picture, in_plane, reach_px);
  if (!affine) return {};
  return agreementWith(flat_from_image.inv() * *affine, before_horizon, reach_px);
}

// The standard deviation of where the picture's middle is, along each axis: an affine map's, fitted to the
// matches, by what they are off. The farther the middle is from them, the larger.
double middleSigma(const Agreement& agreement, cv::Size size) {
  cv::Matx33d normal = cv::Matx33d::zeros();
  double squares = 0;
  for (const PlacedMatch& m : agreement.matches) {
    const cv::Vec3d row(m.in_picture.pt.x - middleOf(size).x, m.in_picture.pt.y - middleOf(size).y, 1);
    normal += row * row.t();
    const cv::Point2d off =
        mapped(agreement.image_from_picture, m.in_picture.pt) - cv::Point2d(m.in_image.pt);
    squares += off.dot(off);
  }
  const double freedom = std::max(1.0, 2.0 * static_cast<double>(agreement.matches.size()) - 6);
  return std::sqrt(squares / freedom * std::max(0.0, normal.inv(cv::DECOMP_SVD)(2, 2)));
}

// `matches` of one object that are distinct enough.
std::vector<PlacedMatch> usable(const KnownObject& object, int object_number,
                                const std::vector<cv::KeyPoint>& keypoints,
                                std::span<const ObjectMatch> matches, const LocateOptions& options) {
  std::vector<PlacedMatch> used;
  for (const ObjectMatch& match : matches)
    if (match.object == object_number && match.ratio <= options.ratio)
      used.push_back({match, object.features.keypoints[match.feature], keypoints[match.query]});
  return options.model == PlaceModel::kAffineFirst ? turnedAlike(used) : used;
}

ObjectPlace placeBy(const Agreement& agreement, cv::Size size, const LocateOptions& options) {
  ObjectPlace place;
  for (const PlacedMatch& placed : agreement.matches) place.agreeing.push_back(placed.match);
  if (static_cast<int>(place.agreeing.size()) < options.min_agreeing) {
    place.why_not = few(place.agreeing.size(), options.min_agreeing, "matches agree on a place");
    return place;
  }
  place.image_from_picture = agreement.image_from_picture;
  place.outline_px = outlineOf(place.image_from_picture, size);
  place.middle_px = mapped(place.image_from_picture, middleOf(size));
  place.middle_sigma_px = middleSigma(agreement, size);
  if (!isPlausible(place.image_from_picture, place.outline_px, size, options)) {
    place.why_not = "the matches agree on no plausible outline";
    place.outline_px.clear();
  }
  return place;
}

}  // namespace

ObjectPlace locateObject(const KnownObject& object, int object_number,
                         const std::vector<cv::KeyPoint>& keypoints, std::span<const ObjectMatch> matches,
                         const LocateOptions& options) {
  ObjectPlace place;
  if (object.features.count() == 0) {
    place.why_not = "its picture has no features to recognise it by";
    return place;
  }
  const std::vector<PlacedMatch> used = usable(object, object_number, keypoints, matches, options);
  if (static_cast<int>(used.size()) < options.min_agreeing) {
    place.why_not = few(used.size(), options.min_agreeing, "features match");
    return place;
  }
  return placeBy(options.model == PlaceModel::kAffineFirst ? affineFirst(used, options.reprojection_px)
                                                           : homography(used, options.reprojection_px),
                 object.size_px, options);
}

ObjectPlace locateOnPlane(const KnownObject& object, int object_number,
                          const std::vector<cv::KeyPoint>& keypoints, std::span<const ObjectMatch> matches,
                          const DisparityPlane& plane, const LocateOptions& options) {
  return placeBy(affineOnPlane(usable(object, object_number, keypoints, matches, options), plane,
                               options.reprojection_px),
                 object.size_px, options);
}

cv::Point2d mapped(const cv::Matx33d& image_from_picture, const cv::Point2d& place) {
  const cv::Vec3d at = image_from_picture * cv::Vec3d(place.x, place.y, 1);
  return {at[0] / at[2], at[1] / at[2]};
}

}  // namespace pomona
