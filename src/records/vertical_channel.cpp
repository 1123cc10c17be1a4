#include "records/vertical_channel.hpp"

#include <fmt/format.h>

#include <cmath>

namespace twindeck::records {

namespace {

/// Least |dz| of a vertical channel: a tilt of 5 degrees, more than the slope of a deck. It reduces a vertical motion by 0.4 %.
constexpr double kLeastVertical = 0.9962;

}  // namespace

std::string other_than_vertical_acceleration(const CampaignChannel& channel, const Eigen::Vector3d& point_m,
                                             double tolerance_m) {
  if (channel.is_input) return "its role is input";
  if (channel.quantity != "acceleration") return "it is a " + channel.quantity;
  if (!channel.direction.allFinite()) return "its direction dx, dy, dz is not given";
  if (std::abs(channel.direction.z()) < kLeastVertical)
    return fmt::format("its direction is ({:.3g}, {:.3g}, {:.3g})", channel.direction.x(), channel.direction.y(),
                       channel.direction.z());
  const double distance = (channel.position_m - point_m).norm();
  if (distance > tolerance_m)  // false for a position that is not given (NaN)
    return fmt::format("it lies {:.3g} m from the point, expected at most {:.3g} m", distance, tolerance_m);
  return "";
}

}  // namespace twindeck::records
