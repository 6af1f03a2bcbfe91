#include "plugins/common/object_place.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "plugins/common/likeness.h"
#include "plugins/common/placed_match.h"

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

// Whether the picture's corners are all in front of the camera, none much farther than another, in their
// order, around a sensible area.
bool isPlausible(const cv::Matx33d& h, cv::Size size, const LocateOptions& options) {
  constexpr double kFarthest = 3;  // of the nearest corner's depth
  constexpr bool kSigned = true;
  const double right = size.width - 1, bottom = size.height - 1;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const cv::Vec3d& corner :
       {cv::Vec3d(0, 0, 1), cv::Vec3d(right, 0, 1), cv::Vec3d(right, bottom, 1), cv::Vec3d(0, bottom, 1)}) {
    const double depth = (h * corner)[2] / h(2, 2);
    least = std::min(least, depth);
    most = std::max(most, depth);
  }
  if (!(least > 0 && most <= kFarthest * least)) return false;
  const std::vector<cv::Point2f> outline = outlineOf(h, size);
  return cv::isContourConvex(outline) && cv::contourArea(outline, kSigned) >= options.min_area_px;
}

struct Agreement {
  cv::Matx33d image_from_picture = cv::Matx33d::eye();
  std::vector<PlacedMatch> matches;
};

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
Agreement affineFirst(const std::vector<PlacedMatch>& matches, cv::Size size, const LocateOptions& options) {
  const double reach_px = options.reprojection_px;
  constexpr double kBend = 3;  // how much farther off than `reach_px` perspective may put a match
  std::vector<cv::Point2f> in_picture, in_image;
  placesOf(matches, in_picture, in_image);
  const std::optional<cv::Matx33d> affine = affineMap(in_picture, in_image, reach_px);
  if (!affine) return {};
  if (!isPlausible(*affine, size, options)) return {};
  Agreement flat = agreementWith(*affine, matches, reach_px);
  Agreement bent = homography(agreementWith(*affine, matches, kBend * reach_px).matches, reach_px);
  const bool better = bent.matches.size() > flat.matches.size();
  return better && isPlausible(bent.image_from_picture, size, options) ? bent : flat;
}

// The affine map into a plane whose perspective is known: `plane` gives 1/Z, up to a factor, so it says where
// the plane's horizon is (Hartley & Zisserman 2004, 8.6), and x / plane(x, y), y / plane(x, y) are affine
// coordinates on it. They are scaled to be pixels at the plane's origin.
Agreement affineOnPlane(const std::vector<PlacedMatch>& matches, const DisparityPlane& plane, cv::Size size,
                        const LocateOptions& options) {
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
  const std::optional<cv::Matx33d> affine = affineMap(in_picture, in_plane, options.reprojection_px);
  if (!affine) return {};
  const cv::Matx33d image_from_picture = flat_from_image.inv() * *affine;
  if (!isPlausible(image_from_picture, size, options)) return {};
  return agreementWith(image_from_picture, before_horizon, options.reprojection_px);
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

ObjectPlace notFound(std::string why) {
  ObjectPlace place;
  place.why_not = std::move(why);
  return place;
}

ObjectPlace placeBy(const Agreement& agreement, cv::Size size, int min_agreeing,
                    const LocateOptions& options) {
  ObjectPlace place;
  for (const PlacedMatch& placed : agreement.matches) place.agreeing.push_back(placed.match);
  if (static_cast<int>(place.agreeing.size()) < min_agreeing) {
    place.why_not = few(place.agreeing.size(), min_agreeing, "matches agree on a place");
    return place;
  }
  place.image_from_picture = agreement.image_from_picture;
  place.outline_px = outlineOf(place.image_from_picture, size);
  place.middle_px = mapped(place.image_from_picture, middleOf(size));
  place.middle_sigma_px = middleSigma(agreement, size);
  if (!isPlausible(place.image_from_picture, size, options)) {
    place.why_not = "the matches agree on no plausible outline";
    place.outline_px.clear();
  }
  return place;
}

// Finds a map by matches that are distinct, then by all that it guides to.
class Locator {
 public:
  using Fit = std::function<Agreement(const std::vector<PlacedMatch>&)>;

  Locator(const KnownObject& object, int number, const SeenView& view, const LocateOptions& options)
      : object_(object), number_(number), view_(view), options_(options) {}

  // Of what the likeliest groups of matches say, the place that is most like the picture.
  ObjectPlace locate(const Fit& fit) const {
    constexpr int kGroups = 8;
    const std::vector<PlacedMatch> distinct = placedMatches(object_, number_, view_, options_.ratio);
    if (static_cast<int>(distinct.size()) < kSeeds)
      return notFound(few(distinct.size(), kSeeds, "features match"));
    Agreement best;
    int places = 0;
    bool enough = false;
    double most_like = -1;
    for (const std::vector<PlacedMatch>& group : likelyGroups(distinct, kGroups)) {
      Agreement found = guided(fit(group), fit);
      const int agreeing = distinctPlaces(found.matches);
      places = std::max(places, agreeing);
      if (agreeing < fewestAgreeing()) continue;
      const double like = likeness(object_.thumbnail, object_.size_px, view_.gray, found.image_from_picture);
      if (agreeing < options_.min_agreeing && like < kSurelyAlike) continue;
      enough = true;
      if (like <= most_like && !best.matches.empty()) continue;
      most_like = like;
      best = std::move(found);
    }
    if (!enough) return notFound(few(places, options_.min_agreeing, "matches agree on a place"));
    if (most_like < options_.min_likeness) return notFound(unlike(places, most_like));
    return placeBy(best, object_.size_px, fewestAgreeing(), options_);
  }

 private:
  static constexpr int kSeeds = 4;
  static constexpr double kSurelyAlike = 0.9;

  // Of small pictures few features are seen. Two fewer do where the view is as good as equal to the picture.
  int fewestAgreeing() const { return std::max(kSeeds, options_.min_agreeing - 2); }

  std::string unlike(int places, double like) const {
    char text[96];
    std::snprintf(text, sizeof(text),
                  "%d matches agree on a place, but what is there is not like it (%.2f of %.2f)", places,
                  like, options_.min_likeness);
    return text;
  }

  Agreement guided(Agreement agreement, const Fit& fit) const {
    constexpr int kRounds = 3;
    constexpr double kBend = 2;  // how much farther off than what agrees with a first map others may be
    for (int round = 0; round < kRounds && distinctPlaces(agreement.matches) >= kSeeds; ++round) {
      Agreement next = fit(guidedMatches(object_, number_, view_, agreement.image_from_picture,
                                         agreement.matches, kBend * options_.reprojection_px));
      if (next.matches.size() <= agreement.matches.size()) break;
      agreement = std::move(next);
    }
    return agreement;
  }

  const KnownObject& object_;
  int number_;
  const SeenView& view_;
  const LocateOptions& options_;
};

}  // namespace

ObjectPlace locateObject(const KnownObject& object, int object_number, const SeenView& view,
                         const LocateOptions& options) {
  if (object.features.count() == 0) return notFound("its picture has no features to recognise it by");
  if (options.model == PlaceModel::kAffineFirst)
    return Locator(object, object_number, view, options).locate([&](const std::vector<PlacedMatch>& some) {
      return affineFirst(some, object.size_px, options);
    });
  const std::vector<PlacedMatch> distinct = placedMatches(object, object_number, view, options.ratio);
  if (static_cast<int>(distinct.size()) < options.min_agreeing)
    return notFound(few(distinct.size(), options.min_agreeing, "features match"));
  return placeBy(homography(distinct, options.reprojection_px), object.size_px, options.min_agreeing,
                 options);
}

ObjectPlace locateOnPlane(const KnownObject& object, int object_number, const SeenView& view,
                          const DisparityPlane& plane, const LocateOptions& options) {
  return Locator(object, object_number, view, options).locate([&](const std::vector<PlacedMatch>& some) {
    return affineOnPlane(some, plane, object.size_px, options);
  });
}

cv::Point2d mapped(const cv::Matx33d& image_from_picture, const cv::Point2d& place) {
  const cv::Vec3d at = image_from_picture * cv::Vec3d(place.x, place.y, 1);
  return {at[0] / at[2], at[1] / at[2]};
}

}  // namespace pomona
