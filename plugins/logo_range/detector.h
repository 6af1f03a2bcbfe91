// Boxes around things, from a network that was trained elsewhere.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/dnn.hpp>
#include <string>
#include <vector>

namespace pomona {

struct Detection {
  int kind = 0;  ///< number of the class
  float confidence = 0;
  cv::Rect2f box_px;
};

struct DetectorOptions {
  /// Darknet: the .cfg, and its .weights beside it or in `weights`. ONNX: the .onnx.
  std::string network, weights;
  std::string labels;  ///< a file with one class name per line; empty: numbers
  int input_size_px = 416;
  double min_confidence = 0.25;
  double max_overlap = 0.45;  ///< of two boxes of one class; area of the intersection by that of the union
};

/// Detectors of the YOLO family, on OpenCV's cv::dnn. The view is scaled to a square of input_size_px and
/// given as RGB in 0..1. Outputs have a row per candidate: centre x, centre y, width, height, objectness, and
/// a score per class: sides as shares of the view (Darknet), or in pixels of the input (ONNX, as YOLOv5
/// exports it).
class Detector {
 public:
  /// Throws std::runtime_error "path: ..." for files that are missing or are no network of a known kind, and
  /// std::invalid_argument for a name that ends neither in .cfg nor .onnx.
  explicit Detector(const DetectorOptions& options);

  /// The most confident first, overlapping ones left out. Throws std::runtime_error if the network does not
  /// answer as described above.
  std::vector<Detection> detect(const cv::Mat& view);

  /// The class's name, or "class N".
  std::string labelOf(int kind) const;

 private:
  void addCandidates(const cv::Mat& output, cv::Size view, std::vector<Detection>& all) const;

  DetectorOptions options_;
  bool in_input_pixels_ = false;
  cv::dnn::Net net_;
  std::vector<std::string> labels_;
};

}  // namespace pomona
