// Oracle: files written here in the manner of loggers, with the numbers that went into them.
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.hpp"
#include "records/inspect.hpp"
#include "records/recorded_unit.hpp"
#include "records/text_layout.hpp"
#include "records/time_stamp.hpp"
#include "scratch.hpp"

namespace twindeck::records {
namespace {

double value(int t, int c) { return 0.25 * t - 3.0 * c + 0.125; }

std::string number(double x, bool comma) {
  std::string text = fmt::format("{:.4f}", x);
  if (comma) std::replace(text.begin(), text.end(), '.', ',');
  return text;
}

void expect_samples(const Record& record, int rows, int columns) {
  ASSERT_EQ(record.samples.rows(), rows);
  ASSERT_EQ(record.samples.cols(), columns);
  for (int t = 0; t < rows; ++t) {
    for (int c = 0; c < columns; ++c) EXPECT_NEAR(record.samples(t, c), value(t, c), 1e-4) << t << " " << c;
  }
}

TEST(TextRecord, LongHeaderSemicolonsDecimalCommaAndLatin1) {
  const Scratch scratch;
  std::string text =
      "sep=;\r\nTest Br\xFC"
      "cke;;\r\nOperator;somebody\r\nSampling rate;200,5;Hz\r\n\r\nZeit;Acc \xB5 1;Acc 2\r\ns;m/s\xB2;mg\r\n";
  for (int t = 0; t < 500; ++t)
    text += number(t / 200.5, true) + ";" + number(value(t, 0), true) + ";" + number(value(t, 1), true) + ";\r\n";
  const Record record = read(scratch.write("a.csv", text));
  expect_samples(record, 500, 2);
  EXPECT_NEAR(record.info.rate_Hz, 200.5, 0.01);
  EXPECT_EQ(record.info.channels[0].name, "Acc \xC2\xB5 1");
  EXPECT_EQ(record.info.channels[0].unit, "m/s\xC2\xB2");
  EXPECT_EQ(record.info.channels[1].unit, "mg");
  EXPECT_NE(record.info.format.find("latin-1"), std::string::npos);
  EXPECT_NEAR(si_factor("m/s\xC2\xB2"), 1.0, 0.0);
  EXPECT_NEAR(si_factor("mg"), 9.80665e-3, 1e-12);
}

TEST(TextRecord, TabsUnitsInNamesAndRateInTheHeader) {
  const Scratch scratch;
  std::string text = "# logger 7\n# dt = 5 ms\nA1 [g]\tA2 [g]\tA3 (mm/s)\n";
  for (int t = 0; t < 40; ++t)
    text += number(value(t, 0), false) + "\t" + number(value(t, 1), false) + "\t" + number(value(t, 2), false) + "\n";
  const Record record = read(scratch.write("a.txt", text));
  expect_samples(record, 40, 3);
  EXPECT_NEAR(record.info.rate_Hz, 200.0, 1e-9);
  EXPECT_EQ(record.info.channels[2].name, "A3");
  EXPECT_EQ(recorded_unit(record.info.channels[2].unit).value().quantity, "velocity");
}

TEST(TextRecord, DayAndMonthExchangedOnSomeDays) {
  // A logger that writes month/day through the twelfth and day/month after: 12 December 23:59:50 to 13 December 00:00:10.
  const Scratch scratch;
  std::string text = "Date;Time;a\n";
  int t = 0;
  for (int s = 50; s < 60; ++s) text += fmt::format("11/12/2021;23:59:{:02};{}\n", s, number(value(t++, 0), false));
  for (int s = 0; s < 10; ++s) text += fmt::format("12/12/2021;00:00:{:02};{}\n", s, number(value(t++, 0), false));
  const Record record = read(scratch.write("a.csv", text));
  expect_samples(record, 20, 1);
  EXPECT_NEAR(record.info.rate_Hz, 1.0, 1e-9);
  EXPECT_EQ(time_stamp_meanings("03/04/2021 10:00:00").size(), 2U);
  TimeStampReader reader;
  const double first = *reader.next("12/02/2021 23:59:59"), second = *reader.next("02/13/2021 00:00:00");
  EXPECT_NEAR(second - first, 1.0, 1e-6);
  const double third = *reader.next("2021-02-13T00:00:01.5Z");
  EXPECT_NEAR(third - second, 1.5, 1e-6);
}

// 5/7 and 5/8 may be 5 July and 5 August, or 7 and 8 May, which follow one another.
TEST(TextRecord, TheOrderOfDayAndMonthIsKeptOverMidnight) {
  for (const auto& [before, after] :
       {std::pair("5/7/2024", "5/8/2024"), {"05/12/2024", "05/13/2024"}, {"7.5.2024", "8.5.2024"}}) {
    TimeStampReader reader;
    const double first = *reader.next(std::string(before) + " 23:59:59.75"),
                 late = *reader.next(std::string(before) + " 23:59:59.5");
    EXPECT_NEAR(late - first, -0.25, 1e-6) << before;
    EXPECT_NEAR(*reader.next(std::string(after) + " 00:00:00.25") - late, 0.75, 1e-6) << before;
    EXPECT_NEAR(*reader.next(std::string(after) + " 00:00:01") - late, 1.5, 1e-6) << before;
    EXPECT_EQ(reader.exchanged(), 0) << before;
  }
}

TEST(TextRecord, ATemperatureBesideNoTimeIsAChannel) {
  const Scratch scratch;
  std::string text =
                  "T (\xC2\xB0"
                  "C),a\n",
              clock = "T (sec.),a\n";
  for (int t = 0; t < 400; ++t) {
    text += fmt::format("{:.1f},{}\n", 20.0 + 0.01 * t, number(std::sin(0.3 * t), false));
    clock += fmt::format("{:.2f},{}\n", 0.01 * t, number(std::sin(0.3 * t), false));
  }
  EXPECT_EQ(read(scratch.write("a.csv", text)).info.channels.size(), 2U);
  EXPECT_NEAR(read(scratch.write("b.csv", clock)).info.rate_Hz, 100.0, 1e-6);
}

TEST(TextRecord, GapsOfTheClockAndEmptyCellsAreMissing) {
  const Scratch scratch;
  std::string text = "time_s,a,b\n";
  for (int t = 0; t < 100; ++t) {
    if (t >= 40 && t < 45) continue;
    text += fmt::format("{},{},{}\n", 0.01 * t, t == 60 ? "" : number(value(t, 0), false),
                        t == 61 ? "NaN" : number(value(t, 1), false));
  }
  const Record record = read(scratch.write("a.csv", text));
  ASSERT_EQ(record.samples.rows(), 100);
  for (int t = 40; t < 45; ++t) EXPECT_TRUE(std::isnan(record.samples(t, 0)));
  EXPECT_TRUE(std::isnan(record.samples(60, 0)));
  EXPECT_TRUE(std::isnan(record.samples(61, 1)));
  EXPECT_NEAR(record.samples(99, 1), value(99, 1), 1e-4);
  EXPECT_NEAR(record.info.rate_Hz, 100.0, 1e-6);
  const Inspection inspection = inspect(scratch.file("a.csv"));
  EXPECT_EQ(inspection.channels[0].missing, 6);
  EXPECT_EQ(inspection.channels[0].longest_gap, 5);
}

TEST(TextRecord, PlainColumnsWithoutHeaderOrTime) {
  const Scratch scratch;
  std::string text;
  for (int t = 0; t < 30; ++t) text += fmt::format("  {:.5E}   {:.5E}\n", std::sin(t), std::cos(2.0 * t));
  const Record record = read(scratch.write("a.dat", text));
  ASSERT_EQ(record.samples.cols(), 2);
  for (int t = 0; t < 30; ++t) EXPECT_NEAR(record.samples(t, 1), std::cos(2.0 * t), 1e-5);
  EXPECT_EQ(record.info.rate_Hz, 0.0);
}

TEST(TextRecord, RefusesWhatHoldsNoNumbers) {
  const Scratch scratch;
  EXPECT_THROW(static_cast<void>(read(scratch.write("a.csv", "hello\nworld\n"))), InputError);
  EXPECT_THROW(static_cast<void>(read(scratch.write("b.csv", ""))), InputError);
  EXPECT_THROW(static_cast<void>(read(scratch.write("c.csv", std::string("\xFF\xFE"
                                                                         "a\0",
                                                                         4)))),
               InputError);
  EXPECT_THROW(static_cast<void>(read(scratch.file("none.csv"))), InputError);
}

TEST(Inspect, SeesClippingAndDeadChannels) {
  const Scratch scratch;
  std::string text = "t,a,b\n";
  for (int t = 0; t < 200; ++t) text += fmt::format("{:.3f},{:.6f},1.5\n", 0.005 * t, std::clamp(std::sin(0.3 * t), -0.9, 0.9));
  const Inspection inspection = inspect(scratch.write("a.csv", text));
  EXPECT_GT(inspection.channels[0].clipped, 30);
  EXPECT_TRUE(inspection.channels[1].dead);
  EXPECT_FALSE(inspection.channels[0].dead);
  const auto lines = describe(inspection);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(),
                          [](const std::string& line) { return line.find("constant") != std::string::npos; }));
}

}  // namespace
}  // namespace twindeck::records
