// The table of both recognising plugins on real pairs.
#include <cmath>
#include <cstdio>

#include "bench/sparse/real_queries.h"
#include "bench/sparse/tables.h"
#include "bench/sparse/temporary_folder.h"
#include "datasets/atomic_file.h"
#include "datasets/image_file.h"
#include "pomona/engine.h"
#include "pomona/plugin_host.h"

namespace pomona {
namespace {

std::string percentOff(double disparity_px, double truth_px) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", 100 * std::abs(disparity_px / truth_px - 1));
  return text;
}

std::string offBy(LoadedPlugin& plugin, const std::string& picture, const char* variant, const RealPair& pair,
                  const PluginRunOptions& options) {
  PluginSettings settings = plugin.settings();
  settings.set("variant", variant);
  settings.set("objects", picture);
  // The scenes' own metres are unknown: nothing is to count as far, and nothing as too low.
  if (plugin.name() == "segment-recognition")
    settings.set("far_m", "1000");
  else
    settings.set("upper_half", "off");
  const SparseResult result = plugin.run(pair.left, pair.right, pair.calibration, settings, options);
  const SparseObject& object = result.objects.at(0);
  return object.found() ? percentOff(disparityOf(pair.calibration, object.point_m.z), pair.truth_px)
                        : "not found";
}

}  // namespace

void writeRealQueryTable(std::ostream& out, const SparseTableOptions& options) {
  out << "## Real pairs\n\n";
  if (options.scenes.empty()) {
    out << "Left out: no folder of real pairs was given.\n";
    return;
  }
  out << "Percent of the true disparity by which an altered picture's place is off: by default, and with "
         "`variant=faithful`.\n\n"
         "| scene | what | disparity, px | logo-range | faithful | segment-recognition | faithful | dense "
         "map |\n"
         "|---|---|--:|--:|--:|--:|--:|--:|\n";
  PluginHost host;
  LoadedPlugin &logos = host.plugin("logo-range"), &segments = host.plugin("segment-recognition");
  const TemporaryFolder folder;
  for (const RealQuery& query : realQueries()) {
    const RealPair pair = realPair(query, options.scenes);
    const std::string picture = folder.file(query.scene + " " + query.label + ".png");
    writeFile(picture, encodeImage(pictureOf(query, pair.left)));
    Options dense_options = Options::preset("balanced");
    dense_options.num_disparities = estimateNumDisparities(pair.left, pair.right, dense_options);
    const StereoResult dense = computeDisparity(pair.left, pair.right, dense_options);
    PluginRunOptions run;
    run.dense = [&] { return dense; };
    char truth[32];
    std::snprintf(truth, sizeof(truth), "%.1f", pair.truth_px);
    out << "| " << query.scene << " | " << query.label << " | " << truth;
    for (LoadedPlugin* plugin : {&logos, &segments})
      for (const char* variant : {"default", "faithful"})
        out << " | " << offBy(*plugin, picture, variant, pair, run);
    out << " | " << percentOff(medianDisparity(dense.disparity, query.place), pair.truth_px) << " |\n";
  }
}

}  // namespace pomona
