#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "pomona/evaluation.h"

namespace pomona {

double secondsPerMegapixel(double seconds, cv::Size size) {
  return seconds * 1e6 / (static_cast<double>(size.width) * size.height);
}

double secondsPerGigadisparity(double seconds, cv::Size size, int num_disparities) {
  return seconds * 1e9 / (static_cast<double>(size.width) * size.height * num_disparities);
}

double weightedMean(std::span<const double> values, std::span<const double> weights) {
  if (!weights.empty() && weights.size() != values.size())
    throw std::invalid_argument("weights: " + std::to_string(weights.size()) +
                                "; allowed: none, or one for each of the " + std::to_string(values.size()) +
                                " values");
  double sum = 0, weight_sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    const double weight = weights.empty() ? 1 : weights[i];
    sum += weight * values[i];
    weight_sum += weight;
  }
  return weight_sum > 0 ? sum / weight_sum : std::numeric_limits<double>::quiet_NaN();
}

double middleburyWeight(std::string_view scene) {
  scene.remove_prefix(scene.rfind('/') + 1);  // npos + 1 is 0
  constexpr std::array<std::string_view, 5> kDifficult = {"PianoL", "Playroom", "Playtable", "Shelves",
                                                          "Vintage"};
  return std::find(kDifficult.begin(), kDifficult.end(), scene) != kDifficult.end() ? 0.5 : 1.0;
}

}  // namespace pomona
