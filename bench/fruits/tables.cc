#include "bench/fruits/tables.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "bench/accuracy/table.h"

namespace pomona {
namespace {

constexpr std::size_t kBandCount = std::size(kBands);

std::string fixed(double value, int decimals) {
  if (std::isnan(value)) return "-";
  std::ostringstream out;
  out << std::fixed << std::setprecision(decimals) << value;
  return out.str();
}

std::string nameOf(const Band& band) {
  std::ostringstream out;
  out << band.nearest_m << " - " << band.farthest_m << " m";
  return out.str();
}

void addErrors(std::ostream& out, std::vector<std::string> cells, const DistanceErrors& e) {
  if (e.all == 0) return;
  for (const std::string& cell : {std::to_string(e.all), std::to_string(e.measured), fixed(e.mean_mm, 2),
                                  fixed(e.rms_mm, 2), fixed(e.mean_percent, 3), fixed(e.median_percent, 3),
                                  fixed(e.p95_percent, 3), fixed(e.within_2_sigma_percent, 0)})
    cells.push_back(cell);
  addRow(out, cells);
}

void addErrorHeader(std::ostream& out, std::vector<std::string> cells) {
  for (const char* cell :
       {"fruits", "measured", "mean mm", "rms mm", "mean %", "median %", "P95 %", "within 2 sigma, %"})
    cells.emplace_back(cell);
  addHeader(out, cells);
}

void addMethods(std::ostream& out, std::span<const FruitMethod> methods, Way way) {
  addErrorHeader(out, {"fruits' depth", "method"});
  for (std::size_t band = 0; band < kBandCount; ++band)
    for (const FruitMethod& method : methods)
      addErrors(out, {nameOf(kBands[band]), method.name}, method.errors(band, way));
}

}  // namespace

std::string fruitTables(std::span<const FruitMethod> methods) {
  std::ostringstream out;
  out << "## Spheres\n\n`measureObject()` with a mask of what is visible; the near side.\n\n";
  addMethods(out, methods, kMask);
  out << "\n## Medians\n\nNo sphere: the median distance of the visible pixels, against the median of their "
         "true "
         "ones.\n\n";
  addMethods(out, methods, kMedian);
  out << "\n## Other regions, and the centre\n\n";
  addErrorHeader(out, {"method", "region", "fruits' depth"});
  for (const FruitMethod& method : methods)
    for (const Way way : {kVisible, kBox, kCenter})
      for (std::size_t band = 0; knowsSigma(method.name) && band < kBandCount; ++band)
        addErrors(out, {method.name, kWayNames[way], nameOf(kBands[band])}, method.errors(band, way));
  return out.str();
}

}  // namespace pomona
