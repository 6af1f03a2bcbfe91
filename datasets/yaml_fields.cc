#include "datasets/yaml_fields.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "datasets/input_file.h"

namespace pomona {
namespace {

int lineOf(const YAML::Node& node) {
  return node.Mark().line + 1;
}

// "4 values (-458.6, 457.3, 367.2, 248.4)": short lists are told value by value.
std::string listText(const YAML::Node& list) {
  constexpr std::size_t kMostShown = 9;
  std::string values;
  for (const YAML::Node& item : list) {
    if (!item.IsScalar() || list.size() > kMostShown) return std::to_string(list.size()) + " values";
    values += (values.empty() ? "" : ", ") + item.Scalar();
  }
  return std::to_string(list.size()) + " values (" + printable(values) + ")";
}

// OpenCV's letters for the type of a matrix's elements; those with several channels are no matrices of
// numbers.
bool isElementType(const std::string& text) {
  return text.size() == 1 && std::string_view("ucwsifd").find(text[0]) != std::string_view::npos;
}

std::string sizeText(int rows, int cols) {
  return std::to_string(rows) + " x " + std::to_string(cols);
}

}  // namespace

YamlFields YamlFields::parse(const std::string& path, std::string text) {
  constexpr std::string_view kOpenCvHead = "%YAML:";
  if (text.starts_with(kOpenCvHead))
    text[0] = '#';  // no YAML directive has a colon: a comment, so lines still count
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& e) {
    failAtLine(path, e.mark.line + 1, "no YAML: " + e.msg);
  }
  return {path, "", root};
}

YamlFields::YamlFields(std::string path, std::string name, YAML::Node node)
    : path_(std::move(path)), name_(std::move(name)), node_(std::move(node)) {
  if (!node_.IsMap()) failAtLine(path_, std::max(1, lineOf(node_)), name_ + "expected 'key: value' lines");
  std::set<std::string> keys;
  for (const auto& entry : node_)
    if (entry.first.IsScalar() && !keys.insert(entry.first.Scalar()).second)
      failAtLine(path_, lineOf(entry.first), "a second value for " + quoted(name_ + entry.first.Scalar()));
}

bool YamlFields::has(const std::string& key) const {
  return node_[key].IsDefined();
}

std::string YamlFields::oneOf(std::initializer_list<const char*> keys) const {
  std::string found;
  for (const char* key : keys) {
    if (!has(key)) continue;
    if (!found.empty())
      failAtLine(path_, lineOf(get(key)),
                 "a second value for " + quoted(name_ + found) + ", as " + quoted(key));
    found = key;
  }
  if (found.empty()) get(*keys.begin());  // throws
  return found;
}

YAML::Node YamlFields::get(const std::string& key) const {
  const YAML::Node node = node_[key];
  if (!node.IsDefined()) throw std::runtime_error(path_ + ": '" + name_ + key + "' is missing");
  return node;
}

YamlFields YamlFields::map(const std::string& key) const {
  const YAML::Node node = get(key);
  if (!node.IsMap()) fail(key, "a map of fields");
  return {path_, name_ + key + ".", node};
}

std::string YamlFields::text(const std::string& key) const {
  const YAML::Node node = get(key);
  if (!node.IsScalar()) fail(key, "a text");
  return node.Scalar();
}

double YamlFields::number(const std::string& key, double smallest, double largest) const {
  double value = 0;
  if (!parseNumber(text(key), value) || !(value >= smallest && value <= largest)) {
    std::ostringstream allowed;
    allowed.imbue(std::locale::classic());
    allowed << "a number from " << smallest << " to " << largest;
    fail(key, allowed.str());
  }
  return value;
}

int YamlFields::integer(const std::string& key, int smallest, int largest) const {
  int value = 0;
  if (!parseNumber(text(key), value) || value < smallest || value > largest)
    fail(key, "a whole number from " + std::to_string(smallest) + " to " + std::to_string(largest));
  return value;
}

void YamlFields::collect(const std::string& key, const YAML::Node& list, int depth,
                         std::vector<double>& values) const {
  constexpr int kDeepest = 2;           // a list of rows
  constexpr std::size_t kMost = 10000;  // aliases may repeat a list without end
  for (const YAML::Node& item : list) {
    double value = 0;
    if (item.IsSequence() && depth < kDeepest) {
      collect(key, item, depth + 1, values);
    } else if (values.size() < kMost && item.IsScalar() && parseNumber(item.Scalar(), value) &&
               std::isfinite(value)) {
      values.push_back(value);
    } else {
      failAtLine(path_, lineOf(item),
                 name_ + key + " holds " + quoted(item.IsScalar() ? item.Scalar() : "a list") +
                     "; allowed: finite numbers");
    }
  }
}

std::vector<double> YamlFields::numbers(const std::string& key) const {
  const YAML::Node node = get(key);
  std::vector<double> values;
  if (node.IsSequence()) {
    collect(key, node, 1, values);
  } else if (node.IsMap()) {
    const YamlFields matrix = map(key);
    constexpr int kMostRows = 1000;
    const int rows = matrix.integer("rows", 0, kMostRows), cols = matrix.integer("cols", 0, kMostRows);
    if (matrix.has("dt") && !isElementType(matrix.text("dt"))) matrix.fail("dt", "one of u c w s i f d");
    const YAML::Node data = matrix.get("data");
    if (!data.IsSequence()) matrix.fail("data", "a list of numbers");
    matrix.collect("data", data, 1, values);
    if (values.size() != static_cast<std::size_t>(rows) * cols)
      failAtLine(path_, lineOf(data),
                 name_ + key + ".data holds " + std::to_string(values.size()) +
                     " numbers; allowed: " + sizeText(rows, cols) + " as rows and cols say");
  } else {
    fail(key, "a list of numbers");
  }
  return values;
}

void YamlFields::fail(const std::string& key, const std::string& allowed) const {
  const YAML::Node node = get(key), numbers = node.IsMap() && node["data"] ? node["data"] : node;
  const std::string value = numbers.IsScalar()     ? quoted(numbers.Scalar())
                            : numbers.IsSequence() ? listText(numbers)
                            : numbers.IsMap()      ? "a map"
                                                   : "nothing";
  failAtLine(path_, std::max(1, lineOf(node)), name_ + key + " is " + value + "; allowed: " + allowed);
}

}  // namespace pomona
