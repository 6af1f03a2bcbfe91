#include "apps/eval_record.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace pomona {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kCsvDecimals = 6;
constexpr Region kRegions[] = {Region::kAll, Region::kNonoccluded};

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  quoted += '"';
  return quoted;
}

std::string csvLine(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    if (!line.empty()) line += ',';
    line += csvField(cell);
  }
  line += '\n';
  return line;
}

const std::optional<RegionFigures>& regionOf(const Measurement& measurement, Region region) {
  return region == Region::kAll ? measurement.all : measurement.nonoccluded;
}

// Times are noted for all pixels, even without truth.
bool hasRegion(const Measurement& measurement, Region region) {
  return region == Region::kAll || measurement.nonoccluded;
}

Json namedFigures(const std::vector<double>& values) {
  Json figures = Json::object();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i])) figures[figureColumns()[i].name] = values[i];
  return figures;
}

Json curveOf(const Measurement& measurement, Region region) {
  Json points = Json::array();
  if (const auto& figures = regionOf(measurement, region))
    for (const CoverageCurve::Point& point : figures->curve.points)
      points.push_back({point.coverage_percent, point.wrong_percent, point.oracle_percent});
  return points;
}

Json subpixelOf(const Measurement& measurement, Region region) {
  Json bins = Json::array();
  if (const auto& figures = regionOf(measurement, region))
    for (const SubpixelErrors::Bin& bin : figures->subpixel.bins)
      bins.push_back({bin.count, bin.biasPx(), bin.rmsPx()});  // JSON has null for the NaN of an empty bin
  return bins;
}

}  // namespace

int EvalRecord::scenesBehindMean(const std::string& method, Region over) const {
  return static_cast<int>(std::count_if(measurements.begin(), measurements.end(), [&](const Measurement& m) {
    return m.method == method && regionOf(m, over);
  }));
}

std::vector<double> EvalRecord::meanOfMethod(const std::string& method, Region over) const {
  std::vector<std::vector<double>> rows;
  std::vector<double> weights;
  for (const Measurement& measurement : measurements)
    if (measurement.method == method) {
      rows.push_back(figuresOf(measurement, over));
      if (weighted) weights.push_back(middleburyWeight(measurement.scene));
    }
  return meanOf(rows, weights);
}

std::string csvOf(const EvalRecord& record) {
  std::vector<std::string> cells = {"scene", "method", "region", "width", "height", "num_disparities"};
  for (const FigureColumn& column : figureColumns()) cells.emplace_back(column.name);
  std::string text = csvLine(cells);
  for (const Measurement& m : record.measurements)
    for (const Region region : kRegions) {
      if (!hasRegion(m, region)) continue;
      cells = {m.scene,
               m.method,
               name(region),
               std::to_string(m.size.width),
               std::to_string(m.size.height),
               std::to_string(m.num_disparities)};
      for (const double value : figuresOf(m, region))
        cells.push_back(std::isnan(value) ? std::string() : shown(value, kCsvDecimals));
      text += csvLine(cells);
    }
  return text;
}

std::string jsonOf(const EvalRecord& record) {
  Json root;
  root["facts"] = Json::object();
  for (const EvalRecord::Fact& fact : record.facts) root["facts"][fact.name] = fact.value;
  for (const FigureColumn& column : figureColumns()) root["columns"][column.name] = column.description;
  root["scenes"] = Json::array();
  for (const Measurement& m : record.measurements) {
    Json row = {{"scene", m.scene},
                {"method", m.method},
                {"width", m.size.width},
                {"height", m.size.height},
                {"num_disparities", m.num_disparities}};
    for (const Region region : kRegions)
      if (hasRegion(m, region)) row[name(region)] = namedFigures(figuresOf(m, region));
    row["curve"] = curveOf(m, record.region);
    row["subpixel"] = subpixelOf(m, record.region);
    root["scenes"].push_back(std::move(row));
  }
  root["means"] = Json::object();
  for (const std::string& method : record.methods)
    for (const Region region : kRegions) {
      Json& mean = root["means"][method][name(region)];
      mean["scenes"] = record.scenesBehindMean(method, region);
      mean.update(namedFigures(record.meanOfMethod(method, region)));
    }
  root["problems"] = record.problems;
  root["remarks"] = record.remarks;
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pomona
