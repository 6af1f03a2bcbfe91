#include "plugins/host/checks.h"

#include <stdexcept>
#include <string>

#include "plugins/host/text.h"

namespace pomona {
namespace {

std::string sizeText(const cv::Mat& image) {
  return std::to_string(image.cols) + " x " + std::to_string(image.rows);
}

bool isPicture(const cv::Mat& image) {
  return !image.empty() && image.dims == 2 && (image.type() == CV_8UC1 || image.type() == CV_8UC3);
}

}  // namespace

void checkPluginInputs(const cv::Mat& left, const cv::Mat& right, const StereoCalibration& calibration,
                       const cv::Mat& mask) {
  if (!isPicture(left))
    throw std::invalid_argument("left view: " + sizeText(left) + ", type " + cv::typeToString(left.type()) +
                                "; allowed: 8 bits, 1 or 3 channels, not empty");
  if (right.size() != left.size() || right.type() != left.type())
    throw std::invalid_argument("right view: " + sizeText(right) + ", type " +
                                cv::typeToString(right.type()) + "; allowed: as the left one, " +
                                sizeText(left) + ", " + cv::typeToString(left.type()));
  if (!mask.empty() && (mask.size() != left.size() || mask.type() != CV_8UC1))
    throw std::invalid_argument("mask: " + sizeText(mask) + ", type " + cv::typeToString(mask.type()) +
                                "; allowed: " + sizeText(left) + ", CV_8UC1");
  calibration.validate();
  if (calibration.width > 0 && cv::Size(calibration.width, calibration.height) != left.size())
    throw std::invalid_argument("calibration: for images of " + std::to_string(calibration.width) + " x " +
                                std::to_string(calibration.height) + "; these have " + sizeText(left));
}

void checkSparseResult(const SparseResult& result) {
  const int objects = static_cast<int>(result.objects.size());
  for (std::size_t i = 0; i < result.points.size(); ++i)
    if (const int object = result.points[i].object; object < -1 || object >= objects)
      throw std::runtime_error("the plugin's point " + std::to_string(i) + " belongs to object " +
                               std::to_string(object) + "; allowed: -1 to " + std::to_string(objects - 1));
  for (const SparseFigure& figure : result.figures)
    if (figure.name.empty()) throw std::runtime_error("one of the plugin's figures has no name");
  for (const SparsePicture& picture : result.pictures)
    if (!isPlainName(picture.name, '-') || !isPicture(picture.image))
      throw std::runtime_error("the plugin's picture '" + picture.name + "' is " + sizeText(picture.image) +
                               ", type " + cv::typeToString(picture.image.type()) +
                               "; allowed: 8 bits, 1 or 3 channels, not empty, with a plain name");
}

}  // namespace pomona
