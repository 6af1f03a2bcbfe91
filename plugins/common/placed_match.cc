#include "plugins/common/placed_match.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

namespace pomona {
namespace {

// How the object is turned and scaled in the image, about.
struct Pose {
  double turn_deg = 0, log_scale = 0;
};

double turnOf(const cv::KeyPoint& in_picture, const cv::KeyPoint& in_image) {
  return std::fmod(in_image.angle - in_picture.angle + 720, 360.0);
}

double logScaleOf(const cv::KeyPoint& in_picture, const cv::KeyPoint& in_image) {
  return std::log(in_image.size / in_picture.size);
}

Pose poseOf(std::span<const PlacedMatch> seeds) {
  cv::Vec2d direction;
  std::vector<double> scales;
  for (const PlacedMatch& m : seeds) {
    const double turn = turnOf(m.in_picture, m.in_image) * CV_PI / 180;
    direction += cv::Vec2d(std::cos(turn), std::sin(turn));
    scales.push_back(logScaleOf(m.in_picture, m.in_image));
  }
  const auto middle = scales.begin() + static_cast<std::ptrdiff_t>(scales.size() / 2);
  std::nth_element(scales.begin(), middle, scales.end());
  return {std::atan2(direction[1], direction[0]) * 180 / CV_PI, *middle};
}

bool fits(const Pose& pose, const cv::KeyPoint& in_picture, const cv::KeyPoint& in_image) {
  constexpr double kTurn_deg = 25, kLogScale = 0.5;
  const double off_deg = std::fmod(turnOf(in_picture, in_image) - pose.turn_deg + 720, 360.0);
  return std::min(off_deg, 360 - off_deg) <= kTurn_deg &&
         std::abs(logScaleOf(in_picture, in_image) - pose.log_scale) <= kLogScale;
}

// Whether the second could be of the object that the first one is of: seen from the side, an object is up to
// half as wide.
bool agree(const PlacedMatch& first, const PlacedMatch& second) {
  constexpr double kSlant = 0.6, kReach_px = 5;
  const Pose pose{turnOf(first.in_picture, first.in_image), logScaleOf(first.in_picture, first.in_image)};
  if (!fits(pose, second.in_picture, second.in_image)) return false;
  const double scale = std::exp(pose.log_scale), turn = pose.turn_deg * CV_PI / 180;
  const cv::Point2d along = second.in_picture.pt - first.in_picture.pt;
  const cv::Point2d expected(scale * (std::cos(turn) * along.x - std::sin(turn) * along.y),
                             scale * (std::sin(turn) * along.x + std::cos(turn) * along.y));
  const cv::Point2d seen = second.in_image.pt - first.in_image.pt;
  return cv::norm(seen - expected) <= kSlant * cv::norm(expected) + kReach_px;
}

cv::Rect2d boxAround(const std::vector<cv::Point2d>& places, double reach_px) {
  cv::Point2d least = places.front(), most = least;
  for (const cv::Point2d& at : places) {
    least = {std::min(least.x, at.x), std::min(least.y, at.y)};
    most = {std::max(most.x, at.x), std::max(most.y, at.y)};
  }
  return {least - cv::Point2d(reach_px, reach_px), most + cv::Point2d(reach_px, reach_px)};
}

double distanceBetween(const cv::Mat& a, int row_a, const cv::Mat& b, int row_b) {
  return cv::norm(a.row(row_a), b.row(row_b));
}

}  // namespace

std::vector<PlacedMatch> placedMatches(const KnownObject& object, int object_number, const SeenView& view,
                                       double most_ratio) {
  std::vector<PlacedMatch> placed;
  for (const ObjectMatch& match : view.matches)
    if (match.object == object_number && match.ratio <= most_ratio)
      placed.push_back(
          {match, object.features.keypoints[match.feature], view.features.keypoints[match.query]});
  return placed;
}

int distinctPlaces(std::span<const PlacedMatch> matches) {
  std::set<std::pair<int, int>> in_picture, in_image;
  for (const PlacedMatch& m : matches) {
    in_picture.emplace(cvRound(m.in_picture.pt.x), cvRound(m.in_picture.pt.y));
    in_image.emplace(cvRound(m.in_image.pt.x), cvRound(m.in_image.pt.y));
  }
  return static_cast<int>(std::min(in_picture.size(), in_image.size()));
}

std::vector<std::vector<PlacedMatch>> likelyGroups(const std::vector<PlacedMatch>& matches, int most) {
  constexpr int kFewestPlaces = 3;
  struct Group {
    std::vector<std::size_t> members;
    int places = 0;
  };
  std::vector<Group> all;
  for (const PlacedMatch& first : matches) {
    Group group;
    std::vector<PlacedMatch> joined;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (!agree(first, matches[i])) continue;
      group.members.push_back(i);
      joined.push_back(matches[i]);
    }
    group.places = distinctPlaces(joined);
    if (group.places >= kFewestPlaces) all.push_back(std::move(group));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Group& a, const Group& b) { return a.places > b.places; });
  std::vector<Group> kept;
  for (Group& group : all) {
    const bool repeats = std::any_of(kept.begin(), kept.end(), [&](const Group& other) {
      std::vector<std::size_t> common;
      std::set_intersection(group.members.begin(), group.members.end(), other.members.begin(),
                            other.members.end(), std::back_inserter(common));
      return 2 * common.size() > group.members.size();
    });
    if (!repeats) kept.push_back(std::move(group));
    if (static_cast<int>(kept.size()) == most) break;
  }
  std::vector<std::vector<PlacedMatch>> groups;
  for (const Group& group : kept) {
    groups.emplace_back();
    for (const std::size_t i : group.members) groups.back().push_back(matches[i]);
  }
  return groups;
}

std::vector<PlacedMatch> guidedMatches(const KnownObject& object, int object_number, const SeenView& view,
                                       const cv::Matx33d& image_from_picture,
                                       std::span<const PlacedMatch> seeds, double reach_px) {
  constexpr double kNearlyAsNear = 1.25;
  const Features& known = object.features;
  const Pose pose = poseOf(seeds);
  std::vector<cv::Point2d> expected;
  for (const cv::KeyPoint& keypoint : known.keypoints)
    expected.push_back(mapped(image_from_picture, keypoint.pt));
  std::vector<PlacedMatch> guided;
  const cv::Rect2d reached = boxAround(expected, reach_px);
  for (const ObjectMatch& match : view.matches) {
    const cv::KeyPoint& seen = view.features.keypoints[match.query];
    if (!reached.contains(seen.pt)) continue;
    ObjectMatch best{match.query, object_number, -1, std::numeric_limits<float>::infinity(), match.ratio};
    for (int i = 0; i < known.count(); ++i) {
      const cv::Point2d off = expected[i] - cv::Point2d(seen.pt);
      if (!(off.dot(off) <= reach_px * reach_px) || !fits(pose, known.keypoints[i], seen)) continue;
      const auto distance =
          static_cast<float>(distanceBetween(view.features.descriptors, match.query, known.descriptors, i));
      if (distance < best.distance) best.distance = distance, best.feature = i;
    }
    if (best.feature < 0 || best.distance > kNearlyAsNear * match.distance) continue;
    guided.push_back({best, known.keypoints[best.feature], seen});
  }
  return guided;
}

}  // namespace pomona
