// SURF as a whole: blobs of known place and size, invariance, masks, bad input.
#include "plugins/common/surf/surf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bench/surf/pair_score.h"
#include "tests/file_support.h"
#include "tests/surf_support.h"

namespace pomona {
namespace {

struct Found {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
};
Found find(const cv::Mat& image, const SurfOptions& options = {}, const cv::Mat& mask = {}) {
  Found found;
  Surf::create(options)->detectAndCompute(image, mask, found.keypoints, found.descriptors);
  return found;
}

bool equal(const Found& a, const Found& b) {
  if (a.keypoints.size() != b.keypoints.size()) return false;
  for (std::size_t i = 0; i < a.keypoints.size(); ++i) {
    const cv::KeyPoint &p = a.keypoints[i], &q = b.keypoints[i];
    if (p.pt != q.pt || p.size != q.size || p.angle != q.angle || p.response != q.response ||
        p.octave != q.octave || p.class_id != q.class_id)
      return false;
  }
  return cv::norm(a.descriptors, b.descriptors, cv::NORM_INF) == 0;
}

cv::Mat blob(double x, double y, double sigma_px, double height) {
  cv::Mat image(161, 181, CV_8U);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u)
      image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(
          128 + height * std::exp(-((u - x) * (u - x) + (v - y) * (v - y)) / (2 * sigma_px * sigma_px)));
  return image;
}

/// The scale whose filters answer most to a Gaussian blob, by integrals of the blob over the lobes.
/// (Derivatives of Gaussians would answer most at the blob's sigma; boxes reach further for their scale, and
/// do so at 0.7 of it.)
double scaleOfBlob(double sigma_px) {
  const auto half = [&](double width) { return std::erf(width / (2 * std::sqrt(2.0) * sigma_px)); };
  double best = 0, best_lobe = 0;
  for (double lobe = 1; lobe < 6 * sigma_px; lobe += 0.01) {
    const double response = half(2 * lobe - 1) * (3 * half(lobe) - half(3 * lobe)) / (lobe * lobe);
    if (response > best) best = response, best_lobe = lobe;
  }
  return best_lobe * 3 * 1.2 / 9;
}

TEST(Surf, FindsABlobWhereAndAsLargeAsItIs) {
  for (const double sigma : {2.2, 3.0, 4.0, 5.5, 8.0, 11.0})
    for (const double height : {100.0, -100.0})
      for (const cv::Point2d centre :
           {cv::Point2d(90, 80), cv::Point2d(90.5, 80.25), cv::Point2d(89.7, 80.6)}) {
        const Found found = find(blob(centre.x, centre.y, sigma, height));
        ASSERT_FALSE(found.keypoints.empty()) << sigma;
        const cv::KeyPoint& best = *std::max_element(
            found.keypoints.begin(), found.keypoints.end(),
            [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response < b.response; });
        EXPECT_LT(cv::norm(cv::Point2d(best.pt) - centre), 0.2) << sigma << " at " << centre;
        EXPECT_NEAR(best.size * 1.2 / 9 / scaleOfBlob(sigma), 1, 0.07) << sigma << " at " << centre;
        EXPECT_EQ(best.class_id, height < 0 ? 1 : -1);
        EXPECT_EQ(std::count_if(found.keypoints.begin(), found.keypoints.end(),
                                [&](const cv::KeyPoint& p) {
                                  return cv::norm(p.pt - best.pt) < sigma &&
                                         std::abs(p.size / best.size - 1) < 0.2;
                                }),
                  1)
            << sigma << " at " << centre;
      }
}

TEST(Surf, FindsTheSameTurnedZoomedAndRelit) {
  const cv::Mat image = texture(640, 480);
  // The scales of an octave are 1.7 times apart at most: what is enlarged by 1.5 falls right between them.
  struct View {
    double degrees, zoom, gain, repeatability, precision, matching_score;
  };
  for (const auto& [degrees, zoom, gain, repeatability, precision, matching_score] :
       {View{0, 1, 0.5, 0.97, 0.98, 0.95}, View{180, 1, 0.8, 0.9, 0.98, 0.88},
        View{77, 1, 1, 0.72, 0.85, 0.55}, View{30, 1, 1, 0.7, 0.8, 0.48}, View{0, 0.7, 1, 0.6, 0.9, 0.6},
        View{0, 1.5, 1, 0.45, 0.7, 0.42}, View{-50, 1.3, 0.7, 0.55, 0.7, 0.38}}) {
    const cv::Matx33d h = turnAndZoom(image.size(), degrees * CV_PI / 180, zoom);
    cv::Mat view = warp(image, h);
    view.convertTo(view, -1, gain, 20);
    for (const bool extended : {false, true}) {
      SurfOptions options;
      options.extended = extended;
      options.hessian_threshold = 5;
      const Features first = strongest(*Surf::create(options), image, 400, 1.2f / 9);
      const PairScore score =
          scorePair(first, strongest(*Surf::create(options), view, 10000, 1.2f / 9), h, view.size());
      const std::string view_text = std::to_string(degrees) + " degrees, zoom " + std::to_string(zoom);
      EXPECT_GT(score.repeatability(), repeatability) << view_text;
      EXPECT_GT(score.precision(), precision) << view_text;
      EXPECT_GT(score.matchingScore(), matching_score) << view_text;
    }
  }
}

TEST(Surf, TurnsItsAnglesWithTheImage) {
  const cv::Mat image = texture(401, 401);
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  const Found a = find(image), b = find(turned);
  int seen = 0, right = 0;
  for (const cv::KeyPoint& p : a.keypoints)
    for (const cv::KeyPoint& q : b.keypoints)
      if (cv::norm(cv::Point2f(400 - p.pt.y, p.pt.x) - q.pt) < 0.01f && std::abs(p.size - q.size) < 0.01f) {
        ++seen;
        if (std::abs(std::remainder(q.angle - p.angle - 90, 360)) < 2) ++right;
      }
  EXPECT_GT(seen, 0.9 * static_cast<double>(a.keypoints.size()));
  EXPECT_GT(right, 0.97 * seen);
  for (const cv::KeyPoint& p : a.keypoints) EXPECT_TRUE(p.angle >= 0 && p.angle < 360) << p.angle;
}

TEST(Surf, UprightHasNoAngleAndDoesNotTurn) {
  SurfOptions options;
  options.upright = true;
  const cv::Mat image = texture(400, 300);
  for (const cv::KeyPoint& p : find(image, options).keypoints) EXPECT_EQ(p.angle, -1);
  const cv::Matx33d turn = turnAndZoom(image.size(), 1, 1);
  const auto correct = [&](const SurfOptions& o) {
    return scorePair(strongest(*Surf::create(o), image, 300, 1.2f / 9),
                     strongest(*Surf::create(o), warp(image, turn), 300, 1.2f / 9), turn, image.size())
        .correct;
  };
  EXPECT_LT(correct(options), correct({}) / 3);
}

TEST(Surf, GivesTheSameForAnyNumberOfThreads) {
  const cv::Mat image = texture(500, 400);
  SurfOptions options;
  options.extended = true;
  options.threads = 1;
  const Found one = find(image, options);
  ASSERT_GT(one.keypoints.size(), 100u);
  for (const int threads : {2, 3, 8}) {
    options.threads = threads;
    EXPECT_TRUE(equal(find(image, options), one)) << threads;
  }
}

TEST(Surf, LooksWhereTheMaskSays) {
  const cv::Mat image = texture(400, 300);
  cv::Mat mask(image.size(), CV_8U, cv::Scalar(0));
  EXPECT_TRUE(find(image, {}, mask).keypoints.empty());
  const cv::Rect region(150, 50, 120, 200);
  mask(region) = 1;
  const std::size_t all = find(image).keypoints.size();
  const Found inside = find(image, {}, mask);
  EXPECT_GT(inside.keypoints.size(), all / 10);
  EXPECT_LT(inside.keypoints.size(), all / 2);
  for (const cv::KeyPoint& p : inside.keypoints)
    EXPECT_TRUE(region.contains(cv::Point(cvRound(p.pt.x), cvRound(p.pt.y)))) << p.pt;
  EXPECT_EQ(inside.descriptors.rows, static_cast<int>(inside.keypoints.size()));
}

TEST(Surf, FindsNothingInTinyFlatAndEmptyImages) {
  for (const cv::Size size :
       {cv::Size(1, 1), cv::Size(8, 8), cv::Size(27, 1), cv::Size(1, 300), cv::Size(26, 26)}) {
    const Found found = find(texture(size.width, size.height));
    EXPECT_TRUE(found.keypoints.empty()) << size;
    EXPECT_EQ(found.descriptors.rows, 0);
  }
  for (const int gray : {0, 77, 255}) EXPECT_TRUE(find(cv::Mat(200, 300, CV_8U, gray)).keypoints.empty());
  Found found;
  found.keypoints.resize(3);
  Surf::create()->detectAndCompute(cv::Mat(), cv::noArray(), found.keypoints, found.descriptors);
  EXPECT_TRUE(found.keypoints.empty());
}

TEST(Surf, DescribesWhatItIsGiven) {
  const cv::Mat image = texture(300, 300);
  Found found = find(image);
  cv::Mat again;
  std::vector<cv::KeyPoint> keypoints = found.keypoints;
  Surf::create()->compute(image, keypoints, again);
  EXPECT_TRUE(equal({keypoints, again}, found));
  for (cv::KeyPoint& p : keypoints) p.angle = -1;  // to be found again
  Surf::create()->detectAndCompute(image, cv::noArray(), keypoints, again, true);
  EXPECT_TRUE(equal({keypoints, again}, found));
  keypoints = {cv::KeyPoint(0, 299, 40),
               cv::KeyPoint(150, 150, 480)};  // at the border, and as large as they come
  Surf::create()->detectAndCompute(image, cv::noArray(), keypoints, again, true);
  EXPECT_EQ(again.rows, 2);
  EXPECT_TRUE(cv::checkRange(again));
}

// A filter that does not fit into the image has no value, and none of its neighbours may be a maximum for
// that.
TEST(Surf, FindsNothingInAPartThatTheWholeLacks) {
  const cv::Mat image = texture(300, 300);
  SurfOptions options;
  options.octaves = 1;  // sampled at every pixel, wherever the part begins
  const Found whole = find(image, options), part = find(image(cv::Rect(83, 71, 120, 110)), options);
  ASSERT_GT(part.keypoints.size(), 10u);
  for (const cv::KeyPoint& p : part.keypoints)
    EXPECT_TRUE(std::any_of(whole.keypoints.begin(), whole.keypoints.end(), [&](const cv::KeyPoint& q) {
      return cv::norm(p.pt + cv::Point2f(83, 71) - q.pt) < 1e-3 && std::abs(p.size - q.size) < 1e-3;
    })) << p.pt;
}

TEST(Surf, ReadsColourAndPartsOfImages) {
  const cv::Mat image = texture(300, 200);
  cv::Mat colour, framed;
  cv::cvtColor(image, colour, cv::COLOR_GRAY2BGR);
  EXPECT_TRUE(equal(find(colour), find(image)));
  cv::copyMakeBorder(image, framed, 5, 9, 13, 7, cv::BORDER_CONSTANT, 255);
  EXPECT_TRUE(equal(find(framed(cv::Rect(13, 5, 300, 200))), find(image)));
}

TEST(Surf, IsAFeature2D) {
  SurfOptions options;
  EXPECT_EQ(Surf::create(options)->descriptorSize(), 64);
  options.extended = true;
  const cv::Ptr<cv::Feature2D> surf = Surf::create(options);
  EXPECT_EQ(surf->descriptorSize(), 128);
  EXPECT_EQ(surf->descriptorType(), CV_32F);
  EXPECT_EQ(surf->defaultNorm(), cv::NORM_L2);
  std::vector<cv::KeyPoint> keypoints;
  surf->detect(texture(200, 200), keypoints);
  EXPECT_FALSE(keypoints.empty());
}

TEST(Surf, ExplainsWhatItCannotUse) {
  const cv::Mat image = texture(100, 80);
  const auto message = [](auto action) { return messageOf<std::invalid_argument>(action); };
  EXPECT_EQ(message([&] { find(cv::Mat(80, 100, CV_32F, cv::Scalar(1))); }),
            "SURF: image is of type CV_32FC1; allowed: CV_8UC1 or CV_8UC3");
  EXPECT_EQ(message([&] { find(image, {}, cv::Mat(80, 100, CV_16U, cv::Scalar(1))); }),
            "SURF: mask is of type CV_16UC1; allowed: CV_8UC1");
  EXPECT_EQ(message([&] { find(image, {}, cv::Mat(100, 80, CV_8U, cv::Scalar(1))); }),
            "SURF: mask is 80x100 but image is 100x80; both must have the same size");
  for (const cv::KeyPoint& point : {cv::KeyPoint(10, 10, 0), cv::KeyPoint(10, 10, 481),
                                    cv::KeyPoint(100, 10, 9), cv::KeyPoint(10, std::nanf(""), 9)}) {
    std::vector<cv::KeyPoint> keypoints{point};
    cv::Mat descriptors;
    EXPECT_NE(message([&] { Surf::create()->compute(image, keypoints, descriptors); }), "") << point.pt;
  }
  const auto refused = [&](auto change) {
    SurfOptions options;
    change(options);
    return message([&] { Surf::create(options); });
  };
  EXPECT_EQ(refused([](SurfOptions& o) { o.octaves = 6; }), "SURF: octaves is 6; allowed: 1 to 5");
  EXPECT_EQ(refused([](SurfOptions& o) { o.layers = 2; }), "SURF: layers is 2; allowed: 3 to 5");
  EXPECT_EQ(refused([](SurfOptions& o) { o.threads = -1; }),
            "SURF: threads is -1; allowed: 0 (all processors) or more");
  EXPECT_NE(refused([](SurfOptions& o) { o.hessian_threshold = 0; }), "");
  EXPECT_NE(refused([](SurfOptions& o) { o.hessian_threshold = std::nanf(""); }), "");
}

}  // namespace
}  // namespace pomona
