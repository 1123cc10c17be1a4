#include "records/frequency_responses.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "records/column_match.hpp"
#include "records/scan_universal.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;
using Functions = std::vector<UniversalFunction>;

namespace {

std::string function_name(int type) {
  static const auto names = std::to_array<const char*>(
      {"a function of unknown type", "a time series", "an auto-spectrum", "a cross-spectrum", "a frequency response function",
       "a transmissibility", "a coherence", "an auto-correlation", "a cross-correlation", "a power spectral density",
       "an energy spectral density", "a probability density", "a spectrum"});
  return type >= 0 && type < std::ssize(names) ? names[static_cast<std::size_t>(type)]
                                               : fmt::format("a function of type {}", type);
}

bool is_coherence(const UniversalFunction& function) {
  constexpr int partial = 21, multiple = 26;  // types of coherence beside the ordinary one
  return function.function == kCoherence || function.function == partial || function.function == multiple;
}

const char* quantity_of(int code) {
  return code == kAccelerationData   ? "acceleration"
         : code == kVelocityData     ? "velocity"
         : code == kDisplacementData ? "displacement"
                                     : "";
}

/// How many times the displacement is differentiated.
int derivatives_of(const std::string& quantity) { return quantity == "acceleration" ? 2 : quantity == "velocity" ? 1 : 0; }

/// Points of both sides of a test, in the order of the files.
struct Sides {
  std::vector<std::string> responses, references;
  [[nodiscard]] bool hammer_roves() const { return references.size() > responses.size(); }
  /// What the points of the other side are.
  [[nodiscard]] const char* other_role() const { return hammer_roves() ? "response" : "reference"; }
  void add(const UniversalFunction& function) {
    if (!contains(responses, function.response)) responses.push_back(function.response);
    if (!contains(references, function.reference)) references.push_back(function.reference);
  }
};

const std::string& shape_point(const UniversalFunction& function, const Sides& sides) {
  return sides.hammer_roves() ? function.reference : function.response;
}
const std::string& other_point(const UniversalFunction& function, const Sides& sides) {
  return sides.hammer_roves() ? function.response : function.reference;
}

/// Refuses a function by its number and line.
struct FunctionRefusal {
  const UniversalFunction& function;
  const fs::path& file;
  [[noreturn]] void operator()(const std::string& problem, const std::string& mend) const {
    throw InputError({file.string(), function.line, fmt::format("set 58 number {}", function.number)}, problem, mend);
  }
};

/// Refuses a function that is no frequency response function of motion over force in complex values against Hz.
void check_function(const UniversalFunction& function, const fs::path& file) {
  const FunctionRefusal refuse{function, file};
  if (function.function != kFrequencyResponse)
    refuse("is " + function_name(function.function) + ", expected frequency response functions (type 4)",
           "export the frequency response functions alone, with their coherences if you like");
  if (!function.complex)
    refuse("has real values, an amplitude without phase, expected complex values (data of type 5 or 6)",
           "export the frequency response functions as real and imaginary part");
  if (function.abscissa != kFrequencyData && function.abscissa != 0)
    refuse(fmt::format("has an abscissa of data type {}, expected 18 (frequency in Hz)", function.abscissa),
           "export it against frequency");
  if (function.abscissa_unit.find("rad") != std::string::npos || function.abscissa_unit.find("RPM") != std::string::npos)
    refuse("has an abscissa in " + function.abscissa_unit + ", expected Hz", "export it against Hz");
  if (function.response.empty())
    refuse("names no response node, expected node and direction in columns 42 to 55 of record 6",
           "export it with the numbers of its nodes");
  if (function.reference.empty())
    refuse("names no reference node, expected node and direction of the force in columns 67 to 80 of record 6",
           "export it with the numbers of its nodes");
  constexpr int general = 1;  // as good as unknown
  const bool is_motion = function.quantity == 0 || function.quantity == general || *quantity_of(function.quantity) != '\0';
  const bool is_force =
      function.over == 0 || function.over == general || function.over == kForceData || function.over == kReactionForceData;
  if (!is_motion || !is_force)
    refuse(fmt::format("is data of type {} over data of type {}, expected acceleration (12), velocity (11) or "
                       "displacement (8) over force (13)",
                       function.quantity, function.over),
           "export functions of motion over force, or correct records 9 and 10");
}

/// Positions and values of the lines above 0 Hz are compared with those of the first function.
void check_lines(const UniversalFunction& function, const Eigen::VectorXd& frequency_Hz, const fs::path& file) {
  constexpr double same = 1e-5;  // of the band: a start and a step of six digits
  const FunctionRefusal refuse{function, file};
  const Eigen::VectorXd& at = function.at;
  for (Index k = 1; k < at.size(); ++k)
    if (!(at[k] > at[k - 1]))
      refuse(fmt::format("has {:.6g} Hz after {:.6g} Hz, expected ascending frequencies", at[k], at[k - 1]), "export it anew");
  const double band = frequency_Hz[frequency_Hz.size() - 1] - frequency_Hz[0];
  if (at.size() != frequency_Hz.size() || (at - frequency_Hz).cwiseAbs().maxCoeff() > same * band)
    refuse(
        fmt::format("has {} lines from {:.6g} to {:.6g} Hz, but the first function has {} from {:.6g} to {:.6g} Hz", at.size(),
                    at[0], at[at.size() - 1], frequency_Hz.size(), frequency_Hz[0], frequency_Hz[frequency_Hz.size() - 1]),
        "export all functions of a setup with the same lines, or give them setups of their own");
  for (std::size_t k = 0; k < function.ordinate.size(); ++k)
    if (!std::isfinite(std::abs(function.ordinate[k])) && at[static_cast<Index>(k)] > 0.0)
      refuse(fmt::format("has a value that is no number at {:.6g} Hz", at[static_cast<Index>(k)]),
             "export a band without that line, or measure it again");
}

/// A file of a setup, with the frequency response functions in it.
struct ResponseFile {
  const CampaignRecord& record;
  Functions functions;
};

Functions functions_of(const fs::path& file, std::vector<std::string>& notes) {
  if (!is_universal_file(file))
    throw InputError({file.string(), 0, ""}, "is no universal file, expected frequency response functions in sets 58",
                     "export them as universal file, or write the kind of the record if it holds time series");
  RecordInfo info;
  UniversalData data = scan_universal_sets(
      file, [](Index, Index, const Eigen::MatrixXd&) {}, info, true);
  if (!info.channels.empty())
    throw InputError(
        {file.string(), 0, ""},
        fmt::format("holds {} time series beside frequency response functions, expected one of the two", info.channels.size()),
        "export the frequency response functions to a file of their own");
  const auto coherences = std::erase_if(data.functions, is_coherence);
  if (coherences > 0)
    notes.push_back(fmt::format("{}: {} coherences are left out; the standard deviations are those of the residuals",
                                file.string(), coherences));
  if (data.functions.empty())
    throw InputError({file.string(), 0, ""}, "holds no frequency response function (set 58 of function type 4)",
                     "export them, or give the file that has them");
  for (const UniversalFunction& function : data.functions) check_function(function, file);
  for (const std::string& note : info.notes) notes.push_back(file.string() + ": " + note);
  return std::move(data.functions);
}

/// The points of the shape in one file, as match_columns reads channels.
RecordInfo points_as_channels(const Functions& functions, const Sides& sides) {
  RecordInfo info;
  info.names_channels = true;
  for (const UniversalFunction& function : functions) {
    const std::string& name = shape_point(function, sides);
    if (std::ranges::find(info.channels, name, &ChannelInfo::name) != info.channels.end()) continue;
    ChannelInfo& channel = info.channels.emplace_back();
    channel.name = name;
    channel.samples = function.lines;
    channel.position = std::ssize(info.channels);
    channel.unit = sides.hammer_roves() ? "" : function.unit;
  }
  return info;
}

/// Quantity of a function: what the file says, else what channels.csv says of the channel. @throws InputError  if both say
/// something else
std::string settled_quantity(const UniversalFunction& function, const CampaignChannel& channel, const CampaignRecord& record,
                             bool hammer_roves) {
  const std::string stated = quantity_of(function.quantity);
  if (stated.empty()) return channel.quantity;
  if (!hammer_roves && stated != channel.quantity && record.unit_from != "file")
    throw InputError({record.file.string(), function.line, channel.name},
                     fmt::format("is {} over force, but channels.csv has the quantity {}", stated, channel.quantity),
                     "correct `quantity`, `unit` and `gain` in channels.csv");
  return stated;
}

/// Puts the functions of one file into their columns.
void place_functions(const Campaign& campaign, const ResponseFile& file, const Sides& sides, FrequencyResponses& all,
                     std::vector<bool>& filled) {
  const RecordInfo info = points_as_channels(file.functions, sides);
  const ColumnMatch match = match_columns(info, file.record.channels, file.record.columns, file.record.file);
  if (!match.warning.empty()) all.notes.push_back(match.warning);
  const auto n_others = std::ssize(all.others);
  for (std::size_t c = 0; c < match.columns.size(); ++c) {
    const ChannelInfo& point = info.channels[static_cast<std::size_t>(match.columns[c])];
    const CampaignChannel& channel = campaign.channel(file.record.channels[c]);
    const double gain = gain_of(campaign, file.record, c, point.unit, all.notes);
    const Index row = std::ranges::find(all.channels, channel.name) - all.channels.begin();
    for (const UniversalFunction& function : file.functions) {
      if (shape_point(function, sides) != point.name) continue;
      const Index other = std::ranges::find(all.others, other_point(function, sides)) - all.others.begin();
      const Index column = row * n_others + other;
      if (filled[static_cast<std::size_t>(column)])
        throw InputError(
            {file.record.file.string(), function.line, channel.name},
            fmt::format("is there twice for {} {}", sides.other_role(), all.others[static_cast<std::size_t>(other)]),
            "keep one of the two, or give the second a condition or setup of its own");
      filled[static_cast<std::size_t>(column)] = true;
      const std::string quantity = settled_quantity(function, channel, file.record, sides.hammer_roves());
      if (all.quantity.empty()) all.quantity = quantity;
      const int order = derivatives_of(all.quantity) - derivatives_of(quantity);
      const Index skipped = std::ssize(function.ordinate) - all.frequency_Hz.size();
      for (Index k = 0; k < all.frequency_Hz.size(); ++k) {
        const std::complex<double> s(0.0, 2.0 * std::numbers::pi * all.frequency_Hz[k]);
        all.values(k, column) = gain * std::pow(s, order) * function.ordinate[static_cast<std::size_t>(skipped + k)];
      }
      if (all.values.col(column).isZero(0.0))
        throw InputError({file.record.file.string(), function.line, channel.name}, "is 0 at all lines",
                         "leave the channel out of `channels`, or measure it again");
    }
  }
}

/// Channels of all records, in their order. @throws InputError  for an input
std::vector<std::string> shape_channels(const Campaign& campaign, const RecordGroup& group) {
  std::vector<std::string> channels;
  for (const CampaignRecord& record : group.records) {
    for (const std::string& name : record.channels) {
      if (campaign.channel(name).is_input)
        throw InputError({(campaign.folder / "channels.csv").string(), 0, name},
                         "has the role input, but is a point of the shape: a roving hammer shows the shape at its own points",
                         "write the role response and the quantity of the sensor that stayed");
      if (!contains(channels, name)) channels.push_back(name);
    }
  }
  return channels;
}

}  // namespace

FrequencyResponses read_frequency_responses(const Campaign& campaign, const RecordGroup& group) {
  FrequencyResponses all;
  std::vector<ResponseFile> files;
  Sides sides;
  for (const CampaignRecord& record : group.records) {
    files.push_back({record, functions_of(record.file, all.notes)});
    for (const UniversalFunction& function : files.back().functions) {
      check_lines(function, files.front().functions.front().at, record.file);
      sides.add(function);
    }
  }
  const Eigen::VectorXd& at = files.front().functions.front().at;
  const Index above_zero = (at.array() > 0.0).count();
  all.frequency_Hz = at.tail(above_zero);  // a modal model has no value for a displacement at 0 Hz
  all.channels = shape_channels(campaign, group);
  all.others = sides.hammer_roves() ? sides.responses : sides.references;
  const auto columns = std::ssize(all.channels) * std::ssize(all.others);
  all.values.resize(above_zero, columns);
  std::vector<bool> filled(static_cast<std::size_t>(columns), false);
  for (const ResponseFile& file : files) place_functions(campaign, file, sides, all, filled);
  if (const auto gap = std::ranges::find(filled, false); gap != filled.end()) {
    const auto k = static_cast<std::size_t>(gap - filled.begin());
    throw InputError({group.records.front().file.string(), 0, all.channels[k / all.others.size()]},
                     fmt::format("of setup {} has no function for {} {}, expected each pair of channel and {}", group.setup,
                                 sides.other_role(), all.others[k % all.others.size()], sides.other_role()),
                     "add the function, leave the channel out of `channels`, or make a setup of the complete pairs");
  }
  if (sides.hammer_roves())
    all.notes.push_back(
        fmt::format("setup {}: the hammer roved over {} points; by reciprocity the shapes are those of its points", group.setup,
                    sides.references.size()));
  return all;
}

void list_response_points(const Functions& functions, RecordInfo& info) {
  Sides sides;
  Functions responses;
  for (const UniversalFunction& function : functions) {
    if (function.function != kFrequencyResponse || !info.channels.empty()) continue;
    responses.push_back(function);
    sides.add(function);
  }
  if (const std::size_t left = functions.size() - responses.size(); left > 0)
    info.notes.push_back(fmt::format("{} sets 58 hold spectra or other functions, left out", left));
  if (responses.empty()) return;
  info.response_points = points_as_channels(responses, sides).channels;
  const Eigen::VectorXd& at = responses.front().at;
  info.functions = fmt::format("{} frequency response functions, {} points, {} {}, {} lines{}", responses.size(),
                               info.response_points.size(), std::min(sides.responses.size(), sides.references.size()),
                               sides.hammer_roves() ? "responses (the hammer roved)" : "references", responses.front().lines,
                               at.size() > 1 ? fmt::format(", {:.6g} to {:.6g} Hz", at[0], at[at.size() - 1]) : "");
  const bool real = std::ranges::any_of(responses, [](const UniversalFunction& f) { return !f.complex; });
  if (real) info.notes.emplace_back("functions without phase (real values) cannot be identified");
}

}  // namespace twindeck::records
