#include "records/time_columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "records/take_clock.hpp"

namespace twindeck::records {

using Eigen::Index;

namespace {

constexpr Index kLeast = 16, kEnough = 256;  ///< rows for the decision: no vibration rises so many times in a row

}  // namespace

void TimeColumns::decide() {
  if (held_.empty()) return;
  const Index first = held_.front().channel, end = first + held_.front().values.cols();
  Index times = std::ranges::count_if(columns_, [](const Column& c) { return c.is_time; });
  for (Index c = first; c < end; ++c) {
    Column& column = columns_[static_cast<std::size_t>(c)];
    column.decided = true;
    column.is_time = times + 1 < channels_ && column.stamps.rows() >= kLeast &&
                     column.stamps.runs_like_time(c > 0 ? StampedRows::Straight::to_a_sample : StampedRows::Straight::roughly);
    if (column.is_time)
      ++times;
    else
      column.stamps = {};
  }
  for (const Block& block : held_) hand_on(block.sample, block.channel, block.values);
  held_.clear();
}

void TimeColumns::hand_on(Index first_sample, Index first_channel, const Eigen::MatrixXd& block) {
  const auto is_time = [&](Index c) { return columns_[static_cast<std::size_t>(c)].is_time; };
  Index channel = first_channel;
  for (Index c = 0; c < first_channel; ++c) channel -= is_time(c) ? 1 : 0;
  for (Index from = 0, to = 0; to <= block.cols(); ++to) {
    if (to < block.cols() && !is_time(first_channel + to)) continue;
    if (to - from == block.cols())
      visit_(first_sample, channel, block);
    else if (to > from)
      visit_(first_sample, channel, block.middleCols(from, to - from));
    channel += to - from;
    from = to + 1;
  }
}

void TimeColumns::operator()(Index first_sample, Index first_channel, const Eigen::MatrixXd& block) {
  if (!held_.empty() && held_.front().channel != first_channel) decide();
  columns_.resize(std::max(columns_.size(), static_cast<std::size_t>(first_channel + block.cols())));
  Column* columns = &columns_[static_cast<std::size_t>(first_channel)];
  for (Index c = 0; c < block.cols(); ++c) {
    if (columns[c].decided && !columns[c].is_time) continue;
    for (const double stamp : block.col(c)) columns[c].stamps.add(stamp);
  }
  if (columns[0].decided) return hand_on(first_sample, first_channel, block);
  held_.push_back({first_sample, first_channel, block});
  if (columns[0].stamps.rows() >= kEnough) decide();
}

void TimeColumns::finish(RecordInfo& info) {
  decide();
  std::size_t finest = columns_.size();
  for (std::size_t c = columns_.size(); c-- > 0;) {
    if (!columns_[c].is_time) continue;
    if (finest == columns_.size() || columns_[c].stamps.distinct() >= columns_[finest].stamps.distinct()) finest = c;
    info.channels.erase(info.channels.begin() + static_cast<std::ptrdiff_t>(c));
  }
  if (finest < columns_.size())
    take_clock(columns_[finest].stamps, 0.0, fmt::format("column {}, which runs like time", finest + 1), info);
}

}  // namespace twindeck::records
