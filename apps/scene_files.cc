#include "apps/scene_files.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "datasets/image_file.h"
#include "datasets/middlebury_calib.h"
#include "datasets/pfm.h"
#include "datasets/rendering/sightings.h"

namespace pomona {
namespace {

using Json = nlohmann::ordered_json;

Json listOf(const cv::Vec3d& v) {
  return {v[0], v[1], v[2]};
}

void addSighting(Json& entry, const Sighting& s) {
  entry["visible_px"] = s.visible_px;
  entry["visible_share"] = s.visible_share;
  entry["seen_by_both"] = s.seen_by_both;
  entry["nearest_z_m"] = std::isnan(s.nearest_z_m) ? Json() : Json(s.nearest_z_m);
  entry["box_px"] = {s.box_px.x, s.box_px.y, s.box_px.width, s.box_px.height};
}

template <typename Items>
std::vector<int> surfacesOf(const Items& items) {
  std::vector<int> surfaces;
  for (const auto& item : items) surfaces.push_back(item.surface);
  return surfaces;
}

// Where the left view shows a place.
Json pixelOf(const cv::Vec3d& p, const StereoCalibration& c) {
  return {c.cx_px + c.focal_px * p[0] / p[2], c.cy_px + c.focal_px * p[1] / p[2]};
}

}  // namespace

std::vector<OutputFile> pairFiles(const RenderedPair& pair) {
  return {
      {"im0.png", encodeImage(pair.left.image)},
      {"im1.png", encodeImage(pair.right.image)},
      {"disp0GT.pfm", encodePfm(pair.left.disparity)},
      {"disp1GT.pfm", encodePfm(pair.right.disparity)},
      {"mask0nocc.png", encodeImage(pair.left.mask)},
      {"mask1nocc.png", encodeImage(pair.right.mask)},
      {"calib.txt", encodeMiddleburyCalibration(pair.calibration)},
  };
}

std::vector<OutputFile> fruitFiles(const Orchard& orchard, const RenderedPair& pair) {
  const std::vector<int> surfaces = surfacesOf(orchard.fruits);
  const std::vector<Sighting> seen = sightings(orchard.scene, pair, surfaces);
  Json fruits = Json::array();
  for (std::size_t i = 0; i < orchard.fruits.size(); ++i) {
    const Fruit& fruit = orchard.fruits[i];
    Json entry{{"id", i + 1},
               {"label", fruit.label},
               {"cluster", fruit.cluster},
               {"center_m", listOf(fruit.center_m)},
               {"radius_m", fruit.radius_m},
               {"half_height_m", fruit.half_height_m},
               {"distance_m", fruit.distance_m},
               {"near_distance_m", fruit.near_distance_m}};
    addSighting(entry, seen[i]);
    fruits.push_back(entry);
  }
  return {{"fruits.json", Json{{"fruits", fruits}}.dump(2) + "\n"},
          {"fruits0.png", encodeImage(labelsOf(orchard.scene, pair, surfaces))}};
}

std::vector<OutputFile> signFiles(const Storefront& storefront, const RenderedPair& pair) {
  const std::vector<Sighting> seen = sightings(storefront.scene, pair, surfacesOf(storefront.signs));
  Json signs = Json::array();
  for (std::size_t i = 0; i < storefront.signs.size(); ++i) {
    const Sign& sign = storefront.signs[i];
    Json corners = Json::array();  // clockwise from the top left
    for (const cv::Vec3d& side :
         {-sign.u_m - sign.v_m, sign.u_m - sign.v_m, sign.u_m + sign.v_m, sign.v_m - sign.u_m})
      corners.push_back(pixelOf(sign.center_m + side, pair.calibration));
    Json entry{{"id", i + 1},
               {"text", sign.text},
               {"wall", sign.wall},
               {"yaw_deg", sign.yaw_deg},
               {"center_m", listOf(sign.center_m)},
               {"u_m", listOf(sign.u_m)},
               {"v_m", listOf(sign.v_m)},
               {"distance_m", std::sqrt(sign.center_m.dot(sign.center_m))},
               {"corners_px", corners}};
    addSighting(entry, seen[i]);
    signs.push_back(entry);
  }
  return {{"signs.json", Json{{"signs", signs}}.dump(2) + "\n"}};
}

}  // namespace pomona
