// Dataset trees made up on the spot: what the walker finds in them, what reading gives, and which file is
// named when something is wrong.
#include "datasets/walk.h"

#include <cmath>
#include <set>

#include "datasets/image_file.h"
#include "datasets/named_scenes.h"
#include "datasets/pfm.h"
#include "datasets/png16.h"
#include "file_support.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

class Tree : public testing::Test {
 protected:
  static void SetUpTestSuite() { pair_ = render(namedScene("planes", 3, 32, 24, 8)); }

  std::string file(const std::string& path, const std::string& bytes) {
    fs::create_directories(fs::path(root_ / path).parent_path());
    return put(root_ / path, bytes);
  }
  void image(const std::string& path, const cv::Mat& image) {
    file(path, encodeImage(image, fs::path(path).extension()));
  }
  void middleburyScene(const std::string& folder) {
    image(folder + "/im0.png", pair_.left.image);
    image(folder + "/im1.png", pair_.right.image);
    file(folder + "/disp0GT.pfm", encodePfm(pair_.left.disparity));
    image(folder + "/mask0nocc.png", pair_.left.mask);
  }
  std::vector<SceneFiles> found(const std::string& below = ".") { return findScenes({root_ / below}); }
  static std::vector<std::string> namesOf(const std::vector<SceneFiles>& scenes) {
    std::vector<std::string> names;
    for (const SceneFiles& scene : scenes) names.push_back(scene.name);
    return names;
  }
  static std::string reading(const SceneFiles& files) {
    return messageOf([&] { readScene(files); });
  }
  static cv::Mat gray(int value) { return {24, 32, CV_8UC1, cv::Scalar(value)}; }

  TemporaryFolder root_;
  static RenderedPair pair_;
};
RenderedPair Tree::pair_;

using Names = std::vector<std::string>;

TEST_F(Tree, FindsMiddleburyScenesAtAnyDepthInOrder) {
  middleburyScene("b/trainingQ/Piano");
  middleburyScene("b/trainingQ/Art");
  middleburyScene("a/Zebra");
  file("a/notes.txt", "nothing");
  const auto scenes = found();
  EXPECT_EQ(namesOf(scenes), (Names{"Zebra", "Art", "Piano"}));
  EXPECT_EQ(scenes[1].split(), "trainingQ");
  EXPECT_EQ(scenes[1].layout, SceneLayout::kMiddlebury3);
  const Scene scene = readScene(scenes[1]);
  EXPECT_EQ(cv::norm(scene.left, pair_.left.image, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(scene.nonoccluded, pair_.left.mask, cv::NORM_INF), 0);
  EXPECT_EQ(namesOf(found("a/Zebra")), Names{"Zebra"});  // a scene can be named itself, too
}

TEST_F(Tree, NamesOfTwoFoldersAreToldApartByAsFewFoldersAsItTakes) {
  middleburyScene("v3/trainingQ/Art");
  middleburyScene("v3/trainingH/Art");
  middleburyScene("v3/trainingH/Piano");
  EXPECT_EQ(namesOf(found()), (Names{"trainingH/Art", "trainingH/Piano", "trainingQ/Art"}));
  EXPECT_EQ(namesOf(found("v3/trainingH")), (Names{"Art", "Piano"}));
  for (const char* view : {"2012/training/image_0/", "2012/training/image_1/", "2015/training/image_2/",
                           "2015/training/image_3/"}) {
    image(view + std::string("000000_10.png"), gray(1));
    if (view[3] == '5') image(view + std::string("000001_10.png"), gray(1));
  }
  EXPECT_EQ(namesOf(found()),
            (Names{"2012/training/000000_10", "2015/training/000000_10", "2015/training/000001_10",
                   "trainingH/Art", "trainingH/Piano", "trainingQ/Art"}));
}

TEST_F(Tree, ANameThatAManifestUsesAgainGetsANumber) {
  const std::string pair = "im0.png,im1.png\n";
  file("a/manifest.csv", "name,left,right\nx," + pair + "y," + pair + "x," + pair + "x-2," + pair);
  file("b/manifest.csv", "left,right\n1/im0.png,1/im1.png\n2/im0.png,2/im1.png\n");
  EXPECT_EQ(namesOf(found()), (Names{"x", "y", "x-2", "x-2-2", "im0", "im0-2"}));
  EXPECT_EQ(namesOf(findScenes({root_ / "a"})), (Names{"x", "y", "x-2", "x-2-2"}));
}

TEST_F(Tree, NamesHoldNoControlCharacters) {
  middleburyScene("v3/a\x1b[2Jb\n");
  middleburyScene("v3/a\x1b[2Jb\t");
  EXPECT_EQ(namesOf(found()), (Names{"a?[2Jb?", "a?[2Jb?-2"}));
}

TEST_F(Tree, ALoopOfLinksEnds) {
  middleburyScene("set/Art");
  fs::create_directory_symlink("..", root_ / "set/up");
  fs::create_directory_symlink(root_ / "set", root_ / "linked");
  EXPECT_EQ(namesOf(found()), Names{"Art"});
  EXPECT_EQ(namesOf(findScenes({root_ / "set", root_ / "linked"})), Names{"Art"});
}

TEST_F(Tree, WhatIsWrongWithOneSceneDoesNotHideTheOthers) {
  for (const char* name : {"a", "b", "c", "d"}) middleburyScene(name);
  fs::remove(root_ / "a/im1.png");
  file("b/disp0GT.pfm", "Pf\n32 24\n-1\nshort");
  image("c/mask0nocc.png", gray(255).colRange(0, 20));
  const auto scenes = found();
  ASSERT_EQ(namesOf(scenes), (Names{"a", "b", "c", "d"}));
  expectContains(reading(scenes[0]), "a/im1.png: cannot be read");
  expectContains(reading(scenes[1]), "b/disp0GT.pfm: byte 17: expected 3072 bytes");
  expectContains(reading(scenes[2]), "c/mask0nocc.png: is 20x24; the left image is 32x24");
  EXPECT_FALSE(readScene(scenes[3]).ground_truth.empty());
}

TEST_F(Tree, EightBitTruthIsScaledAsItsSetSaysItIs) {
  const struct {
    const char *folder, *left, *right, *truth;
    int width;
    float steps;
  } kCases[] = {{"venus", "im2.ppm", "im6.ppm", "disp2.pgm", 32, 8},
                {"tsukuba", "imL.png", "imR.png", "groundtruth.png", 32, 16},
                {"cones", "im2.png", "im6.png", "disp2.png", 450, 4},
                {"teddyF", "im2.png", "im6.png", "disp2.png", 1800, 1},
                {"Aloe", "view1.png", "view5.png", "disp1.png", 427, 3},
                {"AloeH", "view1.png", "view5.png", "disp1.png", 641, 2},
                {"AloeF", "view1.png", "view5.png", "disp1.png", 1282, 1}};
  for (const auto& one : kCases) {
    SCOPED_TRACE(one.folder);
    const std::string folder = std::string("v2/") + one.folder;
    cv::Mat truth(2, one.width, CV_8U, cv::Scalar(48));
    truth.at<std::uint8_t>(0, 0) = 0;
    const bool color = std::string(one.left).ends_with(".ppm");
    const cv::Mat view(2, one.width, color ? CV_8UC3 : CV_8UC1, cv::Scalar::all(9));
    image(folder + "/" + one.left, view);
    image(folder + "/" + one.right, view);
    image(folder + "/" + one.truth, truth);
    image(folder + "/nonocc.png", truth);
    const auto scenes = found(folder);
    ASSERT_EQ(namesOf(scenes), Names{one.folder});
    EXPECT_EQ(scenes[0].layout, SceneLayout::kMiddlebury2);
    const Scene scene = readScene(scenes[0]);
    EXPECT_TRUE(std::isnan(scene.ground_truth.at<float>(0, 0)));
    EXPECT_FLOAT_EQ(scene.ground_truth.at<float>(1, 1), 48 / one.steps);
    EXPECT_EQ(scene.nonoccluded.at<std::uint8_t>(1, 1), 48);
  }
}

TEST_F(Tree, EightBitTruthIsScaledAlikeFromWithinItsFolder) {
  image("venus/im2.png", gray(9));
  image("venus/im6.png", gray(9));
  image("venus/disp2.png", gray(48));
  fs::create_directory(root_ / "venus/below");
  const fs::path here = fs::current_path();
  for (const auto& [folder, root] : {std::pair{"venus", "."}, std::pair{"venus/below", ".."}}) {
    fs::current_path(root_ / folder);
    const auto scenes = findScenes({root});
    const Scene scene = readScene(scenes.front());
    fs::current_path(here);
    EXPECT_EQ(namesOf(scenes), Names{"venus"});
    EXPECT_FLOAT_EQ(scene.ground_truth.at<float>(1, 1), 48 / 8.0f) << root;
  }
}

TEST_F(Tree, KittiFrames) {
  cv::Mat truth(24, 32, CV_32F, cv::Scalar(7.5)), both = truth.clone();
  truth.at<float>(0, 0) = both.at<float>(0, 0) = both.at<float>(0, 1) = NAN;
  for (const char* frame : {"000000_10.png", "000007_10.png", "000007_11.png"})
    for (const char* part : {"image_2", "image_3", "disp_occ_0", "disp_noc_0", "obj_map"}) {
      const std::string path = std::string("2015/training/") + part + "/" + frame;
      if (std::string(part).starts_with("disp"))
        file(path, encodeDisparityPng(std::string(part) == "disp_occ_0" ? truth : both, kKittiScale));
      else
        image(path, gray(2));
    }
  image("2012/testing/colored_0/000003_10.png", gray(1));
  image("2012/testing/colored_1/000003_10.png", gray(1));
  image("2012/testing/image_0/000003_10.png", gray(3));
  image("2012/testing/image_1/000003_10.png", gray(3));
  fs::remove(root_ / "2015/training/image_3/000007_10.png");

  const auto scenes = found();
  ASSERT_EQ(namesOf(scenes), (Names{"000003_10", "000000_10", "000007_10"}));
  EXPECT_EQ(scenes[0].layout, SceneLayout::kKitti2012);
  EXPECT_EQ(scenes[0].split(), "testing");
  const Scene test = readScene(scenes[0]);
  EXPECT_TRUE(test.ground_truth.empty());
  EXPECT_EQ(test.left.at<std::uint8_t>(0, 0), 1);  // colour comes first where both are there

  EXPECT_EQ(scenes[1].layout, SceneLayout::kKitti2015);
  const Scene scene = readScene(scenes[1]);
  EXPECT_FLOAT_EQ(scene.ground_truth.at<float>(5, 5), 7.5f);
  EXPECT_EQ(scene.nonoccluded.at<std::uint8_t>(0, 0), 0);
  EXPECT_EQ(scene.nonoccluded.at<std::uint8_t>(0, 1), 128);
  EXPECT_EQ(scene.nonoccluded.at<std::uint8_t>(0, 2), 255);
  EXPECT_EQ(scene.objects.at<std::uint8_t>(3, 3), 2);
  expectContains(reading(scenes[2]), "image_3/000007_10.png: cannot be read");
}

TEST_F(Tree, Eth3dTruthMayLieBesideTheSplit) {
  middleburyScene("two_view_training/forest_1s");
  fs::create_directories(root_ / "two_view_training_gt/forest_1s");
  for (const char* leaf : {"disp0GT.pfm", "mask0nocc.png"})
    fs::rename(root_ / (std::string("two_view_training/forest_1s/") + leaf),
               root_ / (std::string("two_view_training_gt/forest_1s/") + leaf));
  const auto scenes = found();
  ASSERT_EQ(namesOf(scenes), Names{"forest_1s"});
  EXPECT_EQ(scenes[0].layout, SceneLayout::kEth3d);
  const Scene scene = readScene(scenes[0]);
  EXPECT_EQ(scene.ground_truth.at<float>(5, 5), pair_.left.disparity.at<float>(5, 5));
  EXPECT_FALSE(scene.nonoccluded.empty());
}

TEST_F(Tree, Manifest) {
  middleburyScene("pairs/one");
  middleburyScene("pairs/never listed");
  file("pairs/manifest.csv",
       "left,right,gt,mask,max_disparity,name\r\n"
       "one/im0.png,one/im1.png,one/disp0GT.pfm,one/mask0nocc.png,48,first\r\n"
       "\"one/im0.png\",one/im1.png\n"
       "\n"
       "one/im0.png,,one/disp0GT.pfm\n"
       "one/im0.png,one/im1.png,,,-3\n"
       "one/im0.png,one/im1.png,,,,../up\n"
       "one/im0.png,one/im1.png,,,,,too,many\n"
       "one/im0.png,one/absent.png,,,,\"a \"\"b\"\", c\"\n");
  const auto scenes = found();
  ASSERT_EQ(scenes.size(), 7u);
  EXPECT_EQ(scenes[0].name, "first");
  EXPECT_EQ(scenes[0].num_disparities, 48);
  EXPECT_EQ(scenes[0].layout, SceneLayout::kManifest);
  EXPECT_FALSE(readScene(scenes[0]).nonoccluded.empty());
  EXPECT_TRUE(readScene(scenes[1]).ground_truth.empty());
  EXPECT_EQ(scenes[1].num_disparities, 0);
  expectContains(reading(scenes[2]), "manifest.csv: line 5: expected a path under right");
  expectContains(reading(scenes[3]), "manifest.csv: line 6: max_disparity is '-3'; allowed: 1 to 1024");
  expectContains(reading(scenes[4]), "manifest.csv: line 7: name is '../up'");
  expectContains(reading(scenes[5]), "manifest.csv: line 8: has 8 fields; the first line names 6");
  EXPECT_EQ(scenes[6].name, "a \"b\", c");
  expectContains(reading(scenes[6]), "one/absent.png: cannot be read");
}

TEST_F(Tree, AManifestWithoutColumnNamesIsAProblemOfItsFolderOnly) {
  middleburyScene("good");
  file("bad/manifest.csv", "a.png,b.png\n");
  file("odd/manifest.csv", "left,right,depth\n");
  const auto scenes = found();
  ASSERT_EQ(namesOf(scenes), (Names{"bad", "good", "odd"}));
  expectContains(reading(scenes[0]), "bad/manifest.csv: line 1: expected the names of the columns");
  expectContains(reading(scenes[2]), "odd/manifest.csv: line 1: unknown column 'depth'");
}

TEST_F(Tree, ManifestsAsSpreadsheetsWriteThem) {
  file("bom/manifest.csv", "\xef\xbb\xbfleft,right\n1/im0.png,1/im1.png\n");
  file("twice/manifest.csv", "left,right,gt,left\n");
  file("open/manifest.csv", "left,right\na.png,b.png\n\"c.png,d.png\ne.png,f.png\n");
  const auto scenes = found();
  ASSERT_EQ(namesOf(scenes), (Names{"im0", "open", "twice"}));
  EXPECT_EQ(scenes[0].left, (root_ / "./bom/1/im0.png"));
  expectContains(reading(scenes[1]), "open/manifest.csv: line 3: a quote that begins here never ends");
  expectContains(reading(scenes[2]), "twice/manifest.csv: line 1: a second column 'left'");
}

TEST_F(Tree, NothingToWalk) {
  fs::create_directory(root_ / "empty");
  expectContains(messageOf([&] { found("empty"); }), "no scene found");
  expectContains(messageOf([&] { found("absent"); }), "there is no such folder");
}

}  // namespace
}  // namespace pomona
