#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace twindeck::records {

/// Sets 58 as the format's description has them, one a channel, written apart from the library's own writer: text of four
/// values of E20.12 a line, or binary in either order of bytes.
inline std::string universal_58(const Eigen::MatrixXd& samples, double rate_Hz, bool binary, bool big_endian = false) {
  std::string text;
  for (Eigen::Index c = 0; c < samples.cols(); ++c) {
    const Eigen::Index n = samples.rows();
    text += "    -1\n";
    text += binary ? fmt::format("    58b{:6d}{:6d}{:12d}{:12d}{:6d}{:6d}{:12d}{:12d}\n", big_endian ? 2 : 1, 2, 11, 8 * n, 0,
                                 0, 0, 0)
                   : fmt::format("    58{:74}\n", "");
    text += fmt::format("{:<80}\n", fmt::format("A{}", c + 1)) + "NONE\n23-Nov-26 10:00:00\nNONE\nNONE\n";
    text +=
        fmt::format("{:5d}{:10d}{:5d}{:10d} {:<10}{:10d}{:4d} {:<10}{:10d}{:4d}\n", 1, 0, 0, 0, "NONE", c + 1, 3, "NONE", 0, 0);
    text += fmt::format("{:10d}{:10d}{:10d}{:13.5E}{:13.5E}{:13.5E}\n", 4, n, 1, 0.0, 1.0 / rate_Hz, 0.0);
    text += fmt::format("{:10d}{:5d}{:5d}{:5d} {:<20} {:<20}\n", 17, 0, 0, 0, "Time", "s");
    text += fmt::format("{:10d}{:5d}{:5d}{:5d} {:<20} {:<20}\n", 12, 0, 0, 0, "Acceleration", "m/s^2");
    for (int axis = 0; axis < 2; ++axis)
      text += fmt::format("{:10d}{:5d}{:5d}{:5d} {:<20} {:<20}\n", 0, 0, 0, 0, "NONE", "NONE");
    for (Eigen::Index t = 0; t < n; ++t) {
      if (!binary) {
        text += fmt::format("{:20.12E}", samples(t, c)) + (t % 4 == 3 || t + 1 == n ? "\n" : "");
        continue;
      }
      auto bytes = std::bit_cast<std::array<char, 8>>(samples(t, c));
      if (big_endian) std::reverse(bytes.begin(), bytes.end());
      text.append(bytes.data(), bytes.size());
    }
    text += binary ? "\n    -1\n" : "    -1\n";
  }
  return text;
}

}  // namespace twindeck::records
