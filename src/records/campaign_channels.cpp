#include "records/campaign_channels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/csv.hpp"
#include "io/path_name.hpp"
#include "records/recorded_unit.hpp"

namespace twindeck::records {
namespace {

/// [-] Direction cosines may differ from length 1 by this rounding, as in the other tables of channels.
constexpr double kLengthTolerance = 0.02;

/// Least |dz| of a vertical channel: a tilt of 5 degrees, more than the slope of a deck. It reduces a vertical motion by 0.4 %.
constexpr double kLeastVertical = 0.9962;

std::string one_of(const io::CsvTable& table, std::size_t row, const std::string& column,
                   const std::vector<std::string>& allowed) {
  const std::string text = table.text(row, column).empty() ? allowed.front() : table.text(row, column);
  if (!contains(allowed, text))
    table.fail(row, column, fmt::format("is '{}', expected {}{}", text, fmt::join(allowed, ", "), did_you_mean(text, allowed)));
  return text;
}

void read_place(const io::CsvTable& table, std::size_t row, CampaignChannel& channel) {
  int given = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const char* const cosine = std::array{"dx", "dy", "dz"}[axis];
    channel.position_m[k] = table.number_or(row, std::array{"x_m", "y_m", "z_m"}[axis], channel.position_m[k]);
    channel.direction[k] = table.number_or(row, cosine, channel.direction[k]);
    given += table.number_if(row, cosine) ? 1 : 0;
  }
  if (given == 3 && channel.direction.norm() == 0.0)
    table.fail(row, "dx", "dx, dy, dz are all 0: a channel measures along some direction",
               "give its direction cosines, for example 0,0,1 for upwards, or leave the three cells empty");
  if (const double length = channel.direction.norm(); given == 3 && std::abs(length - 1.0) > kLengthTolerance)
    table.fail(row, "dx", fmt::format("direction cosines have length {:.3f}, expected 1", length), "give a unit vector");
  if (given == 1 || given == 2)
    table.fail(row, "dx",
               fmt::format("{} of the direction cosines dx, dy, dz {} given, expected three or none", given,
                           given == 1 ? "is" : "are"),
               "write 0 where the channel does not measure");
}

/// @return true for volts and counts whose gain is 1, so that nothing turns them into SI units
bool check_unit(const io::CsvTable& table, std::size_t row, const CampaignChannel& channel) {
  const std::string usual =
      fmt::format("usual are {}; V or counts for what is not calibrated", fmt::join(records::units_of(channel.quantity), ", "));
  if (channel.unit.empty()) table.fail(row, "unit", "is empty, expected the unit of the recorded numbers", usual);
  const auto known = records::recorded_unit(channel.unit);
  if (!known) table.fail(row, "unit", fmt::format("is '{}', which is no unit of a record", channel.unit), usual);
  if (known->si_factor == 0.0) return channel.gain == 1.0;
  if (known->quantity != channel.quantity)
    table.fail(
        row, "unit",
        fmt::format("is '{}', a unit of {}, but the channel's quantity is {}", channel.unit, known->quantity, channel.quantity),
        "correct one of the two");
  const double ratio = std::abs(channel.gain) / known->si_factor;
  if (ratio > kLargestCalibration || ratio < 1.0 / kLargestCalibration)
    table.fail(row, "gain",
               fmt::format("is {:.6g}, but the unit is '{}': recorded numbers in it take {:.6g} to SI units", channel.gain,
                           channel.unit, known->si_factor),
               "the gain alone converts: correct it, or the unit of the recorded numbers");
  return false;
}

}  // namespace

std::vector<CampaignChannel> read_campaign_channels(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  const auto table = io::CsvTable::read(
      file, {"channel"}, {"point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "gain", "reference", "role"});
  std::vector<CampaignChannel> channels;
  std::set<std::string> names;
  std::vector<std::string> without_scale;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    CampaignChannel channel;
    channel.name = table.text(row, "channel");
    io::check_inner_name(channel.name, "channel", {file.string(), table.line(row), "channel"});
    if (!names.insert(channel.name).second)
      table.fail(row, "channel", fmt::format("'{}' appears twice", channel.name), "remove one row");
    channel.point = table.text(row, "point").empty() ? channel.name : table.text(row, "point");
    read_place(table, row, channel);
    channel.is_input = one_of(table, row, "role", {"response", "input"}) == "input";
    std::vector<std::string> quantities = {"acceleration", "velocity", "displacement"};
    if (channel.is_input) quantities.emplace_back("force");
    channel.quantity = one_of(table, row, "quantity", quantities);
    channel.unit = table.text(row, "unit");
    channel.gain = table.number_or(row, "gain", 1.0);
    if (channel.gain == 0.0)
      table.fail(row, "gain", "is 0, expected the factor from recorded to physical values", "leave it empty for 1");
    const double reference = table.number_or(row, "reference", 0.0);
    if (reference != 0.0 && reference != 1.0)
      table.fail(row, "reference", fmt::format("is {:.6g}, expected 0 or 1", reference),
                 "mark a channel that stays in place by 1");
    channel.reference = reference == 1.0;
    if (check_unit(table, row, channel)) without_scale.push_back(fmt::format("{} in {}", channel.name, channel.unit));
    channels.push_back(channel);
  }
  if (!without_scale.empty())
    warnings.push_back(
        fmt::format("{}: recorded with gain 1 and no unit of motion: {}. Frequencies and damping need no scale, but shapes "
                    "need the same for all channels, and RMS values and spectra are not in SI units",
                    file.string(), fmt::join(without_scale, ", ")));
  return channels;
}

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
