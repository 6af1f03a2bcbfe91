// Pictures of made-up objects, and rendered scenes with them at known places.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "datasets/render.h"

namespace pomona {

/// A shop's sign, 720 x 240: a frame, an emblem, its name, and a line below.
cv::Mat signPicture();
/// A book's cover, 360 x 480: a title, blocks and discs of colour, lines of small print; each `number`
/// another.
cv::Mat coverPicture(int number);

/// A sign on a wall.
struct SignScene {
  double distance_m = 0;  ///< of its middle from the left camera, along the line of sight
  double depth_m = 0, yaw_deg = 0;
  double bearing_deg = 0;
  cv::Rect2f left_box_px, right_box_px;  ///< around it in both views
  std::vector<cv::Point2d> outline_px;   ///< its corners in the left view
  RenderedPair pair;
};

/// The rendered shop front with a sign of 2.4 m x 0.8 m that shows signPicture(): depths 5.48, 8.53, 11.58
/// and 14.63 m, each at yaws of -45 to 45 degrees in steps of 15, up to 10 degrees aside; the harvesting
/// robot's rig (1280 x 720, f 1056.6 px, baseline 120 mm), with blur and noise.
constexpr int kSignScenes = 28;
SignScene signScene(int number);

/// A sign of the renderer's own shop fronts, 4 m away: `wide` ones are eight times as wide as high, others
/// seven times and shorter. Its picture is cut from a view, noise and all.
struct StreetSign {
  Surface surface;
  cv::Mat picture;
};
StreetSign streetSign(std::uint64_t seed, bool wide);

/// That sign, of the same size, elsewhere in another street.
SignScene signScene(const StreetSign& sign, double depth_m, double yaw_deg, std::uint64_t seed);

/// A flat object in a room.
struct PlacedObject {
  int cover = 0;                   ///< its picture is coverPicture(cover)
  int surface = 0;                 ///< in RenderedView::surface
  cv::Matx33d image_from_picture;  ///< in the left view
  double distance_m = 0;           ///< of its middle
};

struct ObjectScene {
  std::vector<PlacedObject> objects;
  RenderedPair pair;
};

/// Three covers, 0.24 m x 0.32 m, 0.9 to 1.6 m away and turned by up to 35 degrees, before a brick wall with
/// posters of covers that aren't in question, 4 m away: 640 x 480, f 560 px, baseline 60 mm, with blur and
/// noise.
constexpr int kObjectScenes = 20, kKnownCovers = 3;
ObjectScene objectScene(int number);

}  // namespace pomona
