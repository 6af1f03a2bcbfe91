#include "pair_stream.h"

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <vector>

namespace {

class FolderStream : public PairStream {
 public:
  explicit FolderStream(const std::string& folder)
      : left_(filesOf(folder, "left")), right_(filesOf(folder, "right")) {
    if (left_.empty() || left_.size() != right_.size())
      throw std::runtime_error(folder + ": holds " + std::to_string(left_.size()) + " left* and " +
                               std::to_string(right_.size()) + " right* pictures");
  }
  bool next(cv::Mat& left, cv::Mat& right) override {
    if (at_ == left_.size()) return false;
    left = cv::imread(left_[at_]);
    right = cv::imread(right_[at_]);
    if (left.empty() || right.empty())
      throw std::runtime_error(left_[at_] + ": cannot be read, or its partner");
    ++at_;
    return true;
  }

 private:
  static std::vector<std::string> filesOf(const std::string& folder, const std::string& side) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string extension = entry.path().extension().string();
      if (entry.path().filename().string().starts_with(side) && (extension == ".png" || extension == ".jpg"))
        files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
  }
  std::vector<std::string> left_, right_;
  std::size_t at_ = 0;
};

class VideoStream : public PairStream {
 public:
  explicit VideoStream(const std::string& source) {
    const bool is_camera = source.find_first_not_of("0123456789") == source.npos;
    if (!(is_camera ? video_.open(std::stoi(source)) : video_.open(source)))
      throw std::runtime_error(source + ": no folder, no video and no camera");
  }
  bool next(cv::Mat& left, cv::Mat& right) override {
    if (!video_.read(both_)) return false;
    left = both_.colRange(0, both_.cols / 2);
    right = both_.colRange(both_.cols / 2, both_.cols / 2 * 2);
    return true;
  }

 private:
  cv::VideoCapture video_;
  cv::Mat both_;
};

}  // namespace

std::unique_ptr<PairStream> PairStream::open(const std::string& source) {
  if (std::filesystem::is_directory(source)) return std::make_unique<FolderStream>(source);
  return std::make_unique<VideoStream>(source);
}
