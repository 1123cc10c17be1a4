#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/atomic.hpp"
#include "records/record.hpp"

/// A writer of time series in universal files: the product reads them and writes none.
namespace twindeck::records {

inline std::string universal_line(const std::string& text) { return fmt::format("{:<80}\n", text.substr(0, 80)); }

/// Four values a line, E20.11.
inline std::string universal_values(const std::vector<double>& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += fmt::format("{:>20.11E}", values[i]);
    if (i % 4 == 3 || i + 1 == values.size()) text += '\n';
  }
  return text;
}

inline long universal_direction(const std::string& direction) {
  static const std::string names[] = {"x", "y", "z", "rx", "ry", "rz"};
  const bool minus = direction.starts_with('-');
  const std::string bare = minus || direction.starts_with('+') ? direction.substr(1) : direction;
  for (int i = 0; i < 6; ++i) {
    if (names[i] == bare) return minus ? -(i + 1) : i + 1;
  }
  return 0;
}

/// A time series as set 58 (text) or 58b (binary, little-endian): one channel after another.
/// @param samples (n_samples × n_channels)
inline void write_universal_series(const RecordInfo& info, const Eigen::MatrixXd& samples, bool binary,
                                   const std::filesystem::path& file) {
  TWINDECK_ASSERT(static_cast<Eigen::Index>(info.channels.size()) == samples.cols());
  constexpr const char* delimiter = "    -1\n";
  std::string text;
  for (Eigen::Index c = 0; c < samples.cols(); ++c) {
    const ChannelInfo& channel = info.channels[static_cast<std::size_t>(c)];
    text += delimiter;
    text += binary
                ? fmt::format("    58b{:>6}{:>6}{:>12}{:>12}{:>6}{:>6}{:>12}{:>12}\n", 1, 2, 11, 8 * samples.rows(), 0, 0, 0, 0)
                : std::string("    58\n");
    text += universal_line(channel.name) + universal_line("NONE") + universal_line("NONE") + universal_line("NONE") +
            universal_line("NONE");
    text += fmt::format("{:>5}{:>10}{:>5}{:>10} {:<10}{:>10}{:>4} {:<10}{:>10}{:>4}\n", 1, c + 1, 0, 0, "NONE",
                        channel.point.empty() ? "0" : channel.point, universal_direction(channel.direction), "NONE", 0, 0);
    text += fmt::format("{:>10}{:>10}{:>10}{:>13.5E}{:>13.5E}{:>13.5E}\n", 4, samples.rows(), 1, 0.0, 1.0 / info.rate_Hz, 0.0);
    const auto axis = [](int type, const std::string& label, const std::string& unit) {
      return fmt::format("{:>10}{:>5}{:>5}{:>5} {:<20} {:<20}\n", type, 0, 0, 0, label, unit);
    };
    text += axis(17, "Time", "s") + axis(12, "Response", channel.unit.empty() ? "NONE" : channel.unit) +
            axis(0, "NONE", "NONE") + axis(0, "NONE", "NONE");
    if (binary) {
      const Eigen::VectorXd column = samples.col(c);
      text.append(reinterpret_cast<const char*>(column.data()), static_cast<std::size_t>(column.size()) * sizeof(double));
      text += '\n';
    } else {
      text += universal_values(std::vector<double>(samples.col(c).begin(), samples.col(c).end()));
    }
    text += delimiter;
  }
  io::write_file_atomically(file, text);
}

}  // namespace twindeck::records
