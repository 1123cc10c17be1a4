// Oracle: 17 May 2024, 10:00:00.25 UTC is 1715940000.25 s after 1970 (date -u +%s), written as programs write it.
#include "records/time_stamp.hpp"

#include <gtest/gtest.h>

namespace twindeck::records {
namespace {

TEST(TimeStamp, DatesAsProgramsWriteThem) {
  for (const char* text :
       {"2024-05-17T10:00:00.25Z", "2024-05-17 10:00:00.250000 UTC", "2024-05-17T12:00:00.25+02:00",
        "2024-05-17T04:30:00,25-0530", "17-May-2024 10:00:00.25", "17. Mai 2024 10:00:00,25", "17 mag 2024 10:00:00.25",
        "May 17, 2024 10:00:00.25 AM", "Fri, 17 May 2024 10:00:00.25 GMT", "17.05.2024, 10:00:00.25", "20240517T100000.25",
        "20240517 10:00:00.25", "2024/05/17 10:00:00:250"}) {
    const auto meanings = time_stamp_meanings(text);
    ASSERT_EQ(meanings.size(), 1U) << text;
    EXPECT_NEAR(meanings.front(), 1715940000.25, 1e-6) << text;
  }
  for (const char* text : {"17-Foo-2024 10:00:00", "10:00:00 begin", "ch: 5", "1 2 3 10:00", "20240517", "10:00:00+",
                           "25:00:00Z", "2024-05-17 25:00:00", "1000:00:00", ""})
    EXPECT_TRUE(time_stamp_meanings(text).empty()) << text;
  EXPECT_TRUE(is_date("17-May-24") && is_date("17.05.2024"));
  EXPECT_FALSE(is_date("May") || is_date("10:00") || is_date("17-Foo-24"));
}

TEST(TimeStamp, HoursSinceAStart) {
  EXPECT_EQ(time_stamp_meanings("25:00:00.5").front(), 90000.5);
  EXPECT_EQ(time_stamp_meanings("100:00:01").front(), 360001.0);
}

TEST(TimeStamp, MinutesAndSecondsPassTheHour) {
  TimeStampReader reader;
  EXPECT_EQ(reader.next("59:59.9"), 3599.9);
  EXPECT_EQ(reader.next("00:00.0"), 3600.0);
  EXPECT_EQ(reader.next("00:00,5"), 3600.5);
  EXPECT_EQ(time_stamp_meanings("10:05").front(), 36300.0);  // without a fraction: hours and minutes
}

}  // namespace
}  // namespace twindeck::records
