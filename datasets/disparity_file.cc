#include "datasets/disparity_file.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "datasets/input_file.h"
#include "datasets/pfm.h"
#include "datasets/png16.h"

namespace pomona {

cv::Mat readDisparity(const std::string& path) {
  const std::string extension = extensionOf(path);
  if (extension == ".png") return readDisparityPng(path, kKittiScale);
  if (extension != ".pfm")
    throw std::runtime_error(path + ": a disparity map is a .pfm or .png file, not '" + extension + "'");
  cv::Mat disparity = readPfm(path);
  if (disparity.channels() != 1)
    throw std::runtime_error(path + ": expected 1 channel ('Pf'), found 3 ('PF')");
  for (int y = 0; y < disparity.rows; ++y)
    for (int x = 0; x < disparity.cols; ++x)
      if (float& d = disparity.at<float>(y, x); !std::isfinite(d))
        d = std::numeric_limits<float>::quiet_NaN();
  return disparity;
}

}  // namespace pomona
