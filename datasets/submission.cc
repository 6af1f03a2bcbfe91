#include "datasets/submission.h"

#include <array>
#include <cstdio>
#include <string_view>

#include "datasets/pfm.h"
#include "datasets/png16.h"

namespace pomona {
namespace {

std::string shown(double seconds) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.6g", seconds);
  return text.data();
}

bool isMiddleburySplit(std::string_view split) {
  if (split.empty() || std::string_view("FHQ").find(split.back()) == split.npos) return false;
  split.remove_suffix(1);
  return split == "training" || split == "test";
}

// A name that had to be told apart from others, "training/000000_10", begins with the split it is of.
struct Name {
  std::string folder, leaf;
  explicit Name(const std::string& scene)
      : folder(scene.substr(0, scene.rfind('/') + 1)), leaf(scene.substr(folder.size())) {}
};

std::vector<OutputFile> middlebury(const SceneFiles& scene, const std::string& method, OutputMode mode,
                                   const cv::Mat& disparity, double seconds) {
  const bool needs_split = isMiddleburySplit(scene.split()) && Name(scene.name).folder.empty();
  const std::string folder = (needs_split ? scene.split() + "/" : "") + scene.name;
  const char* kind = mode == OutputMode::kSparse ? "_s" : "";
  return {{folder + "/disp0" + method + kind + ".pfm", encodePfm(disparity)},
          {folder + "/time" + method + ".txt", shown(seconds) + "\n"}};
}

}  // namespace

std::vector<OutputFile> submissionFiles(const SceneFiles& scene, const std::string& method, OutputMode mode,
                                        const cv::Mat& disparity, double seconds) {
  const Name name(scene.name);
  switch (scene.layout) {
    case SceneLayout::kKitti2012:
      return {{name.folder + name.leaf + ".png", encodeDisparityPng(disparity, kKittiScale)}};
    case SceneLayout::kKitti2015:
      return {{name.folder + "disp_0/" + name.leaf + ".png", encodeDisparityPng(disparity, kKittiScale)}};
    case SceneLayout::kEth3d: {
      const std::string path = name.folder + "low_res_two_view/" + name.leaf;
      return {{path + ".pfm", encodePfm(disparity)}, {path + ".txt", "runtime " + shown(seconds) + "\n"}};
    }
    case SceneLayout::kMiddlebury3:
    case SceneLayout::kMiddlebury2:
    case SceneLayout::kManifest:
      break;
  }
  return middlebury(scene, method, mode, disparity, seconds);
}

}  // namespace pomona
