// Whether a view shows a known object where its features say.
#pragma once

#include <opencv2/core.hpp>

namespace pomona {

/// What a picture is compared by: gray, its longer side at most 96 pixels. CV_8U, 1 channel.
cv::Mat thumbnailOf(const cv::Mat& picture);

/// The zero-mean, normalised correlation (-1 to 1) of the object's thumbnail with `view` (CV_8U, 1 channel),
/// looked at through the map `image_from_picture` at the thumbnail's resolution; both blurred by a pixel of
/// it, so that maps may be off a little. Of what lies inside the view; -1 if that is less than half of it, or
/// if either is even.
double likeness(const cv::Mat& thumbnail, cv::Size picture_size, const cv::Mat& view,
                const cv::Matx33d& image_from_picture);

}  // namespace pomona
