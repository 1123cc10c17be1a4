#include "steps/layout/layout_files.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/csv.hpp"

namespace twindeck::steps {

namespace {

constexpr double kSamePlace_m = 1e-3;    // sensors are wider than this
constexpr double kSameDirection = 1e-6;  // [-] what direction cosines are given to

/// Whether two channels of a setup measure the same motion, so that the second one adds nothing.
bool same_measurement(const sensors::LayoutChannel& a, const sensors::LayoutChannel& b) {
  return a.setup == b.setup && (a.x_m - b.x_m).norm() < kSamePlace_m &&
         std::abs(a.cosines.dot(b.cosines)) > 1.0 - kSameDirection;
}

}  // namespace

std::vector<sensors::LayoutPoint> read_points(const std::filesystem::path& file) {
  const auto table = io::CsvTable::read(file, {"point", "line", "s_m", "x_m", "y_m", "z_m", "rx", "ry", "rz"});
  std::vector<sensors::LayoutPoint> points;
  std::set<std::string> names;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    sensors::LayoutPoint point{table.text(row, "point"),
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

std::vector<sensors::LayoutChannel> read_setups(const std::filesystem::path& file,
                                                const std::vector<sensors::LayoutPoint>& points) {
  const auto table = io::CsvTable::read(file, {"setup", "family", "channel", "point", "direction"});
  std::vector<std::string> known = each_of(points, &sensors::LayoutPoint::name);
  std::vector<sensors::LayoutChannel> channels;
  std::set<std::pair<std::string, std::string>> seen;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string point = table.text(row, "point"), direction = table.text(row, "direction"),
                      name = table.text(row, "channel");
    const auto at = std::ranges::find(known, point);
    if (at == known.end())
      table.fail(row, "point", "'" + point + "' is no point" + did_you_mean(point, known), "add it to the points");
    if (direction != "vertical" && direction != "radial")
      table.fail(row, "direction", "is '" + direction + "', expected vertical or radial");
    if (!seen.emplace(table.text(row, "setup"), name).second)
      table.fail(row, "channel", "'" + name + "' appears twice in its setup", "number them");
    sensors::LayoutChannel channel = sensors::channel_at(points[static_cast<std::size_t>(at - known.begin())], direction, name);
    channel.setup = table.text(row, "setup");
    channel.family = table.text(row, "family");
    const auto other =
        std::ranges::find_if(channels, [&](const sensors::LayoutChannel& c) { return same_measurement(c, channel); });
    if (other != channels.end())
      table.fail(row, "point",
                 "'" + name + "' stands at the place and in the direction of '" + other->channel + "' of its setup",
                 "remove one, or move it");
    channels.push_back(channel);
  }
  return channels;
}

}  // namespace twindeck::steps
