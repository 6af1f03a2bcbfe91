#include "datasets/scene.h"

#include <cmath>
#include <cstdlib>

#include "datasets/image_file.h"
#include "datasets/named_scenes.h"
#include "datasets/pfm.h"
#include "file_support.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

class SceneFolder : public testing::Test {
 protected:
  void SetUp() override {
    pair_ = render(namedScene("planes", 3, 32, 24, 8));
    put(folder_ / "im0.png", encodeImage(pair_.left.image));
    put(folder_ / "im1.png", encodeImage(pair_.right.image));
  }
  std::string reading() {
    return messageOf([&] { readScene(folder_ / "."); });
  }
  TemporaryFolder folder_;
  RenderedPair pair_;
};

TEST_F(SceneFolder, ThePairAloneIsEnough) {
  const Scene scene = readScene(folder_ / ".");
  EXPECT_EQ(cv::norm(scene.left, pair_.left.image, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(scene.right, pair_.right.image, cv::NORM_INF), 0);
  EXPECT_TRUE(scene.ground_truth.empty());
  EXPECT_TRUE(scene.nonoccluded.empty());
  EXPECT_FALSE(scene.calibration);
}

TEST_F(SceneFolder, ReadsEverythingThatIsThere) {
  pair_.left.disparity.at<float>(0, 0) = NAN;
  writePfm(folder_ / "disp0GT.pfm", pair_.left.disparity);
  put(folder_ / "mask0nocc.png", encodeImage(pair_.left.mask));
  put(folder_ / "calib.txt", encodeMiddleburyCalibration(pair_.calibration));
  const Scene scene = readScene(folder_ / ".");
  EXPECT_TRUE(std::isnan(scene.ground_truth.at<float>(0, 0)));
  EXPECT_EQ(scene.ground_truth.at<float>(5, 5), pair_.left.disparity.at<float>(5, 5));
  EXPECT_EQ(cv::norm(scene.nonoccluded, pair_.left.mask, cv::NORM_INF), 0);
  EXPECT_EQ(scene.calibration->stereo.num_disparities, 8);
}

TEST_F(SceneFolder, RefusesWhatDoesNotFitTogether) {
  writePfm(folder_ / "disp0GT.pfm", cv::Mat(24, 31, CV_32F, cv::Scalar(1)));
  expectContains(reading(), "disp0GT.pfm: is 31x24; the left image is 32x24");
  fs::remove(folder_ / "disp0GT.pfm");
  put(folder_ / "mask0nocc.png", encodeImage(cv::Mat(24, 32, CV_8UC3, cv::Scalar(1))));
  expectContains(reading(), "mask0nocc.png: has 3 channels");
  fs::remove(folder_ / "mask0nocc.png");
  put(folder_ / "im1.png", encodeImage(cv::Mat(24, 32, CV_8UC1, cv::Scalar(1))));
  expectContains(reading(), "im1.png: has 1 channel");
  put(folder_ / "im1.png", encodeImage(cv::Mat(20, 32, CV_8UC3, cv::Scalar(1))));
  expectContains(reading(), "im1.png: is 32x20");
  fs::remove(folder_ / "im1.png");
  expectContains(reading(), "im1.png: cannot be read");
}

TEST_F(SceneFolder, RefusesTruthThatIsNone) {
  cv::Mat truth(24, 32, CV_32F, cv::Scalar(1));
  for (const float absurd : {129.0f, -129.0f, 3e38f}) {
    truth.at<float>(3, 5) = absurd;
    writePfm(folder_ / "disp0GT.pfm", truth);
    expectContains(reading(), "disp0GT.pfm: disparity at x 5, y 3 is ");
  }
  truth.at<float>(3, 5) = 128;
  writePfm(folder_ / "disp0GT.pfm", truth);
  EXPECT_EQ(readScene(folder_ / ".").ground_truth.at<float>(3, 5), 128);
  truth.setTo(NAN);
  writePfm(folder_ / "disp0GT.pfm", truth);
  expectContains(reading(), "disp0GT.pfm: holds no known disparity");
  SceneFiles files = middleburyFiles(folder_ / ".");
  files.layout = SceneLayout::kMiddlebury2;
  files.ground_truth = put(folder_ / "disp2.png", encodeImage(cv::Mat(24, 32, CV_8U, cv::Scalar(0))));
  expectContains(messageOf([&] { readScene(files); }), "disp2.png: holds no known disparity");
}

TEST_F(SceneFolder, RefusesTheCalibrationOfAnotherSize) {
  StereoCalibration calibration = pair_.calibration;
  calibration.height = 25;
  put(folder_ / "calib.txt", encodeMiddleburyCalibration(calibration));
  expectContains(reading(), "calib.txt: is for images of 32x25; the left image is 32x24");
  calibration.width = calibration.height = 0;  // not stated
  put(folder_ / "calib.txt", encodeMiddleburyCalibration(calibration));
  EXPECT_TRUE(readScene(folder_ / ".").calibration);
}

TEST(DisparitiesToReach, IsTheLargestPlusFourInSixteens) {
  cv::Mat truth(2, 100, CV_32F, cv::Scalar(3));
  EXPECT_EQ(disparitiesToReach(truth), 16);
  truth.at<float>(1, 7) = 12;
  EXPECT_EQ(disparitiesToReach(truth), 16);
  truth.at<float>(1, 7) = 12.01f;
  truth.at<float>(0, 0) = NAN;
  EXPECT_EQ(disparitiesToReach(truth), 32);
  truth.at<float>(1, 7) = 98;
  EXPECT_EQ(disparitiesToReach(truth), 100);
  truth.at<float>(1, 7) = 3e38f;
  EXPECT_EQ(disparitiesToReach(truth), 100);
  truth.setTo(NAN);
  EXPECT_EQ(disparitiesToReach(truth), 0);
  EXPECT_EQ(disparitiesToReach({}), 0);
}

// The real thing, where it is at hand.
TEST(Middlebury, EverySceneReads) {
  const char* root = std::getenv("POMONA_DATASETS");
  if (!root) GTEST_SKIP() << "set POMONA_DATASETS to a folder with middlebury/<scene>/";
  for (const auto& entry : fs::directory_iterator(fs::path(root) / "middlebury")) {
    const Scene scene = readScene(entry.path().string());
    EXPECT_EQ(scene.left.type(), scene.right.type()) << entry.path();
    EXPECT_EQ(scene.ground_truth.size(), scene.left.size()) << entry.path();
    double low = 0, high = 0;
    cv::minMaxLoc(scene.ground_truth, &low, &high, nullptr, nullptr,
                  scene.ground_truth == scene.ground_truth);
    EXPECT_GE(low, 0) << entry.path();
    EXPECT_GT(high, 5) << entry.path();
  }
}

}  // namespace
}  // namespace pomona
