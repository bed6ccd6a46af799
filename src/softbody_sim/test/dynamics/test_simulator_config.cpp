#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "softbody_common/target_limits.h"
#include "softbody_sim/dynamics/simulator_config.h"

namespace softbody {
namespace {

TEST(SimulatorConfig, ReadsItsParametersAndNamesWhatIsOutOfRange) {
  Parameters good(YAML::Load("{simulate: false, iterations: 7, gravity_m_s2: [0, 9.81, 0]}"), "/simulator/");
  const SimulatorConfig config = readSimulatorConfig(good);
  EXPECT_FALSE(config.simulate);
  EXPECT_EQ(config.iterations, 7);
  EXPECT_EQ(config.gravity.y(), 9.81);
  EXPECT_TRUE(good.unknown().empty());
  Parameters bad(YAML::Load("{iterations: 0}"), "/simulator/");
  try {
    readSimulatorConfig(bad);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("/simulator/iterations is 0"), std::string::npos)
        << error.what();
  }
}

TEST(SimulatorConfig, LeavesRoomForTheTrackersHeaviestTargets) {
  for (const bool single : {false, true}) {
    SimulatorConfig config;
    config.single_precision = single;
    config.target_stiffness = largestStiffness(config) / kLargestTargetWeight;
    EXPECT_NO_THROW(requireConsistent(config));
    config.target_stiffness *= 1.01;
    EXPECT_THROW(requireConsistent(config), std::invalid_argument);
  }
}

}  // namespace
}  // namespace softbody
