#include "bench/fruits/fruit_list.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "datasets/input_file.h"

namespace pomona {
namespace {

constexpr std::size_t kFirstWay = 6;  // column
constexpr std::size_t kColumns = kFirstWay + 3 * kWays;

std::string cellOf(double value) {
  std::ostringstream out;
  if (!std::isnan(value)) out << std::setprecision(9) << value;
  return out.str();
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

std::string header() {
  std::string line = "rig,method,nearest_m,seed,fruit,visible_share";
  for (const char* way : kWayNames)
    for (const char* column : {" true_m", " measured_m", " sigma_m"}) line += std::string(",") + way + column;
  return line;
}

// The line's fruit and band; false if it is none.
bool parseFruit(const std::vector<std::string>& cells, std::size_t& band, FruitMethod::Fruit& fruit) {
  if (cells.size() != kColumns) return false;
  std::array<double, kColumns> values{};
  for (std::size_t i = 2; i < kColumns; ++i) {
    if (cells[i].empty() && i >= kFirstWay)
      values[i] = kNoDistance;
    else if (!parseNumber(cells[i], values[i]))
      return false;
  }
  const auto found = std::find_if(std::begin(kBands), std::end(kBands),
                                  [&](const Band& b) { return b.nearest_m == values[2]; });
  if (found == std::end(kBands) || !(values[3] >= 0)) return false;
  band = static_cast<std::size_t>(found - std::begin(kBands));
  fruit = {static_cast<std::uint64_t>(values[3]), static_cast<int>(values[4]), values[5], {}};
  for (std::size_t way = 0; way < kWays; ++way) {
    const double* d = &values[kFirstWay + 3 * way];
    fruit.ways[way] = {d[0], d[1], d[2]};
  }
  return true;
}

FruitMethod& methodNamed(const std::string& name, std::vector<FruitMethod>& methods) {
  for (FruitMethod& method : methods)
    if (method.name == name) return method;
  return methods.emplace_back(FruitMethod{name});
}

}  // namespace

DistanceErrors FruitMethod::errors(std::size_t band, Way way) const {
  std::vector<MeasuredDistance> distances;
  for (const Fruit& fruit : fruits[band]) distances.push_back(fruit.ways[way]);
  return errorsOf(distances);
}

std::string fruitList(const std::string& rig, std::span<const FruitMethod> methods) {
  std::ostringstream out;
  out << header() << '\n';
  for (const FruitMethod& method : methods)
    for (std::size_t band = 0; band < std::size(kBands); ++band)
      for (const FruitMethod::Fruit& fruit : method.fruits[band]) {
        out << rig << ',' << method.name << ',' << kBands[band].nearest_m << ',' << fruit.seed << ','
            << fruit.label << ',' << cellOf(fruit.visible_share);
        for (const MeasuredDistance& d : fruit.ways)
          out << ',' << cellOf(d.true_m) << ',' << cellOf(d.measured_m) << ',' << cellOf(d.sigma_m);
        out << '\n';
      }
  return out.str();
}

void addFruitList(const std::string& path, const std::string& rig, std::vector<FruitMethod>& methods) {
  std::istringstream text(readFile(path));
  std::string line;
  if (!std::getline(text, line) || line != header()) failAtLine(path, 1, "no list of pomona_fruits");
  for (int number = 2; std::getline(text, line); ++number) {
    const std::vector<std::string> cells = cellsOf(line);
    std::size_t band = 0;
    FruitMethod::Fruit fruit{};
    if (!parseFruit(cells, band, fruit)) failAtLine(path, number, "no fruit: " + pomona::quoted(line));
    if (cells[0] != rig)
      failAtLine(path, number, "the rig is " + pomona::quoted(cells[0]) + ", not " + pomona::quoted(rig));
    std::vector<FruitMethod::Fruit>& fruits = methodNamed(cells[1], methods).fruits[band];
    if (std::any_of(fruits.begin(), fruits.end(),
                    [&](const auto& f) { return f.seed == fruit.seed && f.label == fruit.label; }))
      failAtLine(path, number, "a fruit that is counted already");
    fruits.push_back(fruit);
  }
}

}  // namespace pomona
