#include "sensors/layout.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::sensors {

LayoutChannel channel_at(const LayoutPoint& point, const std::string& direction, const std::string& name) {
  LayoutChannel channel;
  channel.channel = name;
  channel.point = point.name;
  channel.direction = direction;
  channel.x_m = point.x_m;
  channel.cosines = direction == "vertical" ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : point.radial;
  return channel;
}

std::vector<std::string> setup_names(const std::vector<LayoutChannel>& all) {
  std::vector<std::string> names;
  for (const LayoutChannel& channel : all)
    if (!contains(names, channel.setup)) names.push_back(channel.setup);
  return names;
}

std::vector<LayoutChannel> channels_of(const std::vector<LayoutChannel>& all, const std::string& setup) {
  std::vector<LayoutChannel> of;
  std::copy_if(all.begin(), all.end(), std::back_inserter(of), [&](const LayoutChannel& c) { return c.setup == setup; });
  if (of.empty())
    throw InputError({"", 0, "setup"},
                     fmt::format("'{}' is not in the layout, which has {}", setup, fmt::join(setup_names(all), ", ")),
                     "name one of them");
  return of;
}

std::vector<int> nodes_at(const fe::Model& model, const std::vector<Eigen::Vector3d>& places, double tolerance_m) {
  std::vector<int> nodes;
  for (const Eigen::Vector3d& place : places) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      const double distance = (model.nodes[i].x_m - place).squaredNorm();
      if (distance < least) {
        least = distance;
        nearest = i;
      }
    }
    if (std::sqrt(least) > tolerance_m) {
      throw InputError({model.source, 0, "points"},
                       fmt::format("({:.2f}, {:.2f}, {:.2f}) m lies {:.2f} m from the nearest node, expected at most {:.2f} m",
                                   place.x(), place.y(), place.z(), std::sqrt(least), tolerance_m),
                       "check the point's coordinates against the model's axes");
    }
    nodes.push_back(static_cast<int>(nearest));
  }
  return nodes;
}

}  // namespace twindeck::sensors
