// The report of an evaluation: one HTML file that needs nothing else.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/eval_record.h"
#include "datasets/colorize.h"
#include "datasets/scene.h"

namespace pomona {

/// Collects the maps of a run scene by scene, and makes the page.
///
/// Each map is embedded as a gray PNG of twice its height, the high bytes of 16-bit codes above the low ones:
/// 0 unknown, else 1 + 16 (d - low). The page colours it, forms the error and reads values from it. Maps
/// wider than kWidest are thinned out by a whole factor.
class HtmlReport {
 public:
  static constexpr int kWidest = 800;

  /// Begins the scene that the following maps belong to.
  void addScene(const std::string& name, const Scene& scene, int num_disparities);
  /// `disparity` (CV_32F, NaN unknown) as `method` found it.
  void addMap(const std::string& method, const cv::Mat& disparity);

  /// The page, from what was added and the figures of the same run. Scenes without figures are left out.
  std::string html(const EvalRecord& record) const;

 private:
  struct SceneEntry {
    std::string name;
    int width = 0, height = 0, num_disparities = 0;
    int factor = 1;           // of the thinning
    float low = 0;            // disparity of code 1
    DisparityRange colors;    // the disparities that the ends of the colour scale stand for
    std::string left, truth;  // base64: JPEG, PNG
    std::vector<std::pair<std::string, std::string>> maps;  // method, base64 PNG
  };
  std::vector<SceneEntry> scenes_;
};

}  // namespace pomona
