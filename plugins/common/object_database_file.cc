// The layout of a database file:
//   "pomonaob"  version u32  kind u32  objects u32
//   per object: length u32, label; width i32, height i32;
//     width i32, height i32 of the thumbnail, its pixels, a byte each, row by row; features u32
//     per feature: x f32, y f32, size f32, angle f32, view i32; its descriptor, f32 each
#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>

#include "datasets/input_file.h"
#include "plugins/common/object_database.h"

namespace pomona {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMagic = "pomonaob";
constexpr std::uint32_t kVersion = 2;  // 1 had no thumbnails
constexpr int kLargestSide_px = 1 << 16;
constexpr std::uint32_t kLongestLabel = 4096;

template <typename T>
void append(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

// Takes a file apart from its start; whatever is not there or not allowed fails with its place.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), bytes_(readFile(path)) {}

  bool isEmpty() const { return bytes_.empty(); }
  bool startsWith(std::string_view magic) const { return bytes_.starts_with(magic); }
  std::string_view text(std::size_t length, const char* what) {
    if (bytes_.size() - at_ < length) fail(std::string("the file is cut off within ") + what);
    const std::string_view part = std::string_view(bytes_).substr(at_, length);
    at_ += length;
    return part;
  }
  template <typename T>
  T number(const char* what, T low, T high) {
    T value;
    std::memcpy(&value, text(sizeof(T), what).data(), sizeof(T));
    if (!(value >= low && value <= high)) {
      at_ -= sizeof(T);
      fail(std::string(what) + " is " + std::to_string(value) + "; allowed: " + std::to_string(low) + " to " +
           std::to_string(high));
    }
    return value;
  }
  // How many of something that takes `bytes_each` follow: never more than the rest of the file could hold.
  std::uint32_t count(const char* what, std::size_t bytes_each) {
    const std::size_t rest = bytes_.size() - at_;
    const std::size_t most = rest < sizeof(std::uint32_t) ? 0 : (rest - sizeof(std::uint32_t)) / bytes_each;
    const auto count = number<std::uint32_t>(what, 0, std::numeric_limits<std::uint32_t>::max());
    if (count > most)
      fail("the file is cut off: " + std::string(what) + " is " + std::to_string(count) + ", with room for " +
           std::to_string(most));
    return count;
  }
  void requireEnd() {
    if (at_ != bytes_.size()) fail("nothing is allowed after the last object");
  }
  [[noreturn]] void fail(const std::string& message) const { failAtByte(path_, at_, message); }

 private:
  std::string path_, bytes_;
  std::size_t at_ = 0;
};

cv::KeyPoint readKeypoint(Reader& file, cv::Size size) {
  constexpr float kMost = 1e6f;
  cv::KeyPoint keypoint;
  keypoint.pt.x = file.number<float>("x", 0, static_cast<float>(size.width));
  keypoint.pt.y = file.number<float>("y", 0, static_cast<float>(size.height));
  keypoint.size = file.number<float>("size", 0, kMost);
  keypoint.angle = file.number<float>("angle", -1, 360);
  keypoint.class_id = file.number<std::int32_t>("view", 0, std::numeric_limits<std::int16_t>::max());
  return keypoint;
}

constexpr std::size_t featureBytes(int length) {
  return 4 * sizeof(float) + sizeof(std::int32_t) + static_cast<std::size_t>(length) * sizeof(float);
}

cv::Mat readThumbnail(Reader& file, cv::Size picture) {
  const int width = file.number<std::int32_t>("the thumbnail's width", 1, picture.width);
  const int height = file.number<std::int32_t>("the thumbnail's height", 1, picture.height);
  const std::string_view pixels = file.text(static_cast<std::size_t>(width) * height, "a thumbnail");
  cv::Mat thumbnail(height, width, CV_8U);
  std::memcpy(thumbnail.data, pixels.data(), pixels.size());
  return thumbnail;
}

KnownObject readObject(Reader& file, FeatureKind kind) {
  KnownObject object;
  const int length = descriptorLength(kind);
  object.label = file.text(file.number<std::uint32_t>("the label's length", 1, kLongestLabel), "a label");
  object.size_px.width = file.number<std::int32_t>("width", 1, kLargestSide_px);
  object.size_px.height = file.number<std::int32_t>("height", 1, kLargestSide_px);
  object.thumbnail = readThumbnail(file, object.size_px);
  const std::uint32_t features = file.count("the number of features", featureBytes(length));
  object.features.descriptors.create(static_cast<int>(features), length, CV_32F);
  for (std::uint32_t i = 0; i < features; ++i) {
    object.features.keypoints.push_back(readKeypoint(file, object.size_px));
    float* const values = object.features.descriptors.ptr<float>(static_cast<int>(i));
    for (int k = 0; k < length; ++k) values[k] = file.number<float>("a descriptor's value", -1.001f, 1.001f);
  }
  return object;
}

}  // namespace

std::string encodeObjectDatabase(const ObjectDatabase& database) {
  std::string bytes(kMagic);
  append(bytes, kVersion);
  append(bytes, static_cast<std::uint32_t>(database.kind));
  append(bytes, static_cast<std::uint32_t>(database.objects.size()));
  for (const KnownObject& object : database.objects) {
    append(bytes, static_cast<std::uint32_t>(object.label.size()));
    bytes += object.label;
    append(bytes, static_cast<std::int32_t>(object.size_px.width));
    append(bytes, static_cast<std::int32_t>(object.size_px.height));
    append(bytes, static_cast<std::int32_t>(object.thumbnail.cols));
    append(bytes, static_cast<std::int32_t>(object.thumbnail.rows));
    bytes.append(object.thumbnail.ptr<char>(), object.thumbnail.total());
    append(bytes, static_cast<std::uint32_t>(object.features.count()));
    for (int i = 0; i < object.features.count(); ++i) {
      const cv::KeyPoint& keypoint = object.features.keypoints[i];
      for (const float value : {keypoint.pt.x, keypoint.pt.y, keypoint.size, keypoint.angle})
        append(bytes, value);
      append(bytes, static_cast<std::int32_t>(keypoint.class_id));
      const cv::Mat row = object.features.descriptors.row(i);
      bytes.append(row.ptr<char>(), row.total() * row.elemSize());
    }
  }
  return bytes;
}

ObjectDatabase readObjectDatabase(const std::string& path) {
  Reader file(path);
  if (file.isEmpty()) file.fail("the database is empty");
  if (!file.startsWith(kMagic)) file.fail("this is no database of objects");
  file.text(kMagic.size(), "the magic");
  file.number<std::uint32_t>("the version", kVersion, kVersion);
  ObjectDatabase database;
  const auto kind = file.number<std::uint32_t>("the kind of features", 1, 4);
  database.kind = static_cast<FeatureKind>(kind);
  featureKindOf(nameOf(database.kind));
  const std::uint32_t objects = file.count("the number of objects", 7 * sizeof(std::uint32_t));
  if (objects == 0) file.fail("the database is empty: the number of objects is 0");
  for (std::uint32_t i = 0; i < objects; ++i) database.objects.push_back(readObject(file, database.kind));
  file.requireEnd();
  return database;
}

}  // namespace pomona
