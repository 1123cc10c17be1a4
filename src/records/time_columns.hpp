#pragma once

#include <vector>

#include "records/record.hpp"
#include "records/record_clock.hpp"

namespace twindeck::records {

/// Passes the samples of unnamed columns to a visitor and finds columns of time among them. A column that runs like time in the
/// first rows is time and no channel. The first column may scatter; any other must be even to a sample.
class TimeColumns {
 public:
  /// @param channels  columns, of which one at least stays a channel
  TimeColumns(const Visitor& visit, Eigen::Index channels) : visit_(visit), channels_(channels) {}
  /// Whole rows, or one column after another.
  void operator()(Eigen::Index first_sample, Eigen::Index first_channel, const Eigen::MatrixXd& block);
  /// Called after the last block. Visits the blocks held back, removes columns of time from the list of channels, and takes the
  /// clock of the finest of them.
  void finish(RecordInfo& info);

 private:
  struct Column {
    StampedRows stamps;
    bool decided = false, is_time = false;
  };
  struct Block {
    Eigen::Index sample, channel;
    Eigen::MatrixXd values;
  };
  void hand_on(Eigen::Index first_sample, Eigen::Index first_channel, const Eigen::MatrixXd& block);
  void decide();

  const Visitor& visit_;
  Eigen::Index channels_;
  std::vector<Column> columns_;
  std::vector<Block> held_;
};

}  // namespace twindeck::records
