#include "apps/figure_columns.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace pomona {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
using M = Measurement;
using R = RegionFigures;

// The figure `get` of the region, or of nothing.
template <auto get>
double of(const M&, const R* r) {
  return r ? get(*r) : kNone;
}
template <std::size_t threshold>
double bad(const R& r) {
  return r.errors.badPercent(threshold);
}
template <std::size_t threshold>
double wrong(const R& r) {
  return r.errors.wrongPercent(threshold);
}
template <std::size_t index>
double quantile(const R& r) {
  return r.errors.quantile_px[index];
}
double curveArea(const R& r) {
  return r.curve.points.empty() ? kNone : r.curve.area_percent;
}
double curveExcess(const R& r) {
  return r.curve.points.empty() ? kNone : r.curve.excessAreaPercent();
}
template <auto part>
double d1(const R& r) {
  return r.kitti ? std::invoke(part, *r.kitti).d1Percent() : kNone;
}

constexpr std::array<FigureColumn, 26> kColumns = {{
    {"bad-0.5", "error above 0.5 px, or no disparity; percent", 2, true, of<bad<0>>},
    {"bad-1", "error above 1 px, or no disparity; percent", 2, true, of<bad<1>>},
    {"bad-2", "error above 2 px, or no disparity; percent", 2, true, of<bad<2>>},
    {"bad-4", "error above 4 px, or no disparity; percent", 2, true, of<bad<3>>},
    {"avg", "mean error of pixels with a disparity, px", 3, true,
     of<[](const R& r) { return r.errors.averageErrorPx(); }>},
    {"rms", "root mean square error of pixels with a disparity, px", 3, true,
     of<[](const R& r) { return r.errors.rmsErrorPx(); }>},
    {"coverage", "pixels with a disparity, percent", 2, true,
     of<[](const R& r) { return r.errors.coveragePercent(); }>},
    {"wrong-1", "error above 1 px, percent of pixels with a disparity", 2, true, of<wrong<1>>},
    {"ms", "wall-clock time, milliseconds", 1, true, [](const M& m, const R*) { return m.milliseconds; }},
    {"s/MP", "seconds per million pixels", 3, true,
     [](const M& m, const R*) { return secondsPerMegapixel(m.milliseconds / 1000, m.size); }},
    {"invalid", "no disparity, percent", 2, false, of<[](const R& r) { return r.errors.invalidPercent(); }>},
    {"wrong-0.5", "error above 0.5 px, percent of pixels with a disparity", 2, false, of<wrong<0>>},
    {"wrong-2", "error above 2 px, percent of pixels with a disparity", 2, false, of<wrong<2>>},
    {"wrong-4", "error above 4 px, percent of pixels with a disparity", 2, false, of<wrong<3>>},
    {"A50", "median error, px", 3, false, of<quantile<0>>},
    {"A90", "90 % quantile of the error, px", 3, false, of<quantile<1>>},
    {"A95", "95 % quantile of the error, px", 3, false, of<quantile<2>>},
    {"A99", "99 % quantile of the error, px", 3, false, of<quantile<3>>},
    {"curve", "area below the coverage curve (wrong-1, least confident dropped first), percent", 3, false,
     of<curveArea>},
    {"curve-excess", "what of that area a perfect confidence would save, percent", 3, false, of<curveExcess>},
    {"bias", "mean signed error of inliers (error up to 1 px), px", 4, false,
     of<[](const R& r) { return r.subpixel.all.biasPx(); }>},
    {"inlier-rms", "root mean square error of inliers, px", 4, false,
     of<[](const R& r) { return r.subpixel.all.rmsPx(); }>},
    {"D1-bg", "KITTI outliers of the filled map on the background, percent", 2, false,
     of<d1<&KittiErrors::background>>},
    {"D1-fg", "KITTI outliers of the filled map on vehicles, percent", 2, false,
     of<d1<&KittiErrors::foreground>>},
    {"D1-all", "KITTI outliers of the filled map, percent", 2, false, of<d1<&KittiErrors::all>>},
    {"s/GD", "seconds per 10^9 pixels times disparities", 3, false,
     [](const M& m, const R*) {
       return secondsPerGigadisparity(m.milliseconds / 1000, m.size, m.num_disparities);
     }},
}};

}  // namespace

const char* name(Region region) {
  return region == Region::kAll ? "all" : "nocc";
}

std::span<const FigureColumn> figureColumns() {
  return kColumns;
}

std::vector<double> figuresOf(const Measurement& measurement, Region region) {
  const auto& figures = region == Region::kAll ? measurement.all : measurement.nonoccluded;
  std::vector<double> values;
  for (const FigureColumn& column : kColumns)
    values.push_back(column.value(measurement, figures ? &*figures : nullptr));
  return values;
}

std::vector<double> meanOf(const std::vector<std::vector<double>>& rows, std::span<const double> weights) {
  std::vector<double> means, column(rows.size());
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    for (std::size_t r = 0; r < rows.size(); ++r) column[r] = rows[r][c];
    means.push_back(weightedMean(column, weights));
  }
  return means;
}

std::string shown(double value, int decimals) {
  if (std::isnan(value)) return "-";
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

}  // namespace pomona
