#include "records/array_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "core/error.hpp"
#include "core/letters.hpp"
#include "records/take_clock.hpp"
#include "records/text_cells.hpp"

namespace twindeck::records {

using Eigen::Index;

namespace {

std::string bare(const std::string& name) {
  const std::size_t last = name.find_last_of("/.");
  return lower_case(name.substr(last == std::string::npos ? 0 : last + 1));
}

bool is_time(const std::string& name) {
  return is_one_of("|t|time|times|tempo|tiempo|zeit|time_vector|timevector|tvec|timestamp|timestamps|time_stamp|epoch|datenum|",
                   without_time_unit(bare(name)).first);
}

bool is_rate(const std::string& name) {  // "samplingrate", "sample_rate_hz"; "samples" tells how many there are
  return is_one_of("|fs|f_s|sf|sr|rate|sps|frequency|freq|fsamp|fs_hz|", name) ||
         (name.starts_with("samp") && !is_one_of("|sample|samples|sample_count|samplecount|", name));
}

bool is_step(const std::string& name) {
  return is_one_of(
      "|dt|ts|delta_t|deltat|step|time_step|timestep|sampling_interval|sampling_period|sampling_time|samplinginterval|"
      "samplingperiod|samplingtime|interval|increment|xincrement|wf_increment|",
      name);
}

}  // namespace

ArrayChoice choose_arrays(const std::vector<NamedArray>& arrays, const std::vector<std::string>& others,
                          const std::string& file) {
  ArrayChoice choice;
  double largest = 0.0;  // a damaged file may state sizes whose product exceeds whole numbers
  std::size_t best = 0;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const double size = static_cast<double>(arrays[i].rows) * static_cast<double>(arrays[i].columns);
    if (size == 1.0) choice.scalars.push_back(i);
    if (size > largest && !is_time(arrays[i].name)) {
      largest = size;
      best = i;
    }
  }
  if (largest < 16.0)
    throw InputError({file, 0, ""},
                     fmt::format("holds no array of numbers of sixteen values or more{}{}", others.empty() ? "" : ": ",
                                 fmt::join(others, ", ")),
                     "store the samples of each measurement as a two-dimensional array of real numbers, samples x channels");
  const Index samples = arrays[best].longer();
  if (arrays[best].shorter() > 1) {
    choice.data = {best};
    choice.transposed = arrays[best].columns > arrays[best].rows;
    for (std::size_t i = 0; i < arrays.size(); ++i)
      if (i != best && arrays[i].shorter() > 1 && arrays[i].longer() == samples) choice.left_out.push_back(i);
  } else {
    for (std::size_t i = 0; i < arrays.size(); ++i)
      if (arrays[i].shorter() == 1 && arrays[i].longer() == samples && !is_time(arrays[i].name)) choice.data.push_back(i);
  }
  for (std::size_t i = 0; i < arrays.size(); ++i)
    if (arrays[i].shorter() == 1 && arrays[i].longer() == samples && is_time(arrays[i].name)) choice.time = static_cast<int>(i);
  return choice;
}

void list_channels(const std::vector<NamedArray>& arrays, const ArrayChoice& choice, RecordInfo& info) {
  const NamedArray& first = arrays[choice.data.front()];
  const bool matrix = choice.is_matrix();
  const Index channels = choice.channels(arrays);
  info.names_channels = info.has_header = !matrix;
  for (const std::size_t at : choice.left_out)
    info.notes.push_back(fmt::format("'{}' has as many samples, left out", arrays[at].name));
  for (Index c = 0; c < channels; ++c) {
    ChannelInfo channel;
    channel.samples = first.longer();
    channel.position = c + 1;
    channel.name =
        channels > 1 && matrix ? "column " + std::to_string(c + 1) : arrays[choice.data[static_cast<std::size_t>(c)]].name;
    if (const std::size_t last = channel.name.find_last_of("/."); !matrix && last != std::string::npos)
      channel.other_names = {channel.name.substr(last + 1)};
    info.channels.push_back(channel);
  }
}

void name_channels(const std::vector<std::string>& texts, Index columns, RecordInfo& info) {
  const bool with_time = std::ssize(texts) == columns;
  if (std::ssize(texts) != std::ssize(info.channels) && !with_time) return;
  for (std::size_t c = 0; c < info.channels.size(); ++c)
    info.channels[c].name = texts[with_time ? static_cast<std::size_t>(info.channels[c].position) - 1 : c];
  info.names_channels = info.has_header = true;
}

double rate_of(const std::string& name, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 0.0;
  if (bare(name) == "t_s") return 1.0 / value;
  const auto [text, unit] = without_time_unit(bare(name));
  if (is_step(text)) return 1.0 / (value * (unit > 0.0 ? unit : StampedRows::likely_unit_s(value)));
  return is_rate(bare(name)) ? value : 0.0;
}

void read_rates(const std::vector<NamedArray>& arrays, const ArrayChoice& choice,
                const std::function<Eigen::VectorXd(std::size_t)>& values_of, RecordInfo& info) {
  if (choice.time >= 0) {
    const auto at = static_cast<std::size_t>(choice.time);
    StampedRows stamps;
    const Eigen::VectorXd times = values_of(at);
    for (const double time : times) stamps.add(time);
    take_clock(stamps, without_time_unit(arrays[at].name).second, "'" + arrays[at].name + "'", info);
  }
  for (const std::size_t at : choice.scalars)
    take_stated_rate(rate_of(arrays[at].name, values_of(at)[0]), "'" + arrays[at].name + "'", info);
}

}  // namespace twindeck::records
