// One stereo scene of a data set: its files, and what is in them.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "datasets/middlebury_calib.h"

namespace pomona {

/// Whose conventions the files of a scene follow.
enum class SceneLayout {
  kMiddlebury3,  ///< im0.png, im1.png, disp0GT.pfm, mask0nocc.png, calib.txt (2014 and later)
  kMiddlebury2,  ///< truth in an 8-bit image that counts fractions of a pixel (2001 to 2006)
  kEth3d,        ///< the names of kMiddlebury3 below a folder two_view_*
  kKitti2012,    ///< truth, and non-occluded truth, in 16-bit PNGs of 1/256 px
  kKitti2015,    ///< the same with other folder names, and an object map
  kManifest,     ///< listed in a manifest.csv
};

/// Where the parts of a scene lie. An empty path: the scene comes without this part.
struct SceneFiles {
  std::string name;    ///< for people and for result files, e.g. "cones", "000010_10"
  std::string folder;  ///< the absolute path of where the scene was found, e.g. ".../trainingQ"
  SceneLayout layout = SceneLayout::kMiddlebury3;
  std::string left, right;
  std::string ground_truth;  ///< .pfm or .png, as `layout` says
  std::string nonoccluded;   ///< mask, or for KITTI the truth of the non-occluded pixels
  std::string objects;       ///< KITTI 2015: obj_map
  std::string calibration;   ///< Middlebury's calib.txt
  int num_disparities = 0;   ///< range to search from 0 up, where the data set states one; else 0
  std::string problem;       ///< why readScene() will refuse the scene, where that is known already

  /// The last part of `folder`, e.g. "trainingQ", "two_view_training".
  std::string split() const { return folder.substr(folder.rfind('/') + 1); }
};

struct Scene {
  cv::Mat left, right;   ///< as stored, of equal size and type
  cv::Mat ground_truth;  ///< CV_32F, NaN unknown; or empty
  cv::Mat nonoccluded;   ///< CV_8U, 255 visible in both views, 128 occluded, 0 unknown; or empty
  cv::Mat objects;       ///< CV_8U, 0 background, else an independently moving object; or empty
  std::optional<MiddleburyCalibration> calibration;
};

/// Reads every part that `files` names; maps have the size of the left image. The 8-bit truth of
/// kMiddlebury2 is divided by the scale that the data set's pages give: by name 16 (tsukuba) or 8 (the
/// planar scenes of 2001); by width 1, 2 or 4 for im2/im6 (2003; full size is 1800 wide) and 1, 2 or 3 for
/// view1/view5 (2005 and 2006; full size is about 1300 wide). Throws std::runtime_error naming the file.
Scene readScene(const SceneFiles& files);

/// How many disparities, from 0 up, a fair comparison searches where the truth (CV_32F, NaN unknown) is
/// known: to the largest one plus 4, rounded up to a multiple of 16, at most the width. 0 if none is known.
int disparitiesToReach(const cv::Mat& ground_truth);

/// The scene of layout kMiddlebury3 in `folder`; truth, mask and calibration are parts only if there.
SceneFiles middleburyFiles(const std::string& folder);

/// readScene(middleburyFiles(folder)).
Scene readScene(const std::string& folder);

}  // namespace pomona
