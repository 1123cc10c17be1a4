#pragma once

#include <vector>

#include "records/record.hpp"
#include "records/record_clock.hpp"

namespace twindeck::records {

/// Stands between a matrix without names and its visitor. If the first column runs like time in the first rows, it is the time
/// of the others and no channel.
class FirstColumn {
 public:
  /// @param channels  columns of the matrix; one alone is a channel
  FirstColumn(const Visitor& visit, Eigen::Index channels) : visit_(visit), undecided_(channels > 1) {}
  void operator()(Eigen::Index first_sample, Eigen::Index first_channel, const Eigen::MatrixXd& block);
  /// After the last block: what was held back is visited, the time's channel leaves the list and its rate enters it.
  void finish(RecordInfo& info);

 private:
  struct Block {
    Eigen::Index sample, channel;
    Eigen::MatrixXd values;
  };
  void hand_on(Eigen::Index first_sample, Eigen::Index first_channel, const Eigen::MatrixXd& block);
  void decide();

  const Visitor& visit_;
  StampedRows stamps_;
  std::vector<Block> held_;
  bool undecided_, is_time_ = false;
};

}  // namespace twindeck::records
