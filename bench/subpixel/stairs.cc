// Do the fractions of found disparities spread as evenly as those of the truth, or in stairs? Matches slanted
// planes and prints a table.
#include <cstdio>
#include <vector>

#include "bench/subpixel/planes.h"
#include "pomona/engine.h"

namespace pomona {
namespace {

constexpr struct {
  SubpixelMethod method;
  const char* name;
} kMethods[] = {{SubpixelMethod::kNone, "none"},
                {SubpixelMethod::kParabola, "parabola"},
                {SubpixelMethod::kEquiangular, "equiangular"},
                {SubpixelMethod::kFitted, "fitted"}};
constexpr struct {
  PlaneMap map;
  const char* name;
} kMaps[] = {{PlaneMap::kRaw, "raw"}, {PlaneMap::kSparse, "sparse"}, {PlaneMap::kDense, "dense"}};

std::vector<RenderedPair> planesOf(const Texture& texture, double noise) {
  std::vector<RenderedPair> planes;
  for (int tilt = 0; tilt < kTilts; ++tilt) {
    RenderedPair pair = slantedPlane(texture, tilt);
    if (noise > 0) {
      addNoise(pair.left.image, noise, 1);
      addNoise(pair.right.image, noise, 2);
    }
    planes.push_back(std::move(pair));
  }
  return planes;
}

void print(const char* texture, double noise, const char* map, const char* method,
           const FractionStatistics& statistics) {
  std::printf("| %s | %g | %s | %s | %.3f | %.3f | %.2f | %.2f |\n", texture, noise, map, method,
              statistics.rmsPx(), statistics.swingPx(), statistics.unevenness(), statistics.fullest());
}

void printHistograms(const FractionStatistics (&statistics)[std::size(kMethods)]) {
  std::printf("\n| fraction found |");
  for (const auto& method : kMethods) std::printf(" %s |", method.name);
  std::printf("\n|--:|--:|--:|--:|--:|\n");
  for (int bin = 0; bin < FractionStatistics::kBins; ++bin) {
    std::printf("| %.2f |", static_cast<double>(bin) / FractionStatistics::kBins);
    for (const FractionStatistics& s : statistics) std::printf(" %.2f |", s.share(bin));
    std::printf("\n");
  }
}

int run() {
  std::printf(
      "| texture | noise | map | sub-pixel | rms, px | swing, px | unevenness | fullest bin |\n"
      "|---|--:|---|---|--:|--:|--:|--:|\n");
  FractionStatistics without_noise[std::size(kMaps)][std::size(kMethods)];
  for (const double noise : {0.0, 4.0}) {
    FractionStatistics all[std::size(kMaps)][std::size(kMethods)];
    for (const Texture& texture : textures()) {
      const std::vector<RenderedPair> planes = planesOf(texture, noise);
      for (std::size_t m = 0; m < std::size(kMaps); ++m)
        for (std::size_t i = 0; i < std::size(kMethods); ++i) {
          StereoEngine engine(planeOptions(kMethods[i].method, kMaps[m].map));
          FractionStatistics statistics;
          for (const RenderedPair& pair : planes)
            statistics.add(engine.compute(pair.left.image, pair.right.image).disparity, pair.left);
          print(texture.name, noise, kMaps[m].name, kMethods[i].name, statistics);
          all[m][i].add(statistics);
        }
    }
    for (std::size_t m = 0; m < std::size(kMaps); ++m)
      for (std::size_t i = 0; i < std::size(kMethods); ++i) {
        print("all", noise, kMaps[m].name, kMethods[i].name, all[m][i]);
        if (noise == 0) without_noise[m][i] = all[m][i];
      }
  }
  std::printf(
      "\nAll textures, no noise, raw: pixels of each twentieth of a pixel, in shares of an even spread\n");
  printHistograms(without_noise[0]);
  return 0;
}

}  // namespace
}  // namespace pomona

int main() {
  return pomona::run();
}
