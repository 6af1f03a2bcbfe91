#include "apps/contact_sheet.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace pomona {
namespace {

constexpr int kGap_px = 10, kCaption_px = 26;
const cv::Scalar kPaper(255, 255, 255), kInk(35, 30, 25), kSoftInk(120, 112, 105);

cv::Mat scaled(const cv::Mat& picture, int width) {
  const int height = std::max(1, (picture.rows * width + picture.cols / 2) / picture.cols);
  cv::Mat out;
  const bool smaller = width < picture.cols;
  cv::resize(picture, out, {width, height}, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_NEAREST);
  return out;
}

// Returns where the text ends.
int write(cv::Mat& sheet, const std::string& text, cv::Point begin, double size, const cv::Scalar& ink) {
  cv::putText(sheet, text, begin, cv::FONT_HERSHEY_SIMPLEX, size, ink, 1, cv::LINE_AA);
  int baseline = 0;
  return begin.x + cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, 1, &baseline).width;
}

}  // namespace

cv::Mat contactSheet(const std::vector<SheetCell>& cells, int columns, int cell_width_px) {
  std::vector<cv::Mat> pictures;
  for (const SheetCell& cell : cells) pictures.push_back(scaled(cell.picture, cell_width_px));
  const int count = static_cast<int>(cells.size()), rows = (count + columns - 1) / columns;
  std::vector<int> tops = {kGap_px};
  for (int row = 0; row < rows; ++row) {
    int height = 0;
    for (int i = row * columns; i < std::min(count, (row + 1) * columns); ++i)
      height = std::max(height, pictures[i].rows);
    tops.push_back(tops.back() + kCaption_px + height + kGap_px);
  }
  cv::Mat sheet(tops.back(), kGap_px + columns * (cell_width_px + kGap_px), CV_8UC3, kPaper);
  for (int i = 0; i < count; ++i) {
    const cv::Point corner(kGap_px + i % columns * (cell_width_px + kGap_px), tops[i / columns]);
    const cv::Point text = corner + cv::Point(0, kCaption_px - 9);
    const int end = write(sheet, cells[i].title, text, 0.55, kInk);
    write(sheet, cells[i].remark, {end + kGap_px, text.y}, 0.42, kSoftInk);
    pictures[i].copyTo(sheet(cv::Rect({corner.x, corner.y + kCaption_px}, pictures[i].size())));
  }
  return sheet;
}

}  // namespace pomona
