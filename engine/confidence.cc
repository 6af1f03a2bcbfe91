#include "engine/confidence.h"

#include "core/parallel.h"
#include "pomona/pixel_state.h"

namespace pomona {

void estimateConfidence(const MatchMaps& maps, const AggregationOptions& aggregation,
                        Image<float>& confidence, int threads) {
  const int width = maps.disparity.width(), height = maps.disparity.height();
  const float half = 0.25f * static_cast<float>(aggregation.p2);
  confidence.resize(width, height);
  parallelStrips(threads, height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* margin = maps.margin.row(y);
      for (int x = 0; x < width; ++x) {
        float c = 0;
        switch (static_cast<PixelState>(maps.state.row(y)[x])) {
          case PixelState::kMeasured:
            c = (1 + margin[x]) / (1 + margin[x] + half);
            break;
          case PixelState::kFilledPlane:
            c = 0.35f;
            break;
          case PixelState::kFilledInterpolated:
            c = 0.2f;
            break;
          case PixelState::kFilledBackground:
            c = 0.15f;
            break;
          case PixelState::kFilledCoarse:
            c = 0.05f;
            break;
          default:
            break;
        }
        confidence.row(y)[x] = c;
      }
    }
  });
}

}  // namespace pomona
