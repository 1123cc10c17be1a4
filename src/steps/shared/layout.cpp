#include "steps/shared/layout.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <set>

#include "core/error.hpp"
#include "io/csv.hpp"

namespace twindeck::steps {
namespace fs = std::filesystem;

std::vector<LayoutPoint> read_points(const fs::path& file) {
  const auto table = io::CsvTable::read(file, {"point", "line", "s_m", "x_m", "y_m", "z_m", "rx", "ry", "rz"});
  std::vector<LayoutPoint> points;
  std::set<std::string> names;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    LayoutPoint point{table.text(row, "point"),
                      table.text(row, "line"),
                      table.number(row, "s_m"),
                      {table.number(row, "x_m"), table.number(row, "y_m"), table.number(row, "z_m")},
                      {table.number(row, "rx"), table.number(row, "ry"), table.number(row, "rz")}};
    if (!names.insert(point.name).second) table.fail(row, "point", "'" + point.name + "' appears twice", "remove one row");
    if (std::abs(point.radial.norm() - 1.0) > 1e-6)
      table.fail(row, "rx", "is part of a direction that has not unit length", "give direction cosines");
    points.push_back(point);
  }
  return points;
}

LayoutChannel channel_at(const LayoutPoint& point, const std::string& direction, const std::string& name) {
  LayoutChannel channel;
  channel.channel = name;
  channel.point = point.name;
  channel.direction = direction;
  channel.x_m = point.x_m;
  channel.cosines = direction == "vertical" ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : point.radial;
  return channel;
}

std::vector<LayoutChannel> read_setups(const fs::path& file, const std::vector<LayoutPoint>& points) {
  const auto table = io::CsvTable::read(file, {"setup", "family", "channel", "point", "direction"});
  std::vector<std::string> known;
  for (const LayoutPoint& point : points) known.push_back(point.name);
  std::vector<LayoutChannel> channels;
  std::set<std::pair<std::string, std::string>> seen;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string point = table.text(row, "point"), direction = table.text(row, "direction"),
                      name = table.text(row, "channel");
    const auto at = std::find(known.begin(), known.end(), point);
    if (at == known.end())
      table.fail(row, "point", "'" + point + "' is no point" + did_you_mean(point, known), "add it to the points");
    if (direction != "vertical" && direction != "radial")
      table.fail(row, "direction", "is '" + direction + "', expected vertical or radial");
    if (!seen.emplace(table.text(row, "setup"), name).second)
      table.fail(row, "channel", "'" + name + "' appears twice in its setup", "number them");
    LayoutChannel channel = channel_at(points[static_cast<std::size_t>(at - known.begin())], direction, name);
    channel.setup = table.text(row, "setup");
    channel.family = table.text(row, "family");
    channels.push_back(channel);
  }
  return channels;
}

std::vector<std::string> setup_names(const std::vector<LayoutChannel>& all) {
  std::vector<std::string> names;
  for (const LayoutChannel& channel : all) {
    if (std::find(names.begin(), names.end(), channel.setup) == names.end()) names.push_back(channel.setup);
  }
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

}  // namespace twindeck::steps
