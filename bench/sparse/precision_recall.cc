#include "bench/sparse/precision_recall.h"

#include <algorithm>
#include <cstdio>
#include <opencv2/imgproc.hpp>

namespace pomona {
namespace {

constexpr int kWidth = 860, kHeight = 560, kLeft = 80, kRight = 30, kTop = 24, kBottom = 60;

cv::Point place(double false_share, double recall, double most_recall) {
  return {kLeft + cvRound(false_share * (kWidth - kLeft - kRight)),
          kHeight - kBottom - cvRound(recall / most_recall * (kHeight - kTop - kBottom))};
}

void write(cv::Mat& picture, const std::string& text, cv::Point at, double scale = 0.5) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, scale, cv::Scalar::all(40), 1, cv::LINE_AA);
}

std::string decimals(double value) {
  char text[16];
  std::snprintf(text, sizeof(text), "%.1f", value);
  return text;
}

void drawAxes(cv::Mat& picture, double most_recall) {
  const cv::Scalar pale = cv::Scalar::all(215);
  for (int i = 0; i <= 10; ++i) {
    const double share = i / 10.0;
    cv::line(picture, place(share, 0, most_recall), place(share, most_recall, most_recall), pale);
    write(picture, decimals(share), place(share, 0, most_recall) + cv::Point(-12, 20), 0.45);
  }
  for (int i = 0; i / 10.0 <= most_recall + 1e-9; ++i) {
    cv::line(picture, place(0, i / 10.0, most_recall), place(1, i / 10.0, most_recall), pale);
    write(picture, decimals(i / 10.0), place(0, i / 10.0, most_recall) + cv::Point(-36, 5), 0.45);
  }
  write(picture, "1 - precision", {kWidth / 2 - 40, kHeight - 14});
  write(picture, "recall", {8, kTop + 6});
}

}  // namespace

std::vector<PrecisionRecall> curveOf(const JudgedMatches& judged) {
  std::vector<JudgedMatches::Match> sorted = judged.matches;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.ratio < b.ratio; });
  std::vector<PrecisionRecall> curve;
  constexpr int kSteps = 200;
  std::size_t taken = 0, correct = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const float limit = static_cast<float>(i) / kSteps;
    for (; taken < sorted.size() && sorted[taken].ratio <= limit; ++taken) correct += sorted[taken].correct;
    if (taken == 0) continue;
    curve.push_back({1 - static_cast<double>(correct) / static_cast<double>(taken),
                     static_cast<double>(correct) / std::max(1, judged.possible)});
  }
  return curve;
}

double recallAt(const std::vector<PrecisionRecall>& curve, double false_share) {
  double best = 0;
  for (const PrecisionRecall& point : curve)
    if (point.false_share <= false_share) best = std::max(best, point.recall);
  return best;
}

cv::Mat drawCurves(const std::vector<JudgedMatches>& all) {
  double most_recall = 0.1;
  for (const JudgedMatches& judged : all)
    for (const PrecisionRecall& point : curveOf(judged))
      most_recall = std::max(most_recall, point.recall + 0.05);
  const cv::Scalar colors[] = {{60, 60, 200}, {40, 150, 230}, {60, 150, 40}, {190, 90, 30}, {150, 60, 150}};
  cv::Mat picture(kHeight, kWidth, CV_8UC3, cv::Scalar::all(255));
  drawAxes(picture, most_recall);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const cv::Scalar& color = colors[i % std::size(colors)];
    std::vector<cv::Point> line;
    for (const PrecisionRecall& point : curveOf(all[i]))
      line.push_back(place(point.false_share, point.recall, most_recall));
    cv::polylines(picture, line, false, color, 2, cv::LINE_AA);
    const cv::Point legend(kWidth - 370, kHeight - kBottom - 24 - 22 * static_cast<int>(all.size() - 1 - i));
    cv::line(picture, legend, legend + cv::Point(30, 0), color, 3);
    std::string name = all[i].name;
    std::erase(name, '`');  // Markdown's
    write(picture, name, legend + cv::Point(40, 5));
  }
  return picture;
}

}  // namespace pomona
