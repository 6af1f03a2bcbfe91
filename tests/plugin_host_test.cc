#include "pomona/plugin_host.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "file_support.h"

namespace pomona {
namespace {

namespace fs = std::filesystem;

const std::string kGood = POMONA_TEST_PLUGINS "/good", kBroken = POMONA_TEST_PLUGINS "/broken";

/// What loading the file throws.
std::string refusal(const std::string& path) {
  return messageOf([&] { LoadedPlugin plugin(path); });
}

LoadedPlugin middle() {
  return LoadedPlugin(kGood + "/middle.so");
}

/// Two views of a wall, and their geometry.
struct Wall {
  static constexpr int kShift_px = 9;

  Wall() {
    cv::Mat texture(96, 160 + kShift_px, CV_8U);
    cv::RNG(42).fill(texture, cv::RNG::UNIFORM, 0, 256);
    left = texture.colRange(0, 160);
    right = texture.colRange(kShift_px, 160 + kShift_px);
    calibration.focal_px = 450;
    calibration.baseline_m = 0.1;
    calibration.num_disparities = 32;
  }
  cv::Mat left, right;
  StereoCalibration calibration;
};

SparseResult runWith(std::vector<std::string> assignments) {
  const Wall wall;
  LoadedPlugin plugin = middle();
  PluginSettings settings = plugin.settings();
  settings.assign(assignments);
  return plugin.run(wall.left, wall.right, wall.calibration, settings);
}

std::string failureWith(const std::string& assignment) {
  return messageOf([&] { runWith({assignment}); });
}

TEST(LoadedPlugin, DeclaresItself) {
  const LoadedPlugin plugin = middle();
  EXPECT_EQ(plugin.name(), "middle");
  EXPECT_EQ(plugin.description(), "The point in the middle of the left view");
  ASSERT_EQ(plugin.parameters().size(), 5u);
  EXPECT_EQ(plugin.parameters()[1].default_value, "0.25");
  ASSERT_EQ(plugin.parameterSets().size(), 1u);
}

TEST(LoadedPlugin, RunsOnTheDenseMap) {
  const SparseResult result = runWith({"points=2"});
  ASSERT_EQ(result.points.size(), 2u);
  EXPECT_NEAR(result.points[1].disparity_px, Wall::kShift_px, 0.3);
  EXPECT_NEAR(result.points[1].point_m.z, 450 * 0.1 / Wall::kShift_px, 0.2);
  ASSERT_EQ(result.objects.size(), 1u);
  EXPECT_TRUE(result.objects[0].found());
}

TEST(LoadedPlugin, GivesItTheCallersDenseMapOnce) {
  const Wall wall;
  LoadedPlugin plugin = middle();
  int calls = 0;
  PluginRunOptions options;
  options.dense = [&] {
    ++calls;
    StereoResult result;
    result.disparity = cv::Mat(wall.left.size(), CV_32F, cv::Scalar(5));
    return result;
  };
  const SparseResult result = plugin.run(wall.left, wall.right, wall.calibration, plugin.settings(), options);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(result.points.at(0).disparity_px, 5);
  EXPECT_EQ(result.figures.at(0).value, 1);
  EXPECT_EQ(
      plugin.run(wall.left, wall.right, wall.calibration, plugin.settings(), options).figures.at(0).value, 2)
      << "one object from run to run";
}

TEST(LoadedPlugin, OutlivesWhatItThrows) {
  EXPECT_EQ(failureWith("fails=error"), "middle: told to fail");
  EXPECT_EQ(failureWith("fails=number"), "middle: the plugin threw something that is no std::exception");
}

TEST(LoadedPlugin, RefusesResultsThatContradictThemselves) {
  EXPECT_EQ(failureWith("fails=object"),
            "middle: the plugin's point 0 belongs to object 1; allowed: -1 to 0");
  expectContains(failureWith("fails=picture"), "the plugin's picture 'gray' is 6 x 4, type CV_32FC1");
}

TEST(LoadedPlugin, RefusesInputsThatNoneCouldUse) {
  const Wall wall;
  LoadedPlugin plugin = middle();
  const PluginSettings settings = plugin.settings();
  const auto run = [&](const cv::Mat& left, const cv::Mat& right, const StereoCalibration& calibration,
                       const cv::Mat& mask = {}) {
    plugin.run(left, right, calibration, settings, {mask, {}, 0});
  };
  StereoCalibration other_size = wall.calibration, no_focal = wall.calibration;
  other_size.width = 100;
  no_focal.focal_px = 0;
  EXPECT_THROW(run({}, {}, wall.calibration), std::invalid_argument);
  EXPECT_THROW(run(wall.left, wall.right.colRange(0, 9), wall.calibration), std::invalid_argument);
  EXPECT_THROW(run(cv::Mat(9, 9, CV_32F), cv::Mat(9, 9, CV_32F), wall.calibration), std::invalid_argument);
  EXPECT_THROW(run(wall.left, wall.right, wall.calibration, cv::Mat(3, 3, CV_8U)), std::invalid_argument);
  EXPECT_THROW(run(wall.left, wall.right, other_size), std::invalid_argument);
  EXPECT_THROW(run(wall.left, wall.right, no_focal), std::invalid_argument);
}

TEST(PluginFile, OfAnotherInterfaceIsNotTouched) {
  EXPECT_EQ(refusal(kBroken + "/OtherVersion.so"), kBroken + "/OtherVersion.so: built for plugin interface " +
                                                       std::to_string(kPluginAbiVersion + 1) +
                                                       "; this Pomona has " +
                                                       std::to_string(kPluginAbiVersion));
  EXPECT_EQ(refusal(kBroken + "/OtherBuild.so"),
            kBroken + "/OtherBuild.so: built with another compiler; this Pomona with " + pluginBuildTag());
  expectContains(refusal(kBroken + "/OtherLayout.so"), "layout of structs");
}

TEST(PluginFile, WithoutWhatItNeedsIsRefused) {
  expectContains(refusal(kBroken + "/WithoutEntry.so"), "no symbol pomona_plugin_entry");
  expectContains(refusal(kBroken + "/NoEntry.so"), "gave nothing");
  expectContains(refusal(kBroken + "/Nothing.so"), "could not be made");
  expectContains(refusal(kBroken + "/ThrowsInCreate.so"), "no luck");
  expectContains(refusal(kBroken + "/ThrowsNumberInCreate.so"), "no std::exception");
  expectContains(refusal(kBroken + "/ThrowsInName.so"), "nameless");
  expectContains(refusal(kBroken + "/ThrowsInEntry.so"), "no std::exception");
  expectContains(refusal(kBroken + "/BadName.so"), "'Bad name'");
  expectContains(refusal(kBroken + "/BadDefault.so"), "broken: ratio is '0.5'; allowed: 0 to 0.25");
  expectContains(refusal(kBroken + "/TwoParametersOfOneName.so"), "two parameters are called 'ratio'");
  expectContains(refusal(kBroken + "/BadSet.so"), "ratio is '1.5'");
}

TEST(PluginFile, ThatWouldEndTheProgramIsRefused) {
  const std::string ends = ".so: ends the program as it is loaded, ";
  EXPECT_EQ(refusal(kBroken + "/ThrowsAtOpening.so"),
            kBroken + "/ThrowsAtOpening" + ends + "by an exception: no static luck");
  EXPECT_EQ(refusal(kBroken + "/LeavesAtOpening.so"),
            kBroken + "/LeavesAtOpening" + ends + "by leaving it with status 3");
  for (const std::string name : {"CrashesAtOpening", "CrashesInCreate"})
    EXPECT_TRUE(refusal(kBroken + "/" + name + ".so").starts_with(kBroken + "/" + name + ends + "by "))
        << name;
}

TEST(PluginFile, ThatIsNoLibraryIsRefused) {
  const TemporaryFolder folder;
  const std::string text = folder / "text.so", empty = folder / "empty.so", cut = folder / "cut.so";
  put(text, "This is a text of more than sixty-four letters, the size of a library's header.\n");
  put(empty, "");
  fs::copy_file(kGood + "/middle.so", cut);
  fs::resize_file(cut, 1000);  // where the segments begin
  fs::create_directory(folder / "folder.so");
  expectContains(refusal(text), "no shared library");
  expectContains(refusal(empty), "no shared library");
  expectContains(refusal(cut), "before the library does");
  expectContains(refusal(folder / "folder.so"), "not a file");
  expectContains(refusal(folder / "absent.so"), "No such file");

  const PluginHost host({folder / ""});  // ... and the host goes on
  EXPECT_EQ(host.refused().size(), 4u);
}

TEST(PluginHost, KeepsTheGoodAndNamesTheOthers) {
  PluginHost host({kGood, kBroken, kGood, "/no/such/folder"});
  ASSERT_EQ(host.plugins().size(), 1u);
  EXPECT_EQ(host.plugin("middle").path(), kGood + "/middle.so");
  EXPECT_EQ(host.refused().size(), 20u);  // 19 files, and the folder
  std::optional<std::string> same_name, folder;
  for (const auto& [path, reason] : host.refused()) {
    if (path.ends_with("SameName.so")) same_name = reason;
    if (path == "/no/such/folder") folder = reason;
    EXPECT_EQ(reason.find(path), std::string::npos) << "the path is not said twice";
  }
  EXPECT_EQ(same_name, "another plugin is called 'middle': " + kGood + "/middle.so");
  EXPECT_EQ(folder, "No such file or directory");
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { host.plugin("muddle"); }),
            "plugin is 'muddle'; allowed: middle");
}

TEST(PluginHost, TheFirstOfOneNameCounts) {
  PluginHost host({kBroken, kGood});
  EXPECT_EQ(host.plugin("middle").path(), kBroken + "/SameName.so");
}

TEST(PluginFolders, BeginWithTheVariable) {
  ::setenv("POMONA_PLUGIN_PATH", "/one::/two:", 1);
  const std::vector<std::string> folders = pluginFolders();
  ::unsetenv("POMONA_PLUGIN_PATH");
  ASSERT_GE(folders.size(), 2u);
  EXPECT_EQ(folders[0], "/one");
  EXPECT_EQ(folders[1], "/two");
  const std::vector<std::string> others(folders.begin() + 2, folders.end());
  EXPECT_EQ(pluginFolders(), others) << "empty parts name nothing";
}

class Settings : public ::testing::Test {
 protected:
  static std::string refusalOf(const std::vector<std::string>& assignments) {
    PluginSettings settings = middle().settings();
    return messageOf<std::invalid_argument>([&] { settings.assign(assignments); });
  }
};

TEST_F(Settings, AreTheDefaultsUntilTheyAreSet) {
  PluginSettings settings = middle().settings();
  EXPECT_EQ(settings.real("sigma_px"), 0.25);
  EXPECT_EQ(settings.integer("points"), 1);
  EXPECT_TRUE(settings.isOn("found"));
  EXPECT_EQ(settings.text("label"), "middle");
  EXPECT_EQ(settings.text("fails"), "never");
  settings.set("sigma_px", "1e-1");
  settings.set("found", "off");
  settings.set("label", "a=b");
  EXPECT_EQ(settings.real("sigma_px"), 0.1);
  EXPECT_FALSE(settings.isOn("found"));
  EXPECT_EQ(settings.values().back(), (std::pair<std::string, std::string>("label", "a=b")));
}

TEST_F(Settings, TakeTheVariantFirst) {
  PluginSettings settings = middle().settings();
  settings.assign(std::vector<std::string>{"points=7", "label=x", "variant=faithful"});
  EXPECT_EQ(settings.integer("points"), 7);
  EXPECT_EQ(settings.real("sigma_px"), 1);
  EXPECT_EQ(settings.text("label"), "x");
  settings.set("variant", "default");
  EXPECT_EQ(settings.integer("points"), 1);
  EXPECT_EQ(settings.text("label"), "middle");
}

TEST_F(Settings, SayWhatIsAllowed) {
  EXPECT_EQ(refusalOf({"sigma_px=11"}), "middle: sigma_px is '11'; allowed: 0 to 10");
  EXPECT_EQ(refusalOf({"sigma_px=nan"}), "middle: sigma_px is 'nan'; allowed: 0 to 10");
  EXPECT_EQ(refusalOf({"sigma_px="}), "middle: sigma_px is ''; allowed: 0 to 10");
  EXPECT_EQ(refusalOf({"sigma_px=1x"}), "middle: sigma_px is '1x'; allowed: 0 to 10");
  EXPECT_EQ(refusalOf({"points=1.5"}), "middle: points is '1.5'; allowed: whole numbers, 0 to 100");
  EXPECT_EQ(refusalOf({"found=yes"}), "middle: found is 'yes'; allowed: on, off");
  EXPECT_EQ(refusalOf({"fails=often"}),
            "middle: fails is 'often'; allowed: never, error, number, object, picture");
  EXPECT_EQ(refusalOf({"variant=x"}), "middle: variant is 'x'; allowed: default, faithful");
  EXPECT_EQ(refusalOf({"color=x"}),
            "middle: parameter is 'color'; allowed: fails, sigma_px, points, found, label, variant");
  EXPECT_EQ(refusalOf({"points"}), "middle: setting is 'points'; allowed: name=value");
}

TEST_F(Settings, RefuseNamesThatWereNotDeclared) {
  const PluginSettings settings = middle().settings();
  EXPECT_THROW(settings.real("points"), std::logic_error);
  EXPECT_THROW(settings.integer("color"), std::logic_error);
  EXPECT_THROW(settings.text("sigma_px"), std::logic_error);
}

}  // namespace
}  // namespace pomona
