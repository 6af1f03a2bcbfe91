// Every ray of a picture starts in one place: a camera, or the sun for shadows. A grid over the directions
// from there, whose cells list what they may show from near to far, is all the acceleration that takes.
#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "datasets/rendering/solid.h"

namespace pomona {

struct Hit {
  const Solid* solid = nullptr;
  double depth = kNowhere;  ///< t of origin + t * direction
};

class RayGrid {
 public:
  /// What lies beyond a grid's range: no ray goes there, or the cells along the edge show it.
  enum class Beyond { kNothing, kEdgeCells };

  /// `axes`: from the world's to the grid's frame, in which rays go along +Z. `range`: of x / z and y / z of
  /// their directions. `solids` must outlive the grid.
  RayGrid(std::span<const Solid> solids, const cv::Vec3d& origin, const cv::Matx33d& axes,
          const cv::Rect2d& range, cv::Size cells, Beyond beyond);

  /// The nearest surface; of equally near ones the first of the scene.
  Hit firstHit(const cv::Vec3d& direction) const;
  /// Whether the ray meets a surface other than a plane before `depth`.
  bool isBlocked(const cv::Vec3d& direction, double depth) const;
  const cv::Vec3d& origin() const { return origin_; }

 private:
  struct Candidate {
    const Solid* solid;
    double nearest;  ///< z in the grid's frame, at most that of any of its points
  };

  void add(const Solid& solid, Beyond beyond);
  int columnOf(double x) const;
  int rowOf(double y) const;
  const std::vector<Candidate>& candidates(const cv::Vec3d& local_direction) const;

  cv::Vec3d origin_;
  cv::Matx33d axes_;
  cv::Rect2d range_;
  cv::Size cells_;
  std::vector<std::vector<Candidate>> lists_;
};

/// The range that nine tenths of `solids`, planes left out, take up seen from `origin`.
cv::Rect2d busyRange(std::span<const Solid> solids, const cv::Vec3d& origin, const cv::Matx33d& axes);

}  // namespace pomona
