// Oracle: tables written here with the rows of several sensors in turn, and counters and row numbers that only look alike.
#include <gtest/gtest.h>

#include <cmath>

#include "records/record.hpp"
#include "scratch.hpp"

namespace twindeck::records {
namespace {

/// Whether a note says that rows are of several sensors.
bool told_in_turn(const std::string& names, int sensors, bool each_row_has_a_stamp, bool stamped = true) {
  std::string text = names + "\n";
  for (int t = 0; t < 400; ++t)
    text += (stamped ? fmt::format("{:.2f},", 0.01 * (each_row_has_a_stamp ? t : t / sensors)) : "") +
            fmt::format("{},{:.4f},{:.4f}\n", t % sensors + 1, std::sin(0.37 * t), std::sin(0.7 * t));
  const Scratch scratch;
  const Record record = read(scratch.write("a.csv", text));
  return std::ranges::any_of(
      record.info.notes, [](const std::string& note) { return note.find("sensors in turn, by column") != std::string::npos; });
}

TEST(RowsInTurn, AreToldFromCounters) {
  EXPECT_TRUE(told_in_turn("time,id,ax,ay", 4, false));
  EXPECT_FALSE(told_in_turn("time,seq,ax,ay", 4, false));  // samples of a packet
  EXPECT_FALSE(told_in_turn("time,id,ax,ay", 4, true));
  EXPECT_FALSE(told_in_turn("time,seq,ax,ay", 4, true));
  EXPECT_TRUE(told_in_turn("id,ax,ay", 3, false, false));
  EXPECT_FALSE(told_in_turn("seq,ax,ay", 3, false, false));
}

TEST(RowNumbers, NeedNoName) {
  // R's write.table and pandas give the column of row numbers no name.
  for (const char* form : {"\"{}\" {:.2f} {:.4f} {:.4f}\n", "{} {:.2f} {:.4f} {:.4f}\n"}) {
    std::string text = "time A1 A2\n";
    for (int t = 0; t < 200; ++t)
      text += fmt::format(fmt::runtime(form), t + 1, 0.01 * t, std::sin(0.37 * t), std::sin(0.7 * t));
    const Scratch scratch;
    const Record record = read(scratch.write("a.txt", text));
    ASSERT_EQ(record.info.channels.size(), 3U) << form;
    EXPECT_EQ(record.info.channels[1].name, "A1");
    EXPECT_NEAR(record.samples(150, 2), std::sin(0.7 * 150), 1e-4);
    EXPECT_NEAR(record.info.rate_Hz, 100.0, 1e-6);
  }
}

}  // namespace
}  // namespace twindeck::records
