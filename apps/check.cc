#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "apps/muted_stream.h"
#include "apps/verbs.h"
#include "camera/row_check.h"
#include "core/cpu.h"
#include "core/parallel.h"
#include "datasets/scene_parts.h"
#include "engine/input.h"
#include "pomona/disparity.h"

namespace pomona {
namespace {

struct CheckArguments {
  std::string left, right;
  int min_disparity = 0;
  std::optional<int> max_disparity;
};

cv::Mat horizontalGradient(ImageView<const std::uint8_t> view) {
  const cv::Mat gray(view.height, view.width, CV_8UC1, const_cast<std::uint8_t*>(view.data),
                     static_cast<std::size_t>(view.stride));
  cv::Mat gradient;
  cv::Sobel(gray, gradient, CV_32F, 1, 0);
  return gradient;
}

// Whether both views show everything in the same place: by how their gradients correlate. With noise of 10
// units, two pictures by one camera still have 0.94; real pairs, in which things move by more than a pixel,
// have 0.08 at most (24 of Middlebury's).
bool showTheSame(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right) {
  constexpr double kSame = 0.8;
  const cv::Mat a = horizontalGradient(left), b = horizontalGradient(right);
  return a.dot(b) > kSame * std::sqrt(a.dot(a) * b.dot(b));
}

void check(const CheckArguments& arguments) {
  if (arguments.max_disparity && *arguments.max_disparity <= arguments.min_disparity)
    throw std::invalid_argument("--max-disparity is " + std::to_string(*arguments.max_disparity) +
                                "; allowed: above --min-disparity, " +
                                std::to_string(arguments.min_disparity));
  const MutedErrorStream muted;
  const auto [left_view, right_view] = readViews(arguments.left, arguments.right);
  InputPair pair;  // gray, 8 bits, as matching sees it
  pair.set(left_view, right_view, availableThreads());
  const ImageView<const std::uint8_t> left = pair.views().left, right = pair.views().right;
  if (showTheSame(left, right)) {
    std::cout
        << "verdict   the views are too alike: nothing moves between them, as in one picture, or of one "
           "camera, taken twice\n";
    throw CLI::RuntimeError(kNegativeVerdict);
  }
  constexpr int kUsualShare = 4;  // of the width
  constexpr int kReach_px = 40;   // there is time
  const int end =
      arguments.max_disparity.value_or(arguments.min_disparity + std::max(16, left.width / kUsualShare));
  RowCheck row_check;
  const auto measure = [&](auto first, auto second) {
    return row_check.measure(first, second, arguments.min_disparity, end - arguments.min_disparity,
                             cameraKernels(chooseIsa({})), availableThreads(), kReach_px);
  };
  const RowOffsets rows = measure(left, right), exchanged = measure(right, left);
  std::cout << "points    " << rows.points << " matched\n";
  if (seemExchanged(rows, exchanged)) {
    std::cout << "verdict   the views seem to be exchanged: with the second one as the left one, "
              << exchanged.points << " points match\n";
    throw CLI::RuntimeError(kNegativeVerdict);
  }
  if (std::isnan(rows.median_px)) {
    std::cout << "rows      unknown: fewer than 10 points have a match within " << kReach_px
              << " px of their row\n";
    throw CLI::RuntimeError(kNegativeVerdict);
  }
  std::array<char, 128> text;
  std::snprintf(text.data(), text.size(),
                "rows      right view %+.2f px (+ is lower), %.2f px where it is worst", rows.median_px,
                rows.worst_px);
  std::cout << text.data() << '\n';
  StereoResult judged;
  judged.row_offset_px = rows.median_px;
  judged.row_error_px = rows.worst_px;
  if (judged.rowsAreOff()) {
    std::cout << "verdict   the views are not aligned: calibrate, or rectify them (--rig)\n";
    throw CLI::RuntimeError(kNegativeVerdict);
  }
  std::cout << "verdict   aligned\n";
}

}  // namespace

void addCheck(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("check",
                         "Measure whether the rows of a rectified pair match: exit status 3 if not, if the "
                         "views seem to be exchanged or the same, or if that cannot be told");
  const auto arguments = std::make_shared<CheckArguments>();  // lives as long as the callback
  verb->add_option("left", arguments->left, "Left image")->required();
  verb->add_option("right", arguments->right, "Right image")->required();
  verb->add_option("--min-disparity", arguments->min_disparity, "Smallest disparity expected (default 0)")
      ->check(CLI::Range(-16000, 16000));
  verb->add_option("--max-disparity", arguments->max_disparity,
                   "Largest one (default: a quarter of the width more)")
      ->check(CLI::Range(-16000, 16000));
  verb->callback([arguments] { check(*arguments); });
}

}  // namespace pomona
