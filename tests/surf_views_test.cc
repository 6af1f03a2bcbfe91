// SURF beside cv::SIFT and dlib's SURF: on a drawn texture, and on OpenCV's pair of a painted wall, which
// scripts/get_samples fetches.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "bench/surf/pair_score.h"
#include "datasets/image_file.h"
#include "plugins/common/surf/surf.h"
#include "tests/surf_support.h"
#ifdef POMONA_WITH_DLIB
#include "bench/surf/dlib_surf.h"
#endif

namespace pomona {
namespace {

constexpr float kSurfSigma = 1.2f / 9, kSiftSigma = 0.5f;

struct Pair {
  cv::Mat first, second;
  cv::Matx33d second_from_first;
};

PairScore score(const Pair& pair, const Features& first, const Features& second, const char* name) {
  const PairScore result = scorePair(first, second, pair.second_from_first, pair.second.size());
  std::cout << name << ": repeatability " << result.repeatability() << ", " << result.correct << " of "
            << result.matches << " matches correct, matching score " << result.matchingScore() << '\n';
  return result;
}

PairScore surfScore(const Pair& pair, SurfOptions options, const char* name) {
  const cv::Ptr<Surf> surf = Surf::create(options);
  return score(pair, strongest(*surf, pair.first, 1000, kSurfSigma),
               strongest(*surf, pair.second, 1000, kSurfSigma), name);
}

/// The wall, or nothing where it has not been fetched.
bool readWall(Pair& pair) {
  const char* folder = std::getenv("POMONA_SAMPLES");
  const std::filesystem::path graf = std::filesystem::path(folder ? folder : POMONA_DEFAULT_SAMPLES) / "graf";
  if (!std::filesystem::is_directory(graf)) return false;
  cv::cvtColor(readImage(graf / "graf1.png"), pair.first, cv::COLOR_BGR2GRAY);
  cv::cvtColor(readImage(graf / "graf3.png"), pair.second, cv::COLOR_BGR2GRAY);
  cv::Mat homography;
  cv::FileStorage(graf / "H1to3p.xml", cv::FileStorage::READ)["H13"] >> homography;
  pair.second_from_first = homography;
  return true;
}

TEST(SurfViews, TheWallIsFoundAgainAtLeastAsOftenAsBySift) {
  Pair wall;
  if (!readWall(wall)) GTEST_SKIP() << "no wall to look at: scripts/get_samples graf";
  const PairScore plain = surfScore(wall, {}, "SURF");
  SurfOptions options;
  options.extended = true;
  const PairScore extended = surfScore(wall, options, "SURF-128");
  const cv::Ptr<cv::SIFT> sift = cv::SIFT::create();
  const PairScore other = score(wall, strongest(*sift, wall.first, 1000, kSiftSigma),
                                strongest(*sift, wall.second, 1000, kSiftSigma), "cv::SIFT");
  EXPECT_GT(plain.repeatability(), 0.48);
  EXPECT_GT(plain.repeatability(), other.repeatability());
  EXPECT_GT(plain.precision(), 0.55);
  EXPECT_GT(extended.precision(), 0.55);
  EXPECT_GT(plain.matchingScore(), 0.15);
  EXPECT_GT(plain.matchingScore(), 0.6 * other.matchingScore());
}

#ifdef POMONA_WITH_DLIB
/// The share of the features that have one of `others` within 1.5 px and a scale within 25 %.
double agreement(const Features& features, const Features& others) {
  int found = 0;
  for (std::size_t i = 0; i < features.size(); ++i)
    for (std::size_t j = 0; j < others.size(); ++j) {
      const float ratio = features.sigma_px[i] / others.sigma_px[j];
      if (cv::norm(features.places[i] - others.places[j]) <= 1.5 && ratio < 1.25f && ratio > 0.8f) {
        ++found;
        break;
      }
    }
  return static_cast<double>(found) / static_cast<double>(features.size());
}

void compareWithDlib(const Pair& pair) {
  SurfOptions options;
  options.hessian_threshold =
      10;              // so that what dlib finds strong is not missed for being a little weaker here
  options.layers = 5;  // dlib has 6 filters per octave
  const double agreed =
      agreement(dlibSurf(pair.first, 300), strongest(*Surf::create(options), pair.first, 100000, kSurfSigma));
  std::cout << "of dlib's 300 strongest, found: " << agreed << '\n';
  EXPECT_GT(agreed, 0.8);
  const PairScore ours = surfScore(pair, {}, "SURF");
  const PairScore theirs = score(pair, dlibSurf(pair.first, 1000), dlibSurf(pair.second, 1000), "dlib SURF");
  EXPECT_GT(ours.repeatability(), theirs.repeatability());
  EXPECT_GT(ours.correct, theirs.correct);
}

TEST(SurfViews, AgreesWithDlibOnATexture) {
  Pair pair{texture(640, 480), {}, turnAndZoom({640, 480}, 0.5, 0.85)};
  pair.second = warp(pair.first, pair.second_from_first);
  compareWithDlib(pair);
}

TEST(SurfViews, AgreesWithDlibOnTheWall) {
  Pair wall;
  if (!readWall(wall)) GTEST_SKIP() << "no wall to look at: scripts/get_samples graf";
  compareWithDlib(wall);
}
#else
TEST(SurfViews, AgreesWithDlib) {
  GTEST_SKIP() << "built without dlib (libdlib-dev)";
}
#endif

}  // namespace
}  // namespace pomona
