#include "records/first_column.hpp"

#include "records/take_clock.hpp"

namespace twindeck::records {

using Eigen::Index;

namespace {

constexpr Index kLeast = 16, kEnough = 256;  ///< rows: no vibration rises that often in a row

}  // namespace

void FirstColumn::decide() {
  undecided_ = false;
  is_time_ = stamps_.rows() >= kLeast && stamps_.runs_like_time();
  for (const Block& block : held_) hand_on(block.sample, block.channel, block.values);
  held_.clear();
}

void FirstColumn::hand_on(Index first_sample, Index first_channel, const Eigen::MatrixXd& block) {
  if (!is_time_) return visit_(first_sample, first_channel, block);
  if (first_channel > 0) return visit_(first_sample, first_channel - 1, block);
  if (block.cols() > 1) visit_(first_sample, 0, block.rightCols(block.cols() - 1));
}

void FirstColumn::operator()(Index first_sample, Index first_channel, const Eigen::MatrixXd& block) {
  if (first_channel == 0 && (undecided_ || is_time_)) {
    for (const double stamp : block.col(0)) stamps_.add(stamp);
  }
  if (undecided_) {
    held_.push_back({first_sample, first_channel, block});
    if (stamps_.rows() >= kEnough || first_channel > 0) decide();
    return;
  }
  hand_on(first_sample, first_channel, block);
}

void FirstColumn::finish(RecordInfo& info) {
  if (undecided_) decide();
  if (!is_time_) return;
  info.channels.erase(info.channels.begin());
  take_clock(stamps_, 0.0, "first column, which runs like time", info);
}

}  // namespace twindeck::records
