#include "datasets/submission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "datasets/disparity_file.h"
#include "file_support.h"

namespace pomona {
namespace {

class Submission : public testing::Test {
 protected:
  Submission() {
    disparity_ = cv::Mat(3, 4, CV_32F, cv::Scalar(5.25));
    disparity_.at<float>(1, 2) = NAN;
  }
  std::map<std::string, std::string> filesOf(const SceneFiles& scene, OutputMode mode = OutputMode::kDense) {
    std::map<std::string, std::string> files;
    for (const OutputFile& file : submissionFiles(scene, "quality", mode, disparity_, 0.25))
      files[file.path] = file.bytes;
    return files;
  }
  // The map in `files` under `path` is the one that was handed over.
  void expectDisparity(const std::map<std::string, std::string>& files, const std::string& path) {
    ASSERT_TRUE(files.contains(path)) << path;
    const std::string copy = folder_ / std::filesystem::path(path).filename();
    const cv::Mat read = readDisparity(put(copy, files.at(path)));
    EXPECT_EQ(read.at<float>(0, 0), 5.25f);
    EXPECT_TRUE(std::isnan(read.at<float>(1, 2)));
  }
  static SceneFiles scene(SceneLayout layout, const char* name, const char* split) {
    SceneFiles files;
    files.layout = layout;
    files.name = name;
    files.folder = std::string("/data/") + split;
    return files;
  }
  cv::Mat disparity_;
  TemporaryFolder folder_;
};

TEST_F(Submission, Middlebury) {
  const auto files = filesOf(scene(SceneLayout::kMiddlebury3, "Art", "trainingQ"));
  EXPECT_EQ(files.size(), 2u);
  expectDisparity(files, "trainingQ/Art/disp0quality.pfm");
  EXPECT_EQ(files.at("trainingQ/Art/timequality.txt"), "0.25\n");

  EXPECT_TRUE(filesOf(scene(SceneLayout::kMiddlebury3, "trainingH/Art", "trainingH"))
                  .contains("trainingH/Art/disp0quality.pfm"));
  EXPECT_TRUE(filesOf(scene(SceneLayout::kMiddlebury3, "old/trainingH/Art", "old/trainingH"))
                  .contains("old/trainingH/Art/disp0quality.pfm"));
  const auto sparse = filesOf(scene(SceneLayout::kMiddlebury2, "cones", "middlebury"), OutputMode::kSparse);
  expectDisparity(sparse, "cones/disp0quality_s.pfm");
  EXPECT_TRUE(sparse.contains("cones/timequality.txt"));
}

TEST_F(Submission, Kitti) {
  const auto files = filesOf(scene(SceneLayout::kKitti2015, "000010_10", "testing"));
  EXPECT_EQ(files.size(), 1u);
  expectDisparity(files, "disp_0/000010_10.png");
  expectDisparity(filesOf(scene(SceneLayout::kKitti2012, "000010_10", "testing")), "000010_10.png");
  expectDisparity(filesOf(scene(SceneLayout::kKitti2015, "testing/000010_10", "testing")),
                  "testing/disp_0/000010_10.png");
  expectDisparity(filesOf(scene(SceneLayout::kKitti2015, "2015/testing/000010_10", "2015/testing")),
                  "2015/testing/disp_0/000010_10.png");
  disparity_.at<float>(0, 0) = 300;
  EXPECT_THROW(filesOf(scene(SceneLayout::kKitti2015, "000010_10", "testing")), std::invalid_argument);
}

TEST_F(Submission, Eth3d) {
  const auto files = filesOf(scene(SceneLayout::kEth3d, "forest_1s", "two_view_test"));
  EXPECT_EQ(files.size(), 2u);
  expectDisparity(files, "low_res_two_view/forest_1s.pfm");
  EXPECT_EQ(files.at("low_res_two_view/forest_1s.txt"), "runtime 0.25\n");
}

}  // namespace
}  // namespace pomona
