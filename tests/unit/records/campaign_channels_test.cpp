// Which channel is the vertical acceleration at a point. Oracle: by definition; cos 5 degrees is 0.9962.
#include "records/campaign_channels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace twindeck::records {
namespace {

CampaignChannel vertical() {
  CampaignChannel channel;
  channel.name = "M1";
  channel.direction = Eigen::Vector3d::UnitZ();
  return channel;
}

std::string why(const CampaignChannel& channel) {
  return other_than_vertical_acceleration(channel, Eigen::Vector3d(1.0, 2.0, 3.0), 0.5);
}

TEST(VerticalChannel, UpDownAndALittleTiltedAreVertical) {
  EXPECT_EQ(why(vertical()), "");
  CampaignChannel down = vertical();
  down.direction *= -1.0;
  EXPECT_EQ(why(down), "");
  const auto tilted = [](double degrees) {
    CampaignChannel channel = vertical();
    const double angle = degrees / 180.0 * std::numbers::pi;
    channel.direction = Eigen::Vector3d(std::sin(angle), 0.0, std::cos(angle));
    return channel;
  };
  EXPECT_EQ(why(tilted(4.9)), "");
  EXPECT_NE(why(tilted(5.1)), "");
}

TEST(VerticalChannel, WhatItIsElseIsSaid) {
  CampaignChannel channel = vertical();
  channel.is_input = true;
  EXPECT_EQ(why(channel), "its role is input");
  channel = vertical();
  channel.quantity = "velocity";
  EXPECT_EQ(why(channel), "it is a velocity");
  channel = vertical();
  channel.direction.setConstant(std::nan(""));
  EXPECT_EQ(why(channel), "its direction dx, dy, dz is not given");
  channel = vertical();
  channel.position_m = Eigen::Vector3d(1.0, 2.0, 3.6);
  EXPECT_EQ(why(channel), "it lies 0.6 m from the point, expected at most 0.5 m");
  channel.position_m.z() = 3.4;
  EXPECT_EQ(why(channel), "");
}

}  // namespace
}  // namespace twindeck::records
