// dlib's SURF, an independent implementation to compare with.
#pragma once

#include "bench/surf/pair_score.h"

namespace pomona {

/// The `most` strongest features of a CV_8UC1 image, in order of strength; dlib's threshold, octaves (4) and
/// layers (6).
Features dlibSurf(const cv::Mat& gray, int most);

}  // namespace pomona
