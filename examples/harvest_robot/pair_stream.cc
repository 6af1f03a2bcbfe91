#include "pair_stream.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

class FolderStream : public PairStream {
 public:
  explicit FolderStream(const std::string& folder) : folder_(folder), names_(namesOf("left")) {
    const std::vector<std::string> right = namesOf("right");
    requirePartners("left", names_, "right", right);
    requirePartners("right", right, "left", names_);
    if (names_.empty()) throw std::runtime_error(folder + ": holds no left*.png, left*.jpg or left*.bmp");
  }
  std::optional<Pair> next() override {
    if (at_ == names_.size()) return {};
    const std::string& name = names_[at_++];
    return Pair{read("left" + name), read("right" + name)};
  }

 private:
  // What follows the side in the names of its pictures; numbers need no leading zeros.
  std::vector<std::string> namesOf(const std::string& side) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      std::string extension = entry.path().extension().string();
      std::transform(extension.begin(), extension.end(), extension.begin(),
                     [](unsigned char c) { return std::tolower(c); });
      if (name.starts_with(side) && (extension == ".png" || extension == ".jpg" || extension == ".bmp"))
        names.push_back(name.substr(side.size()));
    }
    std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
      return std::pair(a.size(), a) < std::pair(b.size(), b);
    });
    return names;
  }
  void requirePartners(const std::string& side, const std::vector<std::string>& names,
                       const std::string& other, const std::vector<std::string>& others) const {
    for (const std::string& name : names)
      if (std::find(others.begin(), others.end(), name) == others.end())
        throw std::runtime_error(folder_ + ": " + side + name + " has no " + other + name);
  }
  cv::Mat read(const std::string& name) const {
    cv::Mat picture = cv::imread(folder_ + "/" + name);
    if (picture.empty()) throw std::runtime_error(folder_ + "/" + name + ": cannot be read as a picture");
    return picture;
  }
  std::string folder_;
  std::vector<std::string> names_;
  std::size_t at_ = 0;
};

class VideoStream : public PairStream {
 public:
  explicit VideoStream(const std::string& source) {
    constexpr std::size_t kMostDigits = 4;
    const bool is_camera = !source.empty() && source.size() <= kMostDigits &&
                           source.find_first_not_of("0123456789") == source.npos;
    if (!(is_camera ? video_.open(std::stoi(source)) : video_.open(source)))
      throw std::runtime_error(source + ": no folder, no video and no camera");
  }
  std::optional<Pair> next() override {
    cv::Mat both;
    if (!video_.read(both)) return {};
    return Pair{both.colRange(0, both.cols / 2), both.colRange(both.cols / 2, both.cols / 2 * 2)};
  }

 private:
  cv::VideoCapture video_;
};

}  // namespace

std::unique_ptr<PairStream> PairStream::open(const std::string& source) {
  if (std::filesystem::is_directory(source)) return std::make_unique<FolderStream>(source);
  return std::make_unique<VideoStream>(source);
}
