// pomona_surf_bench FIRST SECOND HOMOGRAPHY.xml: SURF beside cv::SIFT and, if it was there at build time,
// dlib's SURF: how many features there are and their processor time (first image, one thread, best of several
// rounds in which all methods take turns), and how many of the 1000 strongest are found again and matched.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "bench/surf/pair_score.h"
#include "datasets/image_file.h"
#include "plugins/common/surf/surf.h"
#ifdef POMONA_WITH_DLIB
#include "bench/surf/dlib_surf.h"
#endif

namespace pomona {
namespace {

constexpr int kMost = 1000, kRounds = 7;

struct Method {
  std::string name;
  std::function<Features(const cv::Mat& gray, int most)> find;
  double best_ms = std::numeric_limits<double>::infinity();
};

Method surf(const std::string& name, SurfOptions options) {
  options.threads = 1;
  return {name, [=](const cv::Mat& gray, int most) {
            return strongest(*Surf::create(options), gray, most, 1.2f / 9);
          }};
}

std::vector<Method> allMethods() {
  std::vector<Method> methods;
  SurfOptions options;
  methods.push_back(surf("SURF", options));
  options.extended = true;
  methods.push_back(surf("SURF-128", options));
  options.extended = false;
  options.upright = true;
  methods.push_back(surf("U-SURF", options));
  methods.push_back({"cv::SIFT", [](const cv::Mat& gray, int most) {
                       return strongest(*cv::SIFT::create(), gray, most, 0.5f);
                     }});
#ifdef POMONA_WITH_DLIB
  methods.push_back({"dlib SURF", dlibSurf});
#endif
  return methods;
}

cv::Mat readGray(const std::string& path) {
  cv::Mat image = readImage(path);
  if (image.channels() == 3) cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
  return image;
}

void run(const std::string& first_path, const std::string& second_path, const std::string& homography_path) {
  const cv::Mat first = readGray(first_path), second = readGray(second_path);
  const cv::FileStorage file(homography_path, cv::FileStorage::READ);
  cv::Mat homography;
  if (file.isOpened()) file.getFirstTopLevelNode() >> homography;
  if (homography.size() != cv::Size(3, 3) || homography.type() != CV_64F)
    throw std::runtime_error(homography_path + ": a 3x3 matrix of doubles was expected");
  cv::setNumThreads(1);

  std::vector<Method> methods = allMethods();
  for (int round = 0; round < kRounds; ++round)
    for (Method& method : methods) {
      const std::clock_t begin = std::clock();
      method.find(first, std::numeric_limits<int>::max() / 2);
      method.best_ms =
          std::min(method.best_ms, 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
  std::printf(
      "| method | points | ms | points/s | repeatability | matches | correct | precision | matching score |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (Method& method : methods) {
    const std::size_t all = method.find(first, std::numeric_limits<int>::max() / 2).size();
    const PairScore score = scorePair(method.find(first, kMost), method.find(second, kMost),
                                      cv::Matx33d(homography), second.size());
    std::printf("| %s | %zu | %.1f | %.0f | %.1f %% | %d | %d | %.1f %% | %.1f %% |\n", method.name.c_str(),
                all, method.best_ms, 1000 * static_cast<double>(all) / method.best_ms,
                100 * score.repeatability(), score.matches, score.correct, 100 * score.precision(),
                100 * score.matchingScore());
  }
}

}  // namespace
}  // namespace pomona

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: pomona_surf_bench FIRST SECOND HOMOGRAPHY.xml\n");
    return 2;
  }
  try {
    pomona::run(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pomona_surf_bench: %s\n", error.what());
    return 1;
  }
}
