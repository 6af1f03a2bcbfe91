// The table of segment-recognition: three covers in 20 rendered rooms, each with two filters of features and
// without.
#include "plugins/segment_recognition/recognition.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>

#include "bench/sparse/object_scenes.h"
#include "bench/sparse/precision_recall.h"
#include "bench/sparse/tables.h"
#include "datasets/atomic_file.h"
#include "datasets/image_file.h"
#include "pomona/engine.h"
#include "pomona/measure.h"

namespace pomona {
namespace {

constexpr double kReach_px = 3;  // how far from its true place a correct match may be, in the left view

double figureOf(const std::vector<SparseFigure>& figures, const std::string& name, const std::string& unit) {
  for (const SparseFigure& figure : figures)
    if (figure.name == name && figure.unit == unit) return figure.value;
  return 0;
}

ObjectDatabase coversDatabase(FeatureKind kind, double sensitivity, const std::vector<double>& yaws_deg) {
  ObjectDatabase database{kind, {}};
  const TrainingOptions options{kind, sensitivity, yaws_deg};
  for (int i = 0; i < kKnownCovers; ++i)
    database.objects.push_back(learnObject("cover " + std::to_string(i), coverPicture(i), options));
  return database;
}

const PlacedObject* objectAt(const ObjectScene& scene, cv::Point2f at) {
  const int surface = scene.pair.left.surface.at<int>(cvRound(at.y), cvRound(at.x));
  for (const PlacedObject& object : scene.objects)
    if (object.surface == surface) return &object;
  return nullptr;
}

bool isPlaceOf(const PlacedObject& object, cv::Point2f in_picture, cv::Point2f in_image) {
  const cv::Point2d expected = mapped(object.image_from_picture, in_picture);
  return std::hypot(expected.x - in_image.x, expected.y - in_image.y) <= kReach_px;
}

// One way of comparing features, over all scenes.
class Way {
 public:
  Way(const std::string& name, const ObjectDatabase& database, const RecognitionOptions& options,
      int repetitions)
      : database_(database), matcher_(database_), options_(options), repetitions_(repetitions) {
    judged_.name = name;
  }

  void add(const ObjectScene& scene) {
    const RectifiedPair pair{scene.pair.left.image, scene.pair.right.image};
    std::optional<StereoResult> map;
    const auto dense = [&]() -> const StereoResult& {
      if (!map) {
        Options options = Options::preset("fast");
        options.mode = OutputMode::kDense;
        options.num_disparities = scene.pair.calibration.num_disparities;
        map = computeDisparity(pair.left, pair.right, options);
      }
      return *map;
    };
    std::vector<double> regions, features, matching;
    for (int i = 0; i < repetitions_; ++i) {
      map.reset();
      const ComparedFeatures compared =
          compareFeatures(pair, scene.pair.calibration, {}, dense, matcher_, options_);
      if (i == 0) judge(scene, compared);
      regions.push_back(figureOf(compared.figures, "regions", "ms"));
      features.push_back(figureOf(compared.figures, "feature time", "ms"));
      matching.push_back(figureOf(compared.figures, "matching", "ms"));
      if (i == 0) features_ += figureOf(compared.figures, "features", "");
    }
    const auto median = [](std::vector<double>& ms) {
      std::nth_element(ms.begin(), ms.begin() + static_cast<std::ptrdiff_t>(ms.size() / 2), ms.end());
      return ms[ms.size() / 2];
    };
    regions_ms_ += median(regions), feature_ms_ += median(features), matching_ms_ += median(matching);
    countPossible(scene);
    range(scene, pair, dense);
    ++scenes_;
  }

  const JudgedMatches& judged() const { return judged_; }
  double matchingMs() const { return matching_ms_ / scenes_; }

  void write(std::ostream& out) const {
    const std::vector<PrecisionRecall> curve = curveOf(judged_);
    const double n = scenes_;
    char line[320];
    std::snprintf(line, sizeof(line),
                  "| %s | %.0f | %.1f | %.1f | %.1f | %.1f | %.2f | %.2f | %.2f | %.2f | %d/%d | %.2f |\n",
                  judged_.name.c_str(), features_ / n, regions_ms_ / n, feature_ms_ / n, matching_ms_ / n,
                  (regions_ms_ + feature_ms_ + matching_ms_) / n, recallAt(curve, 0.05), recallAt(curve, 0.1),
                  recallAt(curve, 0.2), recallAt(curve, 0.4), found_, kKnownCovers * scenes_,
                  percent_ / std::max(1, found_));
    out << line;
  }

 private:
  void judge(const ObjectScene& scene, const ComparedFeatures& compared) {
    for (const ObjectMatch& match : compared.matches) {
      const cv::Point2f at = compared.features.keypoints[match.query].pt;
      const PlacedObject* const object = objectAt(scene, at);
      const bool correct =
          object && object->cover == match.object &&
          isPlaceOf(*object, database_.objects[match.object].features.keypoints[match.feature].pt, at);
      judged_.matches.push_back({match.ratio, correct});
    }
  }

  // Features of the whole left view for which the database has one of the same place.
  void countPossible(const ObjectScene& scene) {
    const Features all = FeatureFinder(database_.kind, options_.sensitivity).find(scene.pair.left.image);
    for (const cv::KeyPoint& keypoint : all.keypoints) {
      const PlacedObject* const object = objectAt(scene, keypoint.pt);
      if (!object) continue;
      const std::vector<cv::KeyPoint>& known = database_.objects[object->cover].features.keypoints;
      judged_.possible += std::any_of(known.begin(), known.end(), [&](const cv::KeyPoint& other) {
        return isPlaceOf(*object, other.pt, keypoint.pt);
      });
    }
  }

  void range(const ObjectScene& scene, const RectifiedPair& pair,
             const std::function<const StereoResult&()>& dense) {
    const SparseResult result =
        recogniseObjects(pair, scene.pair.calibration, {}, dense, database_, options_);
    for (const PlacedObject& placed : scene.objects) {
      const SparseObject& object = result.objects[placed.cover];
      if (!object.found()) continue;
      ++found_;
      percent_ += 100 * std::abs(object.distance_m / placed.distance_m - 1);
    }
  }

  ObjectDatabase database_;
  ObjectMatcher matcher_;
  RecognitionOptions options_;
  int repetitions_;
  JudgedMatches judged_;
  double features_ = 0, regions_ms_ = 0, feature_ms_ = 0, matching_ms_ = 0, percent_ = 0;
  int scenes_ = 0, found_ = 0;
};

FeatureKind publishedKind() {
  const std::vector<FeatureKind> kinds = featureKinds();
  const bool has_surf = std::find(kinds.begin(), kinds.end(), FeatureKind::kSurf64) != kinds.end();
  return has_surf ? FeatureKind::kSurf64 : FeatureKind::kSift;
}

std::vector<Way> ways(int repetitions) {
  RecognitionOptions published;
  published.disparity = FeatureDisparity::kPartner;
  published.engine_map = false;
  published.ranging = ObjectRanging::kMean;
  published.locate.model = PlaceModel::kHomography;
  published.sensitivity = 1;
  published.locate.ratio = 0.7;
  published.locate.min_agreeing = 4;
  const ObjectDatabase frontal = coversDatabase(publishedKind(), 1, {});
  std::vector<Way> all;
  all.reserve(5);  // each keeps a matcher that refers to its own database
  published.filter = FeatureFilter::kNone;
  all.emplace_back("plain", frontal, published, repetitions);
  published.filter = FeatureFilter::kEpipolar;
  all.emplace_back("+ E", frontal, published, repetitions);
  published.filter = FeatureFilter::kDisparity;
  all.emplace_back("+ E + D (`variant=faithful`)", frontal, published, repetitions);
  all.emplace_back("default", coversDatabase(FeatureKind::kRootSift, 2, {}), RecognitionOptions(),
                   repetitions);
  all.emplace_back("`views=wide`", coversDatabase(FeatureKind::kRootSift, 2, wideYaws()),
                   RecognitionOptions(), repetitions);
  return all;
}

}  // namespace

void writeSegmentRecognitionTable(std::ostream& out, const SparseTableOptions& options) {
  std::vector<Way> all = ways(options.repetitions);
  for (int i = 0; i < kObjectScenes; ++i) {
    const ObjectScene scene = objectScene(i);
    for (Way& way : all) way.add(scene);
  }
  out << "## segment-recognition\n\n20 rendered rooms with 3 covers each. Recall is of the true matches that "
         "there are, "
         "at shares of false matches of 5, 10, 20 and 40 %.\n\n"
         "| | features | regions, ms | features, ms | matching, ms | all, ms | 5 % | 10 % | 20 % | 40 % | "
         "found | "
         "distance off, % |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const Way& way : all) way.write(out);
  std::vector<JudgedMatches> judged;
  for (const Way& way : all) judged.push_back(way.judged());
  if (!options.pictures.empty()) {
    writeFile(options.pictures + "/segment-recognition.png", encodeImage(drawCurves(judged)));
    writeFile(options.pictures + "/room.png", encodeImage(objectScene(1).pair.left.image));
  }
}

}  // namespace pomona
