// Pictures of what was found, for people.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "picking_list.h"

class Drawing {
 public:
  /// `target`: a folder for one picture per frame, or "window". Throws std::runtime_error for a folder that
  /// cannot be written to: better now than after the first frame.
  explicit Drawing(const std::string& target);

  /// False if it is time to stop: somebody pressed escape in the window.
  bool show(int frame, const cv::Mat& bgr, const std::vector<Pick>& picks) const;

 private:
  std::string folder_;  // empty: the window
};
