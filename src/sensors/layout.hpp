#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fe/model.hpp"
#include "identification/clustering.hpp"

/// Where sensors may stand and how setups place them: data of a study, shared by the campaign and the search for layouts.
namespace twindeck::sensors {

/// A row of points.csv (`point,line,s_m,x_m,y_m,z_m,rx,ry,rz`): a point on a line such as "foot_inner", at the distance s_m
/// along it. `radial` (rx,ry,rz) [-] is the unit vector in the horizontal direction across the line.
struct LayoutPoint {
  std::string name, line;
  double s_m = 0.0;
  Eigen::Vector3d x_m = Eigen::Vector3d::Zero(), radial = Eigen::Vector3d::Zero();
};

/// A row of setups.csv (`setup,family,channel,point,direction`), with the place and the direction cosines [-] of its channel.
struct LayoutChannel {
  std::string setup, family, channel, point, direction;  ///< direction: vertical (z) or radial
  Eigen::Vector3d x_m = Eigen::Vector3d::Zero(), cosines = Eigen::Vector3d::Zero();
};

/// Channel at a point. @param direction  "vertical" (z); any other is taken as radial
[[nodiscard]] LayoutChannel channel_at(const LayoutPoint& point, const std::string& direction, const std::string& name);
/// Channels of one setup, in the order of the file. @throws InputError  if there is none; the message names the setups
[[nodiscard]] std::vector<LayoutChannel> channels_of(const std::vector<LayoutChannel>& all, const std::string& setup);
/// Names of the setups in the order of the file.
[[nodiscard]] std::vector<std::string> setup_names(const std::vector<LayoutChannel>& all);

/// Nearest node of the model to each place, (n_places). @throws InputError  if it is further away than `tolerance_m`
[[nodiscard]] std::vector<int> nodes_at(const fe::Model& model, const std::vector<Eigen::Vector3d>& places, double tolerance_m);

/// How setups are scored, searched for and tested blindly; the step's configuration has a sentence for each value.
struct LayoutSettings {
  long n_modes = 10, channels = 16, draws = 500, free_setups = 2;
  double tolerance_m = 0.5;               ///< from a point to its node
  std::vector<std::string> blind_setups;  ///< empty: no blind test
  double duration_s = 8000.0, rate_Hz = 64.0, damping_ratio = 0.01, warm_up_s = 200.0;
  long downsample = 8, frames = 10, minimum_order = 10, maximum_order = 20, order_step = 2, block_rows = 30,
       welch_segment = 1024;
  identification::StabilisationCriteria criteria;
  identification::CleaningRule cleaning{0.95, 0.02, 5.0, 0.0};
};

}  // namespace twindeck::sensors
