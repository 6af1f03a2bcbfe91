#include "datasets/walk.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

#include "datasets/input_file.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

fs::path absolutePath(const fs::path& folder) {
  return (fs::absolute(folder).lexically_normal() / "").parent_path();
}

std::string leafOf(const fs::path& folder) {
  return absolutePath(folder).filename().string();
}

bool isFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool isThere(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

// `stem` with the first extension under which there is such a file; empty if there is none.
std::string imageCalled(const fs::path& folder, const std::string& stem) {
  for (const char* extension : {".png", ".ppm", ".pgm"})
    if (isThere(folder / (stem + extension))) return (folder / (stem + extension)).string();
  return "";
}

SceneFiles eth3dOrMiddlebury(const fs::path& folder) {
  SceneFiles files = middleburyFiles(folder.string());
  if (!files.split().starts_with("two_view")) return files;
  files.layout = SceneLayout::kEth3d;
  if (files.ground_truth.empty()) {
    const fs::path beside = folder / ".." / ".." / (files.split() + "_gt") / files.name;
    if (isThere(beside / "disp0GT.pfm")) files.ground_truth = (beside / "disp0GT.pfm").lexically_normal();
    if (isThere(beside / "mask0nocc.png")) files.nonoccluded = (beside / "mask0nocc.png").lexically_normal();
  }
  return files;
}

// The 8-bit sets; false if the folder is none of their scenes.
bool findMiddlebury2(const fs::path& folder, std::vector<SceneFiles>& scenes) {
  struct Names {
    const char *left, *right, *truth;
  };
  constexpr std::array<Names, 3> kNames = {
      {{"im2", "im6", "disp2"}, {"view1", "view5", "disp1"}, {"imL", "imR", "groundtruth"}}};
  for (const Names& names : kNames) {
    const std::string left = imageCalled(folder, names.left), right = imageCalled(folder, names.right);
    if (left.empty() && right.empty()) continue;
    const auto orPng = [&](const std::string& path, const char* stem) {  // to be named as missing
      return path.empty() ? (folder / stem).string() + ".png" : path;
    };
    SceneFiles files;
    files.name = leafOf(folder);
    files.folder = absolutePath(folder).parent_path().string();
    files.layout = SceneLayout::kMiddlebury2;
    files.left = orPng(left, names.left);
    files.right = orPng(right, names.right);
    files.ground_truth = imageCalled(folder, names.truth);
    files.nonoccluded = imageCalled(folder, "nonocc");
    scenes.push_back(std::move(files));
    return true;
  }
  return false;
}

// The frames of a KITTI split; false if the folder is none.
bool findKitti(const fs::path& folder, std::vector<SceneFiles>& scenes) {
  struct Names {
    SceneLayout layout;
    const char *left, *right, *truth, *nonoccluded;
  };
  constexpr std::array<Names, 3> kNames = {
      {{SceneLayout::kKitti2015, "image_2", "image_3", "disp_occ_0", "disp_noc_0"},
       {SceneLayout::kKitti2012, "colored_0", "colored_1", "disp_occ", "disp_noc"},
       {SceneLayout::kKitti2012, "image_0", "image_1", "disp_occ", "disp_noc"}}};
  for (const Names& names : kNames) {
    if (!isFolder(folder / names.left) || !isFolder(folder / names.right)) continue;
    std::set<std::string> frames;  // those that any of the folders has
    for (const char* part : {names.left, names.right, names.truth, names.nonoccluded})
      if (isFolder(folder / part))
        for (const auto& entry : fs::directory_iterator(folder / part))
          if (const std::string leaf = entry.path().filename(); leaf.ends_with("_10.png"))
            frames.insert(leaf);
    const auto pathOf = [&](const char* part, const std::string& leaf) {
      return isFolder(folder / part) ? (folder / part / leaf).string() : std::string();
    };
    for (const std::string& leaf : frames) {
      SceneFiles files;
      files.name = fs::path(leaf).stem();
      files.folder = absolutePath(folder).string();
      files.layout = names.layout;
      files.left = pathOf(names.left, leaf);
      files.right = pathOf(names.right, leaf);
      files.nonoccluded = pathOf(names.nonoccluded, leaf);
      files.ground_truth = pathOf(names.truth, leaf);
      if (files.ground_truth.empty()) files.ground_truth = files.nonoccluded;
      if (names.layout == SceneLayout::kKitti2015) files.objects = pathOf("obj_map", leaf);
      scenes.push_back(std::move(files));
    }
    return true;
  }
  return false;
}

// The folder of truth beside an ETH3D split holds no scenes of its own.
bool isTruthBesideSplit(const fs::path& folder) {
  const std::string leaf = leafOf(folder);
  return leaf.starts_with("two_view") && leaf.ends_with("_gt");
}

SceneFiles problemAt(const fs::path& folder, const std::string& problem) {
  SceneFiles files;
  files.name = leafOf(folder);
  files.folder = absolutePath(folder).parent_path().string();
  files.problem = problem;
  return files;
}

class Walker {
 public:
  std::vector<SceneFiles> scenes;

  // False if there is nothing at or below `folder`, and never was.
  bool visit(const fs::path& folder) {
    if (isTruthBesideSplit(folder)) return false;
    if (!visited_.insert(fs::canonical(folder)).second) return true;
    const std::size_t before = scenes.size();
    try {
      look(folder);
    } catch (const fs::filesystem_error& error) {
      scenes.push_back(problemAt(folder, folder.string() + ": cannot be read: " + error.code().message()));
    } catch (const std::runtime_error& error) {  // of a manifest
      scenes.push_back(problemAt(folder, error.what()));
    }
    return scenes.size() > before;
  }

 private:
  void look(const fs::path& folder) {
    if (isThere(folder / "manifest.csv")) {
      std::vector<SceneFiles> listed = readManifest((folder / "manifest.csv").string());
      std::move(listed.begin(), listed.end(), std::back_inserter(scenes));
      return;
    }
    if (isThere(folder / "im0.png") || isThere(folder / "im1.png") || isThere(folder / "disp0GT.pfm")) {
      scenes.push_back(eth3dOrMiddlebury(folder));
      return;
    }
    if (findMiddlebury2(folder, scenes) || findKitti(folder, scenes)) return;
    std::vector<fs::path> below;
    for (const auto& entry : fs::directory_iterator(folder))
      if (isFolder(entry.path())) below.push_back(entry.path());
    std::sort(below.begin(), below.end());
    for (const fs::path& path : below) visit(path);
  }

  std::set<fs::path> visited_;  // canonical; a link may lead back up
};

// Manifests may use a name twice: numbers follow it.
void numberWithinFolders(std::vector<SceneFiles>& scenes) {
  std::set<std::pair<std::string, std::string>> taken;  // folder, name
  for (SceneFiles& scene : scenes) {
    const std::string name = scene.name;
    for (int n = 2; !taken.emplace(scene.folder, scene.name).second; ++n)
      scene.name = name + "-" + std::to_string(n);
  }
}

// Of folders that share a name, all scenes get one more of the folders above them in front of theirs, until
// none do: scenes of one split stay together.
void tellFoldersApart(std::vector<SceneFiles>& scenes) {
  std::map<std::string, fs::path> above;  // by folder: the part of its path that no name holds yet
  for (const SceneFiles& scene : scenes) above[scene.folder] = scene.folder;
  for (;;) {
    std::map<std::string, std::set<std::string>> folders_of;  // by name
    for (const SceneFiles& scene : scenes) folders_of[scene.name].insert(scene.folder);
    std::set<std::string> alike;
    for (const auto& [name, folders] : folders_of)
      if (folders.size() > 1) alike.insert(folders.begin(), folders.end());
    if (alike.empty()) return;
    for (SceneFiles& scene : scenes)
      if (const fs::path leaf = above[scene.folder].filename(); alike.contains(scene.folder) && !leaf.empty())
        scene.name = printable(leaf.string()) + "/" + scene.name;
    for (const std::string& folder : alike) above[folder] = above[folder].parent_path();
  }
}

}  // namespace

std::vector<SceneFiles> findScenes(const std::vector<std::string>& roots) {
  Walker walker;
  for (const std::string& root : roots) {
    if (!isFolder(root)) throw std::runtime_error(root + ": there is no such folder");
    if (!walker.visit(root))
      throw std::runtime_error(root +
                               ": no scene found (of Middlebury, KITTI or ETH3D, or in a manifest.csv)");
  }
  for (SceneFiles& scene : walker.scenes) scene.name = printable(scene.name);
  numberWithinFolders(walker.scenes);
  tellFoldersApart(walker.scenes);
  return std::move(walker.scenes);
}

}  // namespace pomona
