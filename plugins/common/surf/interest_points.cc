#include "plugins/common/surf/interest_points.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>

#include "core/parallel.h"
#include "plugins/common/surf/box_hessian.h"

namespace pomona {
namespace {

constexpr int kStripRows = 64;  // rows of samples per task; two more are computed twice
// The scales of successive octaves overlap, and a blob may be found in both. It is one if the places are
// within so many scales and the sizes within this ratio.
constexpr float kTwinScales = 1, kTwinRatio = 1.5f;
constexpr double kFurthest = 1;  // of a step

/// Determinants of one octave around one sample: `at[layer][row][k]`.
struct Neighbourhood {
  const float* at[3][3];

  double value(int layer, int row, int k) const { return at[layer + 1][row + 1][k]; }

  /// Of equal values the first in memory's order is the maximum.
  bool isMaximum(int k) const {
    const float centre = at[1][1][k];
    for (int layer = 0; layer < 3; ++layer)
      for (int row = 0; row < 3; ++row)
        for (int column = -1; column <= 1; ++column) {
          const int order = (layer * 3 + row) * 3 + column + 1 - 13;
          const float other = at[layer][row][k + column];
          if (order < 0 ? other >= centre : order > 0 && other > centre) return false;
        }
    return true;
  }

  struct Peak {
    double x, y, layer;  // from the sample, in steps
    double value;
  };
  std::optional<Peak> peak(int k) const {
    const double centre = value(0, 0, k);
    const cv::Vec3d gradient((value(0, 0, k + 1) - value(0, 0, k - 1)) / 2,
                             (value(0, 1, k) - value(0, -1, k)) / 2, (value(1, 0, k) - value(-1, 0, k)) / 2);
    const double xx = value(0, 0, k + 1) + value(0, 0, k - 1) - 2 * centre;
    const double yy = value(0, 1, k) + value(0, -1, k) - 2 * centre;
    const double ss = value(1, 0, k) + value(-1, 0, k) - 2 * centre;
    const double xy =
        (value(0, 1, k + 1) + value(0, -1, k - 1) - value(0, 1, k - 1) - value(0, -1, k + 1)) / 4;
    const double xs =
        (value(1, 0, k + 1) + value(-1, 0, k - 1) - value(1, 0, k - 1) - value(-1, 0, k + 1)) / 4;
    const double ys = (value(1, 1, k) + value(-1, -1, k) - value(1, -1, k) - value(-1, 1, k)) / 4;
    const cv::Matx33d hessian(xx, xy, xs, xy, yy, ys, xs, ys, ss);
    if (cv::determinant(hessian) == 0) return std::nullopt;
    const cv::Vec3d step = -(hessian.inv() * gradient);
    for (int i = 0; i < 3; ++i)
      if (!(std::abs(step[i]) <= kFurthest)) return std::nullopt;
    return Peak{step[0], step[1], step[2], centre + gradient.dot(step) / 2};
  }
};

/// A band of rows of one octave. It keeps three rows of determinants per layer, which stay in the cache.
class Strip {
 public:
  Strip(const IntegralImage& image, const SurfOptions& options, int octave)
      : image_(image),
        options_(options),
        octave_(octave),
        step_(1 << octave),
        hessian_(image),
        rows_((image.width() - 1) / step_ + 1, 3 * options.layers) {}

  /// Maxima in rows [begin, end) of samples; `count` rows there are.
  void find(int begin, int end, int count, std::vector<InterestPoint>& found) {
    for (int row = std::max(0, begin - 1); row < std::min(count, end + 1); ++row) {
      for (int layer = 0; layer < options_.layers; ++layer)
        hessian_.determinants(filterOf(octave_, layer), row * step_, step_, rowOf(layer, row));
      if (row - 1 >= std::max(1, begin)) findInRow(row - 1, found);
    }
  }

 private:
  float* rowOf(int layer, int row) { return rows_.row(layer * 3 + row % 3); }

  void findInRow(int row, std::vector<InterestPoint>& found) {
    for (int layer = 1; layer + 1 < options_.layers; ++layer) {
      // All neighbours must be real values, those of the largest filter, too.
      const int margin = filterOf(octave_, layer + 1).radius() + step_;
      const int y = row * step_;
      if (y < margin || y + margin >= image_.height()) return;
      Neighbourhood around;
      for (int l = 0; l < 3; ++l)
        for (int r = 0; r < 3; ++r) around.at[l][r] = rowOf(layer + l - 1, row + r - 1);
      const int begin = (margin + step_ - 1) / step_, end = (image_.width() - 1 - margin) / step_ + 1;
      const float* values = around.at[1][1];
      for (int k = begin; k < end; ++k)
        if (values[k] >= options_.hessian_threshold && around.isMaximum(k))
          keep(around, layer, k, row, found);
    }
  }

  void keep(const Neighbourhood& around, int layer, int k, int row, std::vector<InterestPoint>& found) {
    const auto peak = around.peak(k);
    if (!peak) return;
    const BoxFilter filter = filterOf(octave_, layer);
    const double size_step = filterOf(octave_, layer + 1).size() - filter.size();
    found.push_back({static_cast<float>((k + peak->x) * step_), static_cast<float>((row + peak->y) * step_),
                     static_cast<float>(filter.size() + peak->layer * size_step),
                     static_cast<float>(peak->value), octave_,
                     hessian_.isDark(filter, k * step_, row * step_)});
  }

  const IntegralImage& image_;
  const SurfOptions& options_;
  int octave_, step_;
  BoxHessian hessian_;
  Image<float> rows_;
};

bool areTwins(const InterestPoint& a, const InterestPoint& b) {
  const auto [least, most] = std::minmax(a.size_px, b.size_px);
  return least > 0 && most < kTwinRatio * least && a.is_dark == b.is_dark &&
         std::hypot(a.x - b.x, a.y - b.y) < kTwinScales * scaleOfSize(least);
}

/// Of points that two successive octaves found, keeps the one with the stronger response. A size of 0 marks
/// the other.
void dropTwins(std::vector<InterestPoint>& fine, std::vector<InterestPoint>& coarse) {
  const auto is_above = [](const InterestPoint* a, const InterestPoint* b) { return a->y < b->y; };
  std::vector<InterestPoint*> sorted;
  for (InterestPoint& point : fine) sorted.push_back(&point);
  std::sort(sorted.begin(), sorted.end(), is_above);
  const auto drop = [](InterestPoint& point) { point.size_px = 0; };
  for (InterestPoint& point : coarse) {
    const float reach = kTwinScales * scaleOfSize(point.size_px);
    const InterestPoint top{point.x, point.y - reach, 0, 0, 0, false};
    for (auto it = std::lower_bound(sorted.begin(), sorted.end(), &top, is_above);
         it != sorted.end() && (*it)->y <= point.y + reach; ++it)
      if (areTwins(**it, point)) drop((*it)->response >= point.response ? point : **it);
  }
  const auto is_dropped = [](const InterestPoint& point) { return point.size_px == 0; };
  std::erase_if(fine, is_dropped);
  std::erase_if(coarse, is_dropped);
}

}  // namespace

std::vector<InterestPoint> findInterestPoints(const IntegralImage& image, const SurfOptions& options) {
  struct Task {
    int octave, begin, end, count;
    std::vector<InterestPoint> found{};
  };
  std::vector<Task> tasks;
  for (int octave = 0; octave < options.octaves; ++octave) {
    const int count = (image.height() - 1) / (1 << octave) + 1;
    for (int begin = 0; begin < count; begin += kStripRows)
      tasks.push_back({octave, begin, std::min(begin + kStripRows, count), count});
  }
  const int threads = options.threads > 0 ? options.threads : availableThreads();
  parallelFor(threads, static_cast<int>(tasks.size()), [&](int i) {
    Task& task = tasks[i];
    Strip(image, options, task.octave).find(task.begin, task.end, task.count, task.found);
  });
  std::vector<std::vector<InterestPoint>> by_octave(static_cast<std::size_t>(options.octaves));
  for (const Task& task : tasks) {
    auto& points = by_octave[static_cast<std::size_t>(task.octave)];
    points.insert(points.end(), task.found.begin(), task.found.end());
  }
  for (std::size_t octave = 1; octave < by_octave.size(); ++octave)
    dropTwins(by_octave[octave - 1], by_octave[octave]);
  std::vector<InterestPoint> all;
  for (const auto& points : by_octave) all.insert(all.end(), points.begin(), points.end());
  return all;
}

}  // namespace pomona
