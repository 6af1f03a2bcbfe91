// The fields of a YAML map, checked as they are read.
#pragma once

#include <yaml-cpp/node/node.h>

#include <initializer_list>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace pomona {

/// One map of a YAML file. Understands OpenCV's dialect as well: its "%YAML:1.0" head and !!opencv-matrix.
/// Everything that is wrong is thrown as std::runtime_error "path: line N: field is 'value'; allowed: ...".
class YamlFields {
 public:
  /// The map that the file consists of; `text` is what is in it.
  static YamlFields parse(const std::string& path, std::string text);

  const std::string& path() const { return path_; }
  bool has(const std::string& key) const;
  /// The one of `keys`, which mean the same, that is there; throws, naming the first, if none is, or if two
  /// are.
  std::string oneOf(std::initializer_list<const char*> keys) const;

  YamlFields map(const std::string& key) const;
  std::string text(const std::string& key) const;
  double number(const std::string& key, double smallest, double largest) const;
  int integer(const std::string& key, int smallest, int largest) const;
  /// The finite numbers of a list, a list of lists, or a matrix {rows, cols, [dt,] data} (whose data must fit
  /// it).
  std::vector<double> numbers(const std::string& key) const;
  /// The same, row by row, where there are Rows * Cols of them.
  template <int Rows, int Cols>
  cv::Matx<double, Rows, Cols> matrix(const std::string& key) const {
    const std::vector<double> values = numbers(key);
    if (values.size() != Rows * Cols)
      fail(key, std::to_string(Rows) + " x " + std::to_string(Cols) + " numbers");
    return cv::Matx<double, Rows, Cols>(values.data());
  }

  [[noreturn]] void fail(const std::string& key, const std::string& allowed) const;

 private:
  YamlFields(std::string path, std::string name, YAML::Node node);
  YAML::Node get(const std::string& key) const;
  void collect(const std::string& key, const YAML::Node& list, int depth, std::vector<double>& values) const;

  std::string path_;
  std::string name_;  // of this map, with a dot behind it; empty for the file's
  YAML::Node node_;
};

}  // namespace pomona
