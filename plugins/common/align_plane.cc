#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "plugins/common/disparity_plane.h"

namespace pomona {
namespace {

// Of disparity, its slopes, and the right view's brightness: factor and offset. Coordinates are divided by
// half the outline's size, so that all unknowns matter alike.
constexpr int kUnknowns = 5;
using Row = cv::Vec<double, kUnknowns>;
using Square = cv::Matx<double, kUnknowns, kUnknowns>;

struct NormalEquations {
  Square matrix = Square::zeros();
  Row right_side = Row::all(0);
  double weights = 0, squares = 0;
  std::vector<Row> strips;  // what each upright strip of the outline has in right_side
};

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Alignment {
 public:
  Alignment(const cv::Mat& left, const cv::Mat& right, const std::vector<cv::Point2f>& outline,
            const DisparityPlane& start)
      : plane_(start) {
    constexpr int kMargin_px = 8;  // for the blur
    const cv::Rect whole(0, 0, left.cols, left.rows), box = cv::boundingRect(outline) & whole;
    const cv::Rect band = cv::Rect(0, box.y - kMargin_px, left.cols, box.height + 2 * kMargin_px) & whole;
    if (box.empty()) return;
    mask_ = cv::Mat::zeros(left.size(), CV_8U);
    std::vector<cv::Point> corners;
    for (const cv::Point2f& corner : outline) corners.emplace_back(cvRound(corner.x), cvRound(corner.y));
    cv::fillConvexPoly(mask_, corners, 255);
    mask_ = mask_(box);
    top_ = band.y;
    box_ = box - cv::Point(0, top_);
    plane_.origin_px.y -= top_;
    half_ = std::max(1.0, 0.5 * std::max(box.width, box.height));
    constexpr int kStrips = 16, kNarrowest_px = 6;
    strip_px_ = std::max(kNarrowest_px, (box.width + kStrips - 1) / kStrips);
    left(band).convertTo(left_, CV_32F);
    right(band).convertTo(right_, CV_32F);
  }

  bool isEmpty() const { return mask_.empty() || cv::countNonZero(mask_) < kLeastPixels; }

  /// At views blurred by `sigma_px`. False if there is nothing to hold on to.
  bool run(double sigma_px, int iterations) {
    constexpr double kStill_px = 1e-3;
    blur(sigma_px);
    for (int i = 0; i < iterations; ++i) {
      const NormalEquations equations = linearized();
      Square inverse;
      if (equations.weights < kLeastPixels || !invert(equations.matrix, inverse)) return false;
      const Row step = inverse * equations.right_side;
      apply(step);
      plane_.sigma_px = std::sqrt(varianceOf(equations, inverse));
      if (std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) < kStill_px) break;
    }
    return true;
  }

  DisparityPlane plane() const {
    DisparityPlane plane = plane_;
    plane.origin_px.y += top_;
    return plane;
  }
  /// How much of the left view's variance inside the outline the right one explains: at most 1.
  double explained() {
    const NormalEquations equations = linearized();
    cv::Scalar mean, deviation;
    cv::meanStdDev(blurred_left_, mean, deviation, mask_);
    return 1 - equations.squares / equations.weights / std::max(1e-9, deviation[0] * deviation[0]);
  }

 private:
  static constexpr int kLeastPixels = 40;

  void blur(double sigma_px) {
    cv::Mat blurred;
    cv::GaussianBlur(left_, blurred, {}, sigma_px);
    blurred_left_ = blurred(box_);
    cv::GaussianBlur(right_, blurred_right_, {}, sigma_px);
    const cv::Mat central = (cv::Mat_<float>(1, 3) << -0.5f, 0, 0.5f);
    cv::filter2D(blurred_right_, right_gradient_, CV_32F, central);
  }

  static bool invert(const Square& matrix, Square& inverse) {
    bool invertible = false;
    inverse = matrix.inv(cv::DECOMP_CHOLESKY, &invertible);
    return invertible;
  }

  // Of the disparity. Neighbouring pixels err together: the number of independent ones is at most that of
  // blurred 3 x 3 blocks. Those of an upright edge do along all of it, and so does what is not flat: by how
  // much the strips disagree has that in it, too (White 1980; Liang & Zeger 1986). What interpolation leaves,
  // however large the outline, adds to that.
  static double varianceOf(const NormalEquations& equations, const Square& inverse) {
    constexpr double kPixelsPerSample = 9, kModel_px = 0.015;
    const double noise = kPixelsPerSample * equations.squares / equations.weights * inverse(0, 0);
    const auto strips = static_cast<double>(equations.strips.size());
    double disagreement = 0;
    for (const Row& strip : equations.strips) {
      const double moves_px = (inverse * strip)[0];
      disagreement += moves_px * moves_px;
    }
    disagreement *= strips / std::max(1.0, strips - kUnknowns);
    return kModel_px * kModel_px + std::max(noise, disagreement);
  }

  // What the right view shows where the plane sends the pixels of the box, and how that changes along the
  // row.
  void look(cv::Mat& seen, cv::Mat& gradient) const {
    cv::Mat x(box_.size(), CV_32F), y(box_.size(), CV_32F);
    for (int i = 0; i < box_.height; ++i)
      for (int k = 0; k < box_.width; ++k) {
        const cv::Point2d place(box_.x + k, box_.y + i);
        x.at<float>(i, k) = static_cast<float>(place.x - plane_.at(place));
        y.at<float>(i, k) = static_cast<float>(place.y);
      }
    cv::remap(blurred_right_, seen, x, y, cv::INTER_CUBIC, cv::BORDER_CONSTANT, cv::Scalar::all(NAN));
    cv::remap(right_gradient_, gradient, x, y, cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar::all(NAN));
  }

  NormalEquations linearized() const {
    cv::Mat seen, gradient;
    look(seen, gradient);
    std::vector<Row> rows;
    std::vector<int> strips;
    std::vector<double> off, distances;
    for (int i = 0; i < box_.height; ++i)
      for (int k = 0; k < box_.width; ++k) {
        const double value = seen.at<float>(i, k), change = gradient.at<float>(i, k);
        if (!mask_.at<std::uint8_t>(i, k) || !std::isfinite(value) || !std::isfinite(change)) continue;
        const double by_disparity = -factor_ * change;  // a larger disparity looks farther to the left
        const double x = (box_.x + k - plane_.origin_px.x) / half_,
                     y = (box_.y + i - plane_.origin_px.y) / half_;
        strips.push_back(k / strip_px_);
        rows.push_back({by_disparity, by_disparity * x, by_disparity * y, value, 1});
        off.push_back(blurred_left_.at<float>(i, k) - factor_ * value - offset_);
        distances.push_back(std::abs(off.back()));
      }
    NormalEquations equations;
    if (rows.empty()) return equations;
    equations.strips.assign((box_.width - 1) / strip_px_ + 1, Row::all(0));
    const double limit = std::max(0.5, 1.345 * 1.4826 * medianOf(distances));  // gray values
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const double weight = distances[n] <= limit ? 1 : limit / distances[n];
      equations.matrix += weight * (rows[n] * rows[n].t());
      const Row pulls = rows[n] * (weight * off[n]);
      equations.right_side += pulls;
      equations.strips[strips[n]] += pulls;
      equations.weights += weight;
      equations.squares += weight * off[n] * off[n];
    }
    return equations;
  }

  void apply(const Row& step) {
    plane_.disparity_px += step[0];
    plane_.slope_x += step[1] / half_;
    plane_.slope_y += step[2] / half_;
    factor_ += step[3];
    offset_ += step[4];
  }

  DisparityPlane plane_;
  double factor_ = 1, offset_ = 0;
  int top_ = 0;  // the row of the views that this object's pictures, box and plane begin with
  cv::Rect box_;
  double half_ = 1;
  int strip_px_ = 1;
  cv::Mat mask_, left_, right_, blurred_left_, blurred_right_, right_gradient_;
};

}  // namespace

std::optional<DisparityPlane> alignDisparityPlane(const cv::Mat& left, const cv::Mat& right,
                                                  const std::vector<cv::Point2f>& outline_px,
                                                  const DisparityPlane& start) {
  constexpr double kCoarse_px = 2, kFine_px = 0.8;
  constexpr int kIterations = 15;
  constexpr double kFarthest_px = 3, kLeastExplained = 0.5;
  Alignment alignment(left, right, outline_px, start);
  if (alignment.isEmpty() || !alignment.run(kCoarse_px, kIterations) || !alignment.run(kFine_px, kIterations))
    return std::nullopt;
  const DisparityPlane plane = alignment.plane();
  if (!(std::abs(plane.disparity_px - start.disparity_px) <= kFarthest_px)) return std::nullopt;
  if (!(alignment.explained() >= kLeastExplained)) return std::nullopt;
  return plane;
}

}  // namespace pomona
