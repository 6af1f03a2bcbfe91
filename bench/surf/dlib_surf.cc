#include "bench/surf/dlib_surf.h"

// The header that brings dlib's configuration in: its matrices are then told to do without BLAS, for which
// only a runtime library may be installed.
// clang-format off
#include <dlib/test_for_odr_violations.h>
#undef DLIB_USE_BLAS
#undef DLIB_USE_LAPACK
// clang-format on
#include <dlib/array2d.h>
#include <dlib/image_keypoint.h>

#include <algorithm>

namespace pomona {

Features dlibSurf(const cv::Mat& gray, int most) {
  dlib::array2d<unsigned char> image(gray.rows, gray.cols);
  for (int y = 0; y < gray.rows; ++y) std::copy_n(gray.ptr(y), gray.cols, &image[y][0]);
  Features features;
  for (const dlib::surf_point& point : dlib::get_surf_points(image, most)) {
    features.places.emplace_back(static_cast<float>(point.p.center.x()),
                                 static_cast<float>(point.p.center.y()));
    features.sigma_px.push_back(static_cast<float>(point.p.scale));
    cv::Mat row(1, 64, CV_32F);
    for (int i = 0; i < 64; ++i) row.at<float>(i) = static_cast<float>(point.des(i));
    features.descriptors.push_back(row);
  }
  return features;
}

}  // namespace pomona
