// Matches of a known object, with the places of both features.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "plugins/common/object_place.h"

namespace pomona {

struct PlacedMatch {
  ObjectMatch match;
  cv::KeyPoint in_picture, in_image;
};

/// Matches up to `most_ratio` of one object.
std::vector<PlacedMatch> placedMatches(const KnownObject& object, int object_number, const SeenView& view,
                                       double most_ratio);

/// How many different places they are of, in the picture and in the image; the fewer of both.
int distinctPlaces(std::span<const PlacedMatch> matches);

/// Groups of matches that could be of one object, the largest first, at most `most`. Each match says how its
/// object is turned and scaled and where the others should be, and is joined by those that agree, roughly
/// enough for any slant (a Hough transform as Lowe 2004, 7.3, with a match for each bin). Groups are of three
/// places or more, and no two have more than half of their matches in common.
std::vector<std::vector<PlacedMatch>> likelyGroups(const std::vector<PlacedMatch>& matches, int most);

/// What else matches, where `image_from_picture` is known roughly (guided matching; Hartley & Zisserman 2004,
/// 4.8.3). Each feature of the image may belong to a feature of the object that should be seen within
/// `reach_px` of it, turned and scaled as those of `seeds` (not empty) are, and that looks nearly as much
/// like it as the nearest of all in the database: what an object has twice, as letters, has no distinct
/// match, but one place. The result has the ratios of the view's own matches.
std::vector<PlacedMatch> guidedMatches(const KnownObject& object, int object_number, const SeenView& view,
                                       const cv::Matx33d& image_from_picture,
                                       std::span<const PlacedMatch> seeds, double reach_px);

}  // namespace pomona
