// How well features are found again in another view of a plane, whose homography is known.
#pragma once

#include <opencv2/features2d.hpp>
#include <vector>

namespace pomona {

struct Features {
  std::vector<cv::Point2f> places;  ///< px
  std::vector<float> sigma_px;      ///< scale of the Gaussian
  cv::Mat descriptors;              ///< CV_32F, one row each

  std::size_t size() const { return places.size(); }
};

/// The `most` strongest features of the image, in order of strength. `sigma_per_size` turns
/// cv::KeyPoint::size into the scale: 0.5 for cv::SIFT, 1.2 / 9 for SURF.
Features strongest(cv::Feature2D& method, const cv::Mat& image, int most, float sigma_per_size);

struct PairScore {
  int first = 0, second = 0;  ///< features of either view that the other one shows, too
  int correspondences = 0;    ///< pairs of them that overlap, each in one pair only
  int matches = 0;            ///< features of the first view whose nearest neighbour passed the ratio test
  int correct = 0;            ///< of these, how many lie within 3 px of where the homography puts them

  double repeatability() const;  ///< correspondences / min(first, second)
  double matchingScore() const;  ///< correct / min(first, second)
  double precision() const;      ///< correct / matches
};

/// Two features overlap if the discs of three sigma about them have more than half of their union in common,
/// the disc of the first view brought to the second: its centre by the homography, its area by the Jacobian
/// there. Pairs are formed with the largest overlap first. Nearest neighbours are Euclidean, among all
/// features of the second view; the ratio to the second nearest must be below `ratio`.
PairScore scorePair(const Features& first, const Features& second, const cv::Matx33d& second_from_first,
                    cv::Size second_size, float ratio = 0.8f);

}  // namespace pomona
