// What `pomona range` writes.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "pomona/plugin_settings.h"
#include "pomona/sparse_result.h"

namespace pomona {

/// One line per point, after one that names the columns: object (empty: none), left and right pixel,
/// disparity and sigma in pixels, point and sigma_z in metres. What is unknown is empty. Labels are quoted as
/// RFC 4180 says.
std::string encodeCsv(const SparseResult& result);

/// The points that have a place, in the colours of the left view (CV_8U, 1 or 3 channels): see
/// camera/cloud_file.h.
std::string encodePly(const SparseResult& result, const cv::Mat& left);

/// Everything but the pictures, and what it was made with; null for what is unknown.
std::string encodeJson(const SparseResult& result, const std::string& plugin, const PluginSettings& settings);

}  // namespace pomona
