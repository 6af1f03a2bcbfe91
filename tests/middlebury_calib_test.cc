#include "datasets/middlebury_calib.h"

#include "file_support.h"

namespace pomona {
namespace {

const std::string kCam0 = "cam0=[994.978 0 311.193; 0 994.978 254.877; 0 0 1]\n";
const std::string kCam1 = "cam1=[994.978 0 342.279; 0 994.978 254.877; 0 0 1]\n";

class MiddleburyCalib : public testing::Test {
 protected:
  MiddleburyCalibration read(const std::string& text) {
    return readMiddleburyCalibration(put(folder_ / "calib.txt", text));
  }
  TemporaryFolder folder_;
};

TEST_F(MiddleburyCalib, ReadsEveryKeyInMetresAndPixels) {
  const auto c = read(kCam0 + kCam1 +
                      "doffs=31.086\nbaseline=193.001\nwidth=741\nheight=500\nndisp=70\nisint=1\nvmin=6\n"
                      "vmax=60\ndyavg=0.5\ndymax=1.25\nfuture=[1 2 3]\n");
  EXPECT_EQ(c.stereo.focal_px, 994.978);
  EXPECT_EQ(c.stereo.cx_px, 311.193);
  EXPECT_EQ(c.stereo.cy_px, 254.877);
  EXPECT_DOUBLE_EQ(c.stereo.baseline_m, 0.193001);
  EXPECT_EQ(c.stereo.doffs_px, 31.086);
  EXPECT_EQ(c.stereo.width, 741);
  EXPECT_EQ(c.stereo.height, 500);
  EXPECT_EQ(c.stereo.num_disparities, 70);
  EXPECT_TRUE(c.integer_disparities);
  EXPECT_EQ(c.vmin, 6);
  EXPECT_EQ(c.vmax, 60);
  EXPECT_EQ(c.dyavg, 0.5);
  EXPECT_EQ(c.dymax, 1.25);
}

TEST_F(MiddleburyCalib, MinimalFileAndLooseSpelling) {
  const auto c = read("\r\n  cam0 = [ 500 0 10 ;0 500 20; 0 0 1 ] \r\nbaseline= 100\ndoffs=0");
  EXPECT_EQ(c.stereo.focal_px, 500);
  EXPECT_EQ(c.stereo.baseline_m, 0.1);
  EXPECT_EQ(c.stereo.doffs_px, 0);
  EXPECT_EQ(c.stereo.width, 0);
  EXPECT_EQ(c.stereo.num_disparities, 0);
  EXPECT_FALSE(c.vmin || c.vmax || c.dyavg || c.dymax || c.integer_disparities);
}

TEST_F(MiddleburyCalib, OffsetFollowsFromThePrincipalPoints) {
  EXPECT_NEAR(read(kCam0 + kCam1 + "baseline=100\n").stereo.doffs_px, 31.086, 1e-9);
}

TEST_F(MiddleburyCalib, RefusesNonsenseNamingLineAndKey) {
  const struct {
    std::string text, line, part;
  } cases[] = {
      {"", "line 1", "'cam0='"},
      {kCam0, "line 1", "'baseline='"},
      {"baseline=100\n\n", "line 2", "'cam0='"},
      {kCam0 + "baseline=100\n", "line 2", "'cam1='"},
      {kCam0 + "baseline=0\n", "line 2", "baseline is '0'"},
      {kCam0 + "baseline=-5\n", "line 2", "baseline is '-5'"},
      {kCam0 + "baseline=nan\n", "line 2", "baseline is 'nan'"},
      {kCam0 + "baseline=inf\n", "line 2", "baseline"},
      {kCam0 + "baseline=100 mm\n", "line 2", "'100 mm'"},
      {kCam0 + "baseline=100\nwidth=0\n", "line 3", "width is '0'"},
      {kCam0 + "baseline=100\nheight=2.5\n", "line 3", "height is '2.5'"},
      {kCam0 + "baseline=100\ndoffs=0\nwidth=640\n", "line 4", "ends without 'height='"},
      {kCam0 + "baseline=100\ndoffs=0\nheight=480\n", "line 4", "ends without 'width='"},
      {kCam0 + "baseline=100\nndisp=\n", "line 3", "ndisp is nothing"},
      {kCam0 + "baseline=100\nisint=2\n", "line 3", "isint is '2'; allowed: a number from 0 to 1"},
      {kCam0 + "baseline=100\ndoffs=1e300\n", "line 3", "doffs"},
      {kCam0 + "baseline=100\nbaseline=100\n", "line 3", "second value for 'baseline'"},
      {kCam0 + "garbage\nbaseline=100\n", "line 2", "expected 'key=value', found 'garbage'"},
      {"cam0=[0 0 1; 0 0 1; 0 0 1]\nbaseline=1\n", "line 1", "cam0"},
      {"cam0=[5 0 1; 0 6 1; 0 0 1]\nbaseline=1\n", "line 1", "[f 0 cx; 0 f cy; 0 0 1]"},
      {"cam0=[5 1 1; 0 5 1; 0 0 1]\nbaseline=1\n", "line 1", "cam0"},
      {"cam0=[5 0 1; 0 5 1; 0 0 1\nbaseline=1\n", "line 1", "cam0"},
      {"cam0=[5 0 1; 0 5 1; 0 0]\nbaseline=1\n", "line 1", "cam0"},
      {"cam0=[5 0 1; 0 5 1; 0 0 1 9]\nbaseline=1\n", "line 1", "cam0"},
      {"cam0=[5 0 inf; 0 5 1; 0 0 1]\nbaseline=1\n", "line 1", "cam0"},
      {"cam0=[5 0 x; 0 5 1; 0 0 1]\nbaseline=1\n", "line 1", "cam0"},
      {kCam0 + "cam1=[900 0 1; 0 900 1; 0 0 1]\nbaseline=1\n", "line 2", "focal length of cam0"},
  };
  for (const auto& c : cases) {
    const std::string message = messageOf([&] { read(c.text); });
    expectContains(message, (folder_ / "calib.txt") + ": " + c.line + ":");
    expectContains(message, c.part);
  }
}

TEST_F(MiddleburyCalib, WritesWhatItReads) {
  StereoCalibration c;
  c.focal_px = 1234.567;
  c.cx_px = 0.1;
  c.cy_px = -7;
  c.baseline_m = 0.12;
  c.doffs_px = 3.25;
  c.width = 640;
  c.height = 480;
  c.num_disparities = 64;
  const StereoCalibration back = read(encodeMiddleburyCalibration(c)).stereo;
  EXPECT_EQ(back.focal_px, c.focal_px);
  EXPECT_EQ(back.cx_px, c.cx_px);
  EXPECT_EQ(back.cy_px, c.cy_px);
  EXPECT_DOUBLE_EQ(back.baseline_m, c.baseline_m);
  EXPECT_EQ(back.doffs_px, c.doffs_px);
  EXPECT_EQ(back.width, 640);
  EXPECT_EQ(back.height, 480);
  EXPECT_EQ(back.num_disparities, 64);
  c.width = c.height = c.num_disparities = 0;
  EXPECT_EQ(read(encodeMiddleburyCalibration(c)).stereo.width, 0);
  EXPECT_THROW(encodeMiddleburyCalibration({}), std::invalid_argument);
}

}  // namespace
}  // namespace pomona
