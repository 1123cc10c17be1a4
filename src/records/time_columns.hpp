#pragma once

#include <vector>

#include "records/record.hpp"
#include "records/record_clock.hpp"

namespace twindeck::records {

/// Stands between a matrix, or vectors of one length, without names and the visitor. A column that runs like time in the first
/// rows is the time of the others and no channel: the first column loosely, any other if it is even to a sample.
class TimeColumns {
 public:
  /// @param channels  columns, of which one at least stays a channel
  TimeColumns(const Visitor& visit, Eigen::Index channels) : visit_(visit), channels_(channels) {}
  /// Whole rows, or one column after another.
  void operator()(Eigen::Index first_sample, Eigen::Index first_channel, const Eigen::MatrixXd& block);
  /// After the last block. Visits what was held back, takes columns of time out of the list of channels, and sets the clock to
  /// that of the finest of them.
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
