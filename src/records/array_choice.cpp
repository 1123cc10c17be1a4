#include "records/array_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/error.hpp"
#include "io/letters.hpp"

namespace twindeck::records {

using Eigen::Index;

namespace {

std::string bare(const std::string& name) {
  const std::size_t last = name.find_last_of("/.");
  return io::lower_case(name.substr(last == std::string::npos ? 0 : last + 1));
}

template <std::size_t n>
bool is_one_of(const std::array<std::string_view, n>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_time(const std::string& name) {
  static constexpr std::array<std::string_view, 9> names = {"t",    "time",        "times",      "time_s", "tempo",
                                                            "zeit", "time_vector", "timevector", "tvec"};
  return is_one_of(names, bare(name));
}

bool is_rate(const std::string& name) {
  static constexpr std::array<std::string_view, 10> names = {"fs",  "f_s",       "sf",   "sr",    "rate",
                                                             "sps", "frequency", "freq", "fsamp", "fs_hz"};
  static constexpr std::array<std::string_view, 4> counts = {"sample", "samples", "sample_count",
                                                             "samplecount"};                // how many there are
  return is_one_of(names, name) || (name.starts_with("samp") && !is_one_of(counts, name));  // "samplingrate", "sample_rate_hz"
}

bool is_step(const std::string& name) {
  static constexpr std::array<std::string_view, 17> names = {"dt",
                                                             "ts",
                                                             "t_s",
                                                             "delta_t",
                                                             "deltat",
                                                             "step",
                                                             "time_step",
                                                             "timestep",
                                                             "sampling_interval",
                                                             "sampling_period",
                                                             "sampling_time",
                                                             "samplinginterval",
                                                             "samplingperiod",
                                                             "samplingtime",
                                                             "interval",
                                                             "xincrement",
                                                             "wf_increment"};
  return is_one_of(names, name);
}

}  // namespace

ArrayChoice choose_arrays(const std::vector<NamedArray>& arrays, const std::vector<std::string>& others,
                          const std::string& file) {
  ArrayChoice choice;
  double largest = 0.0;  // a damaged file may say sizes whose product is beyond whole numbers
  std::size_t best = 0;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const double size = static_cast<double>(arrays[i].rows) * static_cast<double>(arrays[i].columns);
    if (size == 1.0) choice.scalars.push_back(i);
    if (size > largest && !is_time(arrays[i].name)) {
      largest = size;
      best = i;
    }
  }
  if (largest < 16.0) {
    throw InputError({file, 0, ""},
                     fmt::format("holds no array of numbers of sixteen values or more{}{}", others.empty() ? "" : ": ",
                                 fmt::join(others, ", ")),
                     "store the samples of each measurement as a two-dimensional array of real numbers, samples x channels");
  }
  const Index samples = arrays[best].longer();
  if (arrays[best].shorter() > 1) {
    choice.data = {best};
    choice.transposed = arrays[best].columns > arrays[best].rows;
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      if (i != best && arrays[i].shorter() > 1 && arrays[i].longer() == samples) choice.left_out.push_back(i);
    }
  } else {
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      if (arrays[i].shorter() == 1 && arrays[i].longer() == samples && !is_time(arrays[i].name)) choice.data.push_back(i);
    }
  }
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    if (arrays[i].shorter() == 1 && arrays[i].longer() == samples && is_time(arrays[i].name)) choice.time = static_cast<int>(i);
  }
  return choice;
}

void list_channels(const std::vector<NamedArray>& arrays, const ArrayChoice& choice, RecordInfo& info) {
  const NamedArray& first = arrays[choice.data.front()];
  const bool matrix = choice.data.size() == 1;
  const Index channels = matrix ? first.shorter() : std::ssize(choice.data);
  info.names_channels = info.has_header = !matrix;
  for (const std::size_t at : choice.left_out)
    info.notes.push_back(fmt::format("'{}' has as many samples, left out", arrays[at].name));
  for (Index c = 0; c < channels; ++c) {
    ChannelInfo channel;
    channel.samples = first.longer();
    channel.position = c + 1;
    channel.name =
        channels > 1 && matrix ? "column " + std::to_string(c + 1) : arrays[choice.data[static_cast<std::size_t>(c)]].name;
    info.channels.push_back(channel);
  }
}

void name_channels(const std::vector<std::string>& texts, Index columns, RecordInfo& info) {
  const bool with_time = std::ssize(texts) == columns && columns == std::ssize(info.channels) + 1;
  if (std::ssize(texts) != std::ssize(info.channels) && !with_time) return;
  for (std::size_t c = 0; c < info.channels.size(); ++c) info.channels[c].name = texts[c + (with_time ? 1 : 0)];
  info.names_channels = info.has_header = true;
}

double rate_of(const std::string& name, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 0.0;
  const std::string text = bare(name);
  if (is_step(text)) return 1.0 / value;
  return is_rate(text) ? value : 0.0;
}

}  // namespace twindeck::records
