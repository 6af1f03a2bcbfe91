// Detectors of a few numbers, as files: each answers with a box around every red cell of 4 x 4 in a view of
// 64 x 64.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pomona {

constexpr int kTinyInput = 64, kTinyCell = 4, kTinyGrid = kTinyInput / kTinyCell;

template <typename T>
void appendValue(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// What makes objectness of a cell's colours: red minus blue, summed and scaled.
inline std::vector<float> rednessWeights(float scale) {
  std::vector<float> weights;
  for (const float channel : {1.f, 0.f, -1.f})
    weights.insert(weights.end(), kTinyCell * kTinyCell, channel * scale / (kTinyCell * kTinyCell));
  return weights;
}

inline std::string tinyDarknetShape() {
  return "[net]\nwidth=64\nheight=64\nchannels=3\n\n"
         "[convolutional]\nfilters=6\nsize=4\nstride=4\npad=0\nactivation=linear\n\n"
         "[yolo]\nmask=0\nanchors=4,4\nclasses=1\nnum=1\n";
}

/// Per filter (x, y, width, height, objectness, class) a bias, then the filters' weights. Of version 0.1 or
/// 0.2; `side` is the logarithm of a box's sides.
inline std::string tinyDarknetWeights(std::int32_t minor_version = 2, float side = 0) {
  std::string bytes;
  for (const std::int32_t version : {0, minor_version, 0}) appendValue(bytes, version);
  if (minor_version < 2)
    appendValue(bytes, std::int32_t{0});
  else
    appendValue(bytes, std::int64_t{0});
  for (const float bias : {0.f, 0.f, side, side, -8.f, 10.f}) appendValue(bytes, bias);
  for (int filter = 0; filter < 6; ++filter)
    for (const float weight : rednessWeights(filter == 4 ? 20.f : 0.f)) appendValue(bytes, weight);
  return bytes;
}

/// The little of Protocol Buffers' encoding that an ONNX file needs.
class ProtoMessage {
 public:
  ProtoMessage& number(int field, std::uint64_t value) {
    varint(static_cast<std::uint64_t>(field) << 3);
    varint(value);
    return *this;
  }
  ProtoMessage& text(int field, std::string_view value) {
    varint(static_cast<std::uint64_t>(field) << 3 | 2);
    varint(value.size());
    bytes_ += value;
    return *this;
  }
  ProtoMessage& message(int field, const ProtoMessage& value) { return text(field, value.bytes_); }
  const std::string& bytes() const { return bytes_; }

 private:
  void varint(std::uint64_t value) {
    for (; value >= 128; value >>= 7) bytes_ += static_cast<char>(value % 128 + 128);
    bytes_ += static_cast<char>(value);
  }
  std::string bytes_;
};

inline ProtoMessage onnxTensor(std::string_view name, const std::vector<std::int64_t>& sides, int type,
                               std::string_view raw) {
  ProtoMessage tensor;
  for (const std::int64_t side : sides) tensor.number(1, static_cast<std::uint64_t>(side));
  return tensor.number(2, static_cast<std::uint64_t>(type)).text(8, name).text(9, raw);
}

inline ProtoMessage onnxInts(std::string_view name, const std::vector<std::int64_t>& values) {
  constexpr int kInts = 7;
  ProtoMessage attribute;
  attribute.text(1, name);
  for (const std::int64_t value : values) attribute.number(8, static_cast<std::uint64_t>(value));
  return attribute.number(20, kInts);
}

inline ProtoMessage onnxNode(std::string_view operation, const std::vector<std::string>& inputs,
                             std::string_view output) {
  ProtoMessage node;
  for (const std::string& input : inputs) node.text(1, input);
  return node.text(2, output).text(3, output).text(4, operation);
}

inline ProtoMessage onnxValue(std::string_view name, const std::vector<std::int64_t>& sides) {
  ProtoMessage shape;
  for (const std::int64_t side : sides)
    shape.message(1, ProtoMessage().number(1, static_cast<std::uint64_t>(side)));
  const ProtoMessage tensor = ProtoMessage().number(1, 1).message(2, shape);
  return ProtoMessage().text(1, name).message(2, ProtoMessage().message(1, tensor));
}

/// Convolution, then the cells' places are added, then one row per cell: centre, size, objectness, score.
inline std::string tinyOnnx() {
  constexpr int kFloat = 1, kInt64 = 7, kCells = kTinyGrid * kTinyGrid;
  std::string weights, places, shape;
  for (int filter = 0; filter < 6; ++filter)
    for (const float weight : rednessWeights(filter == 4 ? 1.f : 0.f)) appendValue(weights, weight);
  for (int channel = 0; channel < 6; ++channel)
    for (int cell = 0; cell < kCells; ++cell) {
      const float x = (cell % kTinyGrid + 0.5f) * kTinyCell, y = (cell / kTinyGrid + 0.5f) * kTinyCell;
      const float values[] = {x, y, kTinyCell, kTinyCell, 0, 1};
      appendValue(places, values[channel]);
    }
  for (const std::int64_t side : {1, 6, kCells}) appendValue(shape, side);
  ProtoMessage graph;
  graph.message(1, onnxNode("Conv", {"image", "weights"}, "redness")
                       .message(5, onnxInts("kernel_shape", {kTinyCell, kTinyCell}))
                       .message(5, onnxInts("strides", {kTinyCell, kTinyCell})));
  graph.message(1, onnxNode("Add", {"redness", "places"}, "cells"));
  graph.message(1, onnxNode("Reshape", {"cells", "shape"}, "channels"));
  graph.message(1, onnxNode("Transpose", {"channels"}, "boxes").message(5, onnxInts("perm", {0, 2, 1})));
  graph.text(2, "tiny");
  graph.message(5, onnxTensor("weights", {6, 3, kTinyCell, kTinyCell}, kFloat, weights));
  graph.message(5, onnxTensor("places", {1, 6, kTinyGrid, kTinyGrid}, kFloat, places));
  graph.message(5, onnxTensor("shape", {3}, kInt64, shape));
  graph.message(11, onnxValue("image", {1, 3, kTinyInput, kTinyInput}));
  graph.message(12, onnxValue("boxes", {1, kCells, 6}));
  const ProtoMessage opset = ProtoMessage().text(1, "").number(2, 11);
  return ProtoMessage().number(1, 7).message(8, opset).message(7, graph).bytes();
}

}  // namespace pomona
