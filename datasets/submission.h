// Results laid out as the benchmarks want them uploaded.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "datasets/atomic_file.h"
#include "datasets/scene.h"
#include "pomona/options.h"

namespace pomona {

/// The files that say what `method` found on a scene, with paths relative to the folder that is zipped:
/// - Middlebury, and manifests: SPLIT/SCENE/disp0METHOD.pfm (disp0METHOD_s.pfm for a sparse map) and
///   SPLIT/SCENE/timeMETHOD.txt, which holds the seconds; without SPLIT unless it is one of the benchmark's
///   (training or test, followed by F, H or Q);
/// - KITTI 2015: disp_0/NNNNNN_10.png; KITTI 2012: NNNNNN_10.png;
/// - ETH3D: low_res_two_view/SCENE.pfm and .txt, which holds "runtime SECONDS".
/// A scene name with folders in it, "2015/training/000010_10", puts them in front (of SPLIT: instead).
/// `disparity` is CV_32F with NaN for unknown. Throws std::invalid_argument for a disparity that the format
/// cannot hold.
std::vector<OutputFile> submissionFiles(const SceneFiles& scene, const std::string& method, OutputMode mode,
                                        const cv::Mat& disparity, double seconds);

}  // namespace pomona
