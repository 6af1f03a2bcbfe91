#include "pomona/plugin_host.h"

#include <gtest/gtest.h>

namespace pomona {
namespace {

const std::string kFolder = POMONA_TEST_PLUGINS;

TEST(LoadedPlugin, DeclaresItself) {
  LoadedPlugin plugin(kFolder + "/middle.so");
  EXPECT_EQ(plugin.name(), "middle");
  EXPECT_EQ(plugin.parameters().size(), 5u);
}

}  // namespace
}  // namespace pomona
