#include "camera/deviations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/calib3d.hpp>

namespace pomona {
namespace {

// The parameters of the fit in a row: left camera, right camera, rotation vector and T of the rig; then the
// pose of the view that is looked at.
class Parameters {
 public:
  Parameters(const StereoRig& rig, int coefficients) : rig_(rig), coefficients_(coefficients) {
    for (const CameraModel* c : {&rig.left, &rig.right}) {
      values_.insert(values_.end(), {c->fx_px, c->fy_px, c->cx_px, c->cy_px});
      values_.insert(values_.end(), c->distortion.begin(), c->distortion.begin() + coefficients);
    }
    cv::Vec3d rotation;
    cv::Rodrigues(rig.right_from_left_rotation, rotation);
    values_.insert(values_.end(), rotation.val, rotation.val + 3);
    values_.insert(values_.end(), rig.right_from_left_m.val, rig.right_from_left_m.val + 3);
    shared_ = static_cast<int>(values_.size());
    values_.resize(values_.size() + kPose);
  }

  static constexpr int kPose = 6;
  int shared() const { return shared_; }
  int count() const { return shared_ + kPose; }
  double& operator[](int i) { return values_[static_cast<std::size_t>(i)]; }

  void setPose(const Sighting& s) {
    std::copy_n(s.rotation.val, 3, &values_[static_cast<std::size_t>(shared_)]);
    std::copy_n(s.translation_m.val, 3, &values_[static_cast<std::size_t>(shared_) + 3]);
  }

  // Where the corners should appear: x, y in the left image, then x, y in the right one, for each.
  void project(const std::vector<cv::Vec3d>& corners, std::vector<double>& out) {
    const double* p = values_.data();
    for (CameraModel* c : {&rig_.left, &rig_.right}) {
      c->fx_px = *p++, c->fy_px = *p++, c->cx_px = *p++, c->cy_px = *p++;
      for (int i = 0; i < coefficients_; ++i) c->distortion[static_cast<std::size_t>(i)] = *p++;
    }
    cv::Matx33d right_from_left, left_from_board;
    cv::Rodrigues(cv::Vec3d(p), right_from_left);
    const cv::Vec3d t(p + 3);
    cv::Rodrigues(cv::Vec3d(p + 6), left_from_board);
    const cv::Vec3d board_t(p + 9);
    out.clear();
    for (const cv::Vec3d& corner : corners) {
      const cv::Vec3d left = left_from_board * corner + board_t, right = right_from_left * left + t;
      const cv::Vec2d l = rig_.left.pixelOf({left[0] / left[2], left[1] / left[2]});
      const cv::Vec2d r = rig_.right.pixelOf({right[0] / right[2], right[1] / right[2]});
      out.insert(out.end(), {l[0], l[1], r[0], r[1]});
    }
  }

 private:
  StereoRig rig_;
  int coefficients_, shared_;
  std::vector<double> values_;
};

// The derivatives of project() by the parameters from `begin` on, by central differences: one column each.
cv::Mat1d jacobian(Parameters& parameters, const std::vector<cv::Vec3d>& corners, int begin) {
  cv::Mat1d j(static_cast<int>(corners.size()) * 4, parameters.count() - begin);
  std::vector<double> above, below;
  for (int i = begin; i < parameters.count(); ++i) {
    const double value = parameters[i], step = 1e-6 * std::max(1.0, std::abs(value));
    parameters[i] = value + step;
    parameters.project(corners, above);
    parameters[i] = value - step;
    parameters.project(corners, below);
    parameters[i] = value;
    for (int row = 0; row < j.rows; ++row)
      j(row, i - begin) =
          (above[static_cast<std::size_t>(row)] - below[static_cast<std::size_t>(row)]) / (2 * step);
  }
  return j;
}

cv::Mat1d residuals(Parameters& parameters, const BoardView& view, const std::vector<cv::Vec3d>& corners) {
  std::vector<double> projected;
  parameters.project(corners, projected);
  cv::Mat1d r(static_cast<int>(projected.size()), 1);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double seen[] = {view.left[i].x, view.left[i].y, view.right[i].x, view.right[i].y};
    for (std::size_t k = 0; k < 4; ++k) r(static_cast<int>(4 * i + k)) = seen[k] - projected[4 * i + k];
  }
  return r;
}

// The inverse of a symmetric matrix of parameters whose sizes differ by orders of magnitude.
cv::Mat1d inverse(const cv::Mat1d& m) {
  cv::Mat1d scale(m.rows, 1), scaled = m.clone(), inverted;
  for (int i = 0; i < m.rows; ++i) scale(i) = m(i, i) > 0 ? 1 / std::sqrt(m(i, i)) : 1;
  for (int i = 0; i < m.rows; ++i)
    for (int k = 0; k < m.cols; ++k) scaled(i, k) *= scale(i) * scale(k);
  cv::invert(scaled, inverted, cv::DECOMP_SVD);
  for (int i = 0; i < m.rows; ++i)
    for (int k = 0; k < m.cols; ++k) inverted(i, k) *= scale(i) * scale(k);
  return inverted;
}

}  // namespace

std::vector<cv::Vec3d> boardCorners(const BoardSize& board) {
  std::vector<cv::Vec3d> corners;
  for (int row = 0; row < board.rows; ++row)
    for (int column = 0; column < board.columns; ++column)
      corners.emplace_back(column * board.square_m, row * board.square_m, 0);
  return corners;
}

Sighting locateBoard(const BoardView& view, const StereoRig& rig, const std::vector<cv::Vec3d>& corners) {
  Sighting sighting;
  sighting.view = &view;
  cv::solvePnP(corners, view.left, rig.left.matrix(), cv::Mat(rig.left.distortion), sighting.rotation,
               sighting.translation_m);
  Parameters parameters(rig, 0);
  constexpr int kSteps = 10;
  for (int i = 0; i < kSteps; ++i) {
    parameters.setPose(sighting);
    const cv::Mat1d j = jacobian(parameters, corners, parameters.shared());
    cv::Mat1d step;
    cv::solve(j, residuals(parameters, view, corners), step, cv::DECOMP_QR);
    for (int k = 0; k < 3; ++k) {
      sighting.rotation[k] += step(k);
      sighting.translation_m[k] += step(k + 3);
    }
    if (cv::norm(step) < 1e-12) break;
  }
  parameters.setPose(sighting);
  const cv::Mat1d r = residuals(parameters, view, corners);
  sighting.squared_error_px2 = r.dot(r);
  return sighting;
}

void estimateDeviations(const std::vector<Sighting>& sightings, const std::vector<cv::Vec3d>& corners,
                        int coefficients, CalibrationReport& report) {
  Parameters parameters(report.rig, coefficients);
  const int shared = parameters.shared();
  const int pose = Parameters::kPose, count = shared + pose * static_cast<int>(sightings.size());
  // A view's pose depends on the others only through the shared parameters: eliminate it (Schur complement).
  cv::Mat1d normal = cv::Mat1d::zeros(shared, shared);
  double squared_error = 0;
  for (const Sighting& s : sightings) {
    parameters.setPose(s);
    const cv::Mat1d j = jacobian(parameters, corners, 0);
    const cv::Mat1d js = j.colRange(0, shared), jp = j.colRange(shared, shared + pose);
    const cv::Mat1d cross = js.t() * jp;
    normal += js.t() * js - cross * inverse(jp.t() * jp) * cross.t();
    squared_error += s.squared_error_px2;
  }
  const double freedom = 4.0 * static_cast<double>(corners.size() * sightings.size()) - count;
  const cv::Mat1d covariance = inverse(normal) * (squared_error / std::max(1.0, freedom));

  int i = 0;
  const auto next = [&] {
    const double variance = covariance(i, i);
    ++i;
    return std::sqrt(std::max(0.0, variance));
  };
  for (CameraDeviation* d : {&report.left_deviation, &report.right_deviation}) {
    d->fx_px = next(), d->fy_px = next(), d->cx_px = next(), d->cy_px = next();
    for (int k = 0; k < coefficients; ++k) d->distortion[static_cast<std::size_t>(k)] = next();
  }
  for (double& v : report.rotation_deviation.val) v = next();
  const int t = i;
  for (double& v : report.translation_deviation_m.val) v = next();
  // The baseline is |T|: its gradient is T's direction.
  const cv::Vec3d direction = cv::normalize(report.rig.right_from_left_m);
  cv::Matx33d block;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) block(a, b) = covariance(t + a, t + b);
  report.baseline_deviation_m = std::sqrt(std::max(0.0, direction.dot(block * direction)));
}

}  // namespace pomona
