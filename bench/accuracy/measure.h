// The loop of every tool that counts errors on scenes with known truth.
#pragma once

#include <exception>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "bench/accuracy/figures.h"
#include "datasets/atomic_file.h"
#include "datasets/scene.h"

namespace pomona {

/// Says on stderr what went wrong, and counts it: one bad scene does not end a run.
class Failures {
 public:
  explicit Failures(std::string program) : program_(std::move(program)) {}

  void note(const std::string& what, const std::exception& error);
  int count() const { return count_; }

 private:
  std::string program_;
  int count_ = 0;
};

/// `num_disparities`: disparitiesToReach() of the truth; the same range for everybody, for what is compared
/// is the matching, not the guessing.
using SceneVisitor = std::function<void(const std::string& name, const Scene& scene, int num_disparities)>;

/// Hands over the scenes with known truth below `folder`, one after the other, and names them on stderr.
/// Throws std::runtime_error if there is none that can be read.
void forEachScene(const std::string& folder, Failures& failures, const SceneVisitor& visit);

/// The files of these paths that are not empty: checked before hours of matching, not after.
std::vector<OutputFile> plannedOutputs(std::initializer_list<std::string> paths);

SceneFigures sceneFigures(const std::string& name, const Scene& scene, const MethodResult& result);

/// Runs the method of `contender`; without figures if it fails.
SceneFigures measure(Method& method, const Contender& contender, const std::string& name, const Scene& scene,
                     int num_disparities, Failures& failures);

}  // namespace pomona
