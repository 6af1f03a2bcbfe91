// How many of the true matches are found, and how many of the found ones are false.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace pomona {

/// Matches of one method, over all scenes.
struct JudgedMatches {
  struct Match {
    float ratio = 1;  ///< matches count up to a limit t of this
    bool correct = false;
  };
  std::string name;
  std::vector<Match> matches;
  int possible = 0;  ///< true matches there are
};

/// A point per limit t from 0 to 1.
struct PrecisionRecall {
  double false_share = 0;  ///< 1 - precision
  double recall = 0;
};
std::vector<PrecisionRecall> curveOf(const JudgedMatches& judged);

/// The largest recall on the curve whose share of false matches is at most `false_share`; 0 if there is none.
double recallAt(const std::vector<PrecisionRecall>& curve, double false_share);

/// Curves, recall over 1 - precision, with a legend. CV_8UC3.
cv::Mat drawCurves(const std::vector<JudgedMatches>& all);

}  // namespace pomona
