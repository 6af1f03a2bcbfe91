// Pictures side by side with captions, as one picture.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace pomona {

struct SheetCell {
  cv::Mat picture;     ///< CV_8UC3
  std::string title;   ///< ASCII, as all text of the sheet
  std::string remark;  ///< smaller, beside the title; may be empty
};

/// `cells` in rows of `columns`, all `cell_width_px` wide; a row is as high as its highest picture. CV_8UC3.
cv::Mat contactSheet(const std::vector<SheetCell>& cells, int columns, int cell_width_px);

}  // namespace pomona
