#include "records/column_match.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "core/error.hpp"
#include "core/letters.hpp"
#include "core/lists.hpp"

namespace twindeck::records {
using Eigen::Index;

namespace {

constexpr const char* kByKey =
    "say which column is which by `columns` in its [[record]] of campaign.toml, one entry for each of `channels`";

/// Letters and digits in lower case: "Acc 1", "ACC_1" and "acc1" are one name.
std::string folded(const std::string& name) {
  std::string text = lower_case(name);
  std::erase_if(text, [](char c) { return c == ' ' || c == '_' || c == '-' || c == '.'; });
  return text;
}

/// Position of the one channel with a name, or another name, that `same` accepts; -1 for none or several.
template <typename Same>
Index only_one(const RecordInfo& info, const Same& same) {
  Index found = -1;
  for (std::size_t c = 0; c < info.channels.size(); ++c) {
    const std::vector<std::string>& more = info.channels[c].other_names;
    if (!same(info.channels[c].name) && std::ranges::none_of(more, same)) continue;
    if (found >= 0) return -1;
    found = static_cast<Index>(c);
  }
  return found;
}

/// Matches channels by their other names, or by another spelling of their names, each once, with a note. Empty if not all are
/// found.
ColumnMatch by_other_names(const RecordInfo& info, const std::vector<std::string>& channels,
                           const std::filesystem::path& file) {
  ColumnMatch match;
  std::vector<std::string> pairs;
  for (const std::string& name : channels) {
    Index at = only_one(info, [&](const std::string& other) { return other == name; });
    if (at < 0) at = only_one(info, [&](const std::string& other) { return folded(other) == folded(name); });
    if (at < 0 || contains(match.columns, at)) return {};
    match.columns.push_back(at);
    const std::string& own = info.channels[static_cast<std::size_t>(at)].name;
    if (own != name) pairs.push_back(fmt::format("{} is its '{}'", name, own));
  }
  constexpr std::size_t most = 4;  // pairs that are named in the warning
  if (pairs.size() > most) pairs.resize(most);
  match.warning = fmt::format("{}: names the channels in another way: {}", file.string(), fmt::join(pairs, ", "));
  return match;
}

/// Position of the only channel of that name, or -1. @throws InputError  if there are several
Index position_of(const std::vector<std::string>& names, const std::string& name, const std::filesystem::path& file) {
  const auto at = std::ranges::find(names, name);
  if (at == names.end()) return -1;
  if (std::find(at + 1, names.end(), name) != names.end())
    throw InputError({file.string(), 0, name}, "names two columns of the file",
                     fmt::format("{} (\"column 3\" means the third)", kByKey));
  return at - names.begin();
}

/// "column 3" as a position in the file, otherwise 0.
Index column_number(const std::string& text) {
  const std::string word = "column ";
  if (!text.starts_with(word) || text.size() == word.size() || text.size() > word.size() + 9) return 0;
  if (text.find_first_not_of("0123456789", word.size()) != std::string::npos) return 0;
  return std::stol(text.substr(word.size()));
}

ColumnMatch by_key(const RecordInfo& info, const std::vector<std::string>& columns, const std::filesystem::path& file) {
  const std::vector<std::string> names = each_of(info.channels, &ChannelInfo::name);
  ColumnMatch match;
  for (const std::string& column : columns) {
    Index at = position_of(names, column, file);
    if (const Index number = column_number(column); at < 0 && number > 0) {
      const auto found = std::ranges::find(info.channels, number, &ChannelInfo::position);
      if (found == info.channels.end())
        throw InputError({file.string(), 0, column},
                         fmt::format("is no channel of the file, which has columns {} to {}", info.channels.front().position,
                                     info.channels.back().position),
                         "correct `columns` in campaign.toml; the time's column is no channel");
      at = found - info.channels.begin();
    }
    if (at < 0)
      throw InputError({file.string(), 0, column}, "is no column of the file" + did_you_mean(column, names),
                       fmt::format("correct `columns` in campaign.toml; the file has {}", fmt::join(names, ", ")));
    match.columns.push_back(at);
  }
  return match;
}

/// What the file has for names, for messages.
std::string its_names(const RecordInfo& info) {
  return info.names_channels ? fmt::format("it has {}", fmt::join(each_of(info.channels, &ChannelInfo::name), ", "))
                             : std::string("it has no line of names");
}

}  // namespace

ColumnMatch match_columns(const RecordInfo& info, const std::vector<std::string>& channels,
                          const std::vector<std::string>& columns, const std::filesystem::path& file) {
  if (info.channels.empty()) throw InputError({file.string(), 0, ""}, "holds no time series", "give the file with the samples");
  if (!columns.empty()) return by_key(info, columns, file);
  const std::vector<std::string> names = each_of(info.channels, &ChannelInfo::name);
  ColumnMatch match;
  std::string missing, misplaced;
  for (const std::string& name : channels) {
    const Index at = position_of(names, name, file);
    if (at >= 0) match.columns.push_back(at);
    if (at < 0 && missing.empty()) missing = name;
    if (const auto& line = info.unaligned_header; at < 0 && misplaced.empty() && contains(line, name)) misplaced = name;
  }
  if (match.columns.size() == channels.size()) return match;
  if (ColumnMatch other = by_other_names(info, channels, file); !other.columns.empty()) return other;
  if (!misplaced.empty())
    throw InputError(
        {file.string(), info.unaligned_line, misplaced},
        fmt::format("is one of {} names over rows of another width, so that none can be told", info.unaligned_header.size()),
        "give each column a name");
  if (!match.columns.empty()) {
    std::vector<std::string> left;  // names that match no other channel
    std::ranges::copy_if(names, std::back_inserter(left), [&](const std::string& name) { return !contains(channels, name); });
    throw InputError({file.string(), 0, missing},
                     "is no channel of the file, which names others that were asked for" + did_you_mean(missing, left),
                     fmt::format("correct `channels` in campaign.toml; the file has {}", fmt::join(names, ", ")));
  }
  if (info.channels.size() != channels.size())
    throw InputError({file.string(), 0, ""},
                     fmt::format("has {} columns, but campaign.toml names {} channels, none of which the file names: {}",
                                 info.channels.size(), channels.size(), its_names(info)),
                     kByKey);
  for (Index c = 0; c < std::ssize(info.channels); ++c) match.columns.push_back(c);
  if (info.has_header)
    match.warning = fmt::format("{}: names none of its channels ({}), which are taken by position; {}", file.string(),
                                its_names(info), kByKey);
  return match;
}

}  // namespace twindeck::records
