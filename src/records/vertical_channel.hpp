#pragma once

#include <Eigen/Core>
#include <string>

#include "records/campaign.hpp"

namespace twindeck::records {

/// Why a channel is not the vertical acceleration at a point, in words; empty where it is.
[[nodiscard]] std::string other_than_vertical_acceleration(const CampaignChannel& channel, const Eigen::Vector3d& point_m,
                                                           double tolerance_m);

}  // namespace twindeck::records
