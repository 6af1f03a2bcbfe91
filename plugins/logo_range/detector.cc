#include "plugins/logo_range/detector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "datasets/input_file.h"

namespace pomona {
namespace {

std::string firstLineOf(const cv::Exception& error) {
  return printable(error.err.substr(0, error.err.find('\n')));
}

// How many bytes of weights the network takes. cv::dnn itself reads past the end of a shorter file without a
// word.
std::size_t weightBytesOf(cv::dnn::Net& net) {
  std::size_t values = 0;
  for (const cv::String& name : net.getLayerNames()) {
    const cv::Ptr<cv::dnn::Layer> layer = net.getLayer(net.getLayerId(name));
    if (layer->type == "Region") continue;  // its numbers are the anchors of the .cfg
    for (const cv::Mat& blob : layer->blobs) values += blob.total();
  }
  return values * sizeof(float);
}

// A version of three numbers, and how many pictures were seen in training: since version 0.2 with 8 bytes,
// before with 4.
std::size_t headerBytesOf(const std::string& weights) {
  std::int32_t version[3] = {};
  std::memcpy(version, weights.data(), std::min(weights.size(), sizeof(version)));
  const bool is_old = std::int64_t{10} * version[0] + version[1] < 2;
  return sizeof(version) + (is_old ? sizeof(std::int32_t) : sizeof(std::int64_t));
}

cv::dnn::Net readDarknet(const std::string& network, std::string weights) {
  if (weights.empty()) weights = std::filesystem::path(network).replace_extension(".weights");
  const std::string shape = readFile(network), numbers = readFile(weights);
  const auto fail_short = [&](std::size_t needed) {
    throw std::runtime_error(weights + ": has " + std::to_string(numbers.size()) + " bytes; " + network +
                             " needs " + std::to_string(needed));
  };
  const std::size_t header = headerBytesOf(numbers);
  if (numbers.size() < header) fail_short(header);
  cv::dnn::Net net;
  try {
    net = cv::dnn::readNetFromDarknet(shape.data(), shape.size(), numbers.data(), numbers.size());
  } catch (const cv::Exception& error) {
    throw std::runtime_error(network + ": is no network that fits " + weights + ": " + firstLineOf(error));
  }
  if (net.empty()) throw std::runtime_error(network + ": holds no network");
  const std::size_t needed = header + weightBytesOf(net);
  if (numbers.size() < needed) fail_short(needed);
  return net;
}

cv::dnn::Net readOnnx(const std::string& network) {
  const std::string bytes = readFile(network);
  try {
    cv::dnn::Net net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    if (!net.empty()) return net;
  } catch (const cv::Exception& error) {
    throw std::runtime_error(network + ": is no network that OpenCV can read: " + firstLineOf(error));
  }
  throw std::runtime_error(network + ": holds no network");
}

float overlapOf(const cv::Rect2f& a, const cv::Rect2f& b) {
  const float both = (a & b).area();
  return both / (a.area() + b.area() - both);
}

}  // namespace

Detector::Detector(const DetectorOptions& options) : options_(options) {
  const std::string extension = extensionOf(options.network);
  if (extension != ".cfg" && extension != ".onnx")
    throw std::invalid_argument("network is '" + options.network +
                                "'; allowed: a .cfg (Darknet) or .onnx file");
  in_input_pixels_ = extension == ".onnx";
  net_ = in_input_pixels_ ? readOnnx(options.network) : readDarknet(options.network, options.weights);
  net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
  if (options.labels.empty()) return;
  std::istringstream lines(readFile(options.labels));
  for (std::string line; std::getline(lines, line);) labels_.push_back(printable(line));
}

std::vector<Detection> Detector::detect(const cv::Mat& view) {
  cv::Mat color = view;
  if (view.channels() == 1) cv::merge(std::vector<cv::Mat>(3, view), color);
  constexpr bool kSwapRedAndBlue = true, kCrop = false;
  std::vector<cv::Mat> outputs;
  try {
    net_.setInput(cv::dnn::blobFromImage(color, 1 / 255.0, {options_.input_size_px, options_.input_size_px},
                                         {}, kSwapRedAndBlue, kCrop));
    net_.forward(outputs, net_.getUnconnectedOutLayersNames());
  } catch (const cv::Exception& error) {
    throw std::runtime_error(options_.network + ": does not take a view of " +
                             std::to_string(options_.input_size_px) + " px a side: " + firstLineOf(error));
  }
  std::vector<Detection> all, best;
  for (const cv::Mat& output : outputs) addCandidates(output, view.size(), all);
  std::stable_sort(all.begin(), all.end(),
                   [](const Detection& a, const Detection& b) { return a.confidence > b.confidence; });
  for (const Detection& candidate : all)
    if (std::none_of(best.begin(), best.end(), [&](const Detection& better) {
          return better.kind == candidate.kind &&
                 overlapOf(better.box_px, candidate.box_px) > static_cast<float>(options_.max_overlap);
        }))
      best.push_back(candidate);
  return best;
}

void Detector::addCandidates(const cv::Mat& output, cv::Size view, std::vector<Detection>& all) const {
  constexpr int kBoxValues = 5;
  const int values = output.dims >= 2 ? output.size[output.dims - 1] : 0;
  if (output.type() != CV_32F || values <= kBoxValues)
    throw std::runtime_error(
        options_.network + ": an output has " + std::to_string(values) +
        " values per candidate; allowed: 4 of the box, objectness, and a score per class");
  const cv::Mat rows = output.reshape(1, static_cast<int>(output.total() / static_cast<std::size_t>(values)));
  const float unit = in_input_pixels_ ? 1.f / static_cast<float>(options_.input_size_px) : 1.f;
  const float to_x = unit * static_cast<float>(view.width), to_y = unit * static_cast<float>(view.height);
  for (int i = 0; i < rows.rows; ++i) {
    const float* const row = rows.ptr<float>(i);
    const float* const score = std::max_element(row + kBoxValues, row + values);
    // Darknet's layers have multiplied the scores by the objectness already.
    const float confidence = in_input_pixels_ ? row[4] * *score : *score;
    if (!(confidence >= static_cast<float>(options_.min_confidence))) continue;
    const cv::Size2f size(row[2] * to_x, row[3] * to_y);
    const cv::Point2f corner(row[0] * to_x - size.width / 2 - 0.5f, row[1] * to_y - size.height / 2 - 0.5f);
    // Weights that fit nothing, or too large a size's exponent, make boxes that are nowhere.
    const float sides[] = {corner.x, corner.y, size.width, size.height};
    if (!std::all_of(std::begin(sides), std::end(sides), [](float side) { return std::isfinite(side); }))
      continue;
    const cv::Rect2f box = cv::Rect2f(corner, size) & cv::Rect2f(0, 0, float(view.width), float(view.height));
    if (box.empty()) continue;
    all.push_back({static_cast<int>(score - row) - kBoxValues, confidence, box});
  }
}

std::string Detector::labelOf(int kind) const {
  return kind < static_cast<int>(labels_.size()) ? labels_[kind] : "class " + std::to_string(kind);
}

}  // namespace pomona
