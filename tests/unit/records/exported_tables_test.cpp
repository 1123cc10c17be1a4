// Oracle: tables, matrices and universal files made here as programs export them, with the numbers that went into them.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <matio.h>

#include "core/error.hpp"
#include "npy_double.hpp"
#include "records/column_match.hpp"
#include "records/inspect.hpp"
#include "refusal.hpp"
#include "same_samples.hpp"
#include "scratch.hpp"
#include "test_places.hpp"
#include "universal_writer.hpp"

namespace twindeck::records {
namespace {

double wave(int t, int c) { return std::round(1e4 * std::sin(0.37 * t * (c + 1) + c)) / 1e4; }

std::string cell(double x, bool comma = false) {
  std::string text = fmt::format("{:.4f}", x);
  if (comma) std::replace(text.begin(), text.end(), '.', ',');
  return text;
}

void expect_waves(const Record& record, int rows, int columns, const std::string& what) {
  ASSERT_EQ(record.samples.rows(), rows) << what;
  ASSERT_EQ(record.samples.cols(), columns) << what;
  for (int t = 0; t < rows; ++t) {
    for (int c = 0; c < columns; ++c) ASSERT_NEAR(record.samples(t, c), wave(t, c), 1e-9) << what << " " << t << " " << c;
  }
}

bool told(const RecordInfo& info, const std::string& words) {
  return std::any_of(info.notes.begin(), info.notes.end(),
                     [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

TEST(ExportedTable, ASlowChannelInTheLastColumn) {
  const Scratch scratch;
  for (const char* kind : {"separator", "left out", "word"}) {
    std::string text = "time,P1,P2,Temp\n";
    for (int t = 0; t < 300; ++t) {
      text += fmt::format("{:.2f},{},{}", 0.01 * t, cell(wave(t, 0)), cell(wave(t, 1)));
      if (t % 100 == 0)
        text += ",12.5";
      else
        text += std::string(kind) == "separator" ? "," : std::string(kind) == "word" ? ",No Data" : "";
      text += "\n";
    }
    const Record record = read(scratch.write("a.csv", text));
    ASSERT_EQ(record.info.channels.size(), 3U) << kind;
    EXPECT_EQ(record.info.channels[2].name, "Temp") << kind;
    EXPECT_EQ(record.samples(100, 2), 12.5) << kind;
    EXPECT_TRUE(std::isnan(record.samples(101, 2))) << kind;
    expect_waves({record.info, record.samples.leftCols(2)}, 300, 2, kind);
    EXPECT_TRUE(record.info.notes.empty()) << kind;
  }
}

TEST(ExportedTable, OfLabViewHasItsNamesAndUnitsWithOrWithoutComments) {
  const Scratch scratch;
  for (const char* end : {"\n", "\t\n"}) {  // rows that stop before the column of comments, or open it
    std::string text = "LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\n***End_of_Header***\t\n\t\n";
    text +=
        "Channels\t2\t\t\nY_Unit_Label\tm/"
        "s2\tmm\t\nDelta_X\t0.01\t0.01\t\n***End_of_Header***\t\t\t\nX_Value\ttop\tmid\tComment\n";
    for (int t = 0; t < 200; ++t) text += fmt::format("{:.6f}\t{}\t{}{}", 0.01 * t, cell(wave(t, 0)), cell(wave(t, 1)), end);
    const Record record = read(scratch.write("a.lvm", text));
    expect_waves(record, 200, 2, end);
    EXPECT_EQ(record.info.channels[0].name, "top");
    EXPECT_EQ(record.info.channels[1].name, "mid");
    EXPECT_EQ(record.info.channels[0].unit, "m/s2");
    EXPECT_EQ(record.info.channels[1].unit, "mm");
    EXPECT_NEAR(record.info.rate_Hz, 100.0, 1e-6);
  }
}

TEST(ExportedTable, NamesStandAboveUnitsThoughAThirdLineFollows) {
  const Scratch scratch;
  struct Logger {
    const char *name, *head, *first;
  };
  for (const Logger& logger :
       {Logger{
            "TOA5",
            "\"TOA5\",\"bridge\",\"CR6\"\n\"TIME\",\"top\",\"mid\"\n\"TS\",\"m/s^2\",\"microstrain\"\n\"\",\"Smp\",\"Smp\"\n",
            "m/s^2"},
        Logger{"catman", "HBM catman\n\nTime,top,mid\ns,mm,microstrain\nTime 1,MX840,MX840\n", "mm"}}) {
    std::string text = logger.head;
    for (int t = 0; t < 200; ++t) text += fmt::format("{:.2f},{},{}\n", 0.01 * t, cell(wave(t, 0)), cell(wave(t, 1)));
    const Record record = read(scratch.write("a.dat", text));
    expect_waves(record, 200, 2, logger.name);
    EXPECT_EQ(record.info.channels[0].name, "top") << logger.name;
    EXPECT_EQ(record.info.channels[1].name, "mid") << logger.name;
    EXPECT_EQ(record.info.channels[0].unit, logger.first) << logger.name;
    EXPECT_EQ(record.info.channels[1].unit, "microstrain") << logger.name;
  }
}

TEST(ExportedTable, OneSeriesWrittenOnAlongTheRowsIsRefusedAndReadAsTheRemedySays) {
  const Scratch scratch;
  for (const int samples : {400, 398}) {  // the last row is full, or not
    const std::string head = fmt::format("RECORD OF A BRIDGE\nUNITS OF G\nNPTS=   {}, DT=   .0100 SEC\n", samples);
    std::string wrapped = head, column = head;
    for (int t = 0; t < samples; ++t) {
      wrapped += "  " + cell(wave(t, 0)) + (t % 5 == 4 || t + 1 == samples ? "\n" : "");
      column += cell(wave(t, 0)) + "\n";
    }
    const std::string message = refusal(scratch.write("a.at2", wrapped));
    EXPECT_NE(message.find(fmt::format("states {} samples", samples)), std::string::npos) << message;
    const Record record = read(scratch.write("b.at2", column));
    expect_waves(record, samples, 1, "one number a line");
    EXPECT_NEAR(record.info.rate_Hz, 100.0, 1e-9);
  }
}

TEST(ExportedTable, BlocksUnderEachOtherAreNoSingleChannel) {
  const Scratch scratch;
  std::string text, first;
  for (const int c : {0, 1}) {
    text += fmt::format("Channel {}\ndt = 0.01 s\n", c + 1);
    for (int t = 0; t < 200; ++t) text += cell(wave(t, c)) + "\n";
    if (c == 0) first = text;
  }
  const std::string message = refusal(scratch.write("a.txt", text));
  EXPECT_NE(message.find("203: 'Channel 2' stands in the header too"), std::string::npos) << message;
  expect_waves(read(scratch.write("b.txt", first)), 200, 1, "a block of its own");
}

TEST(ExportedTable, SeparatorsQuotesAndDecimalCommas) {
  const Scratch scratch;
  struct Form {
    const char *separator, *quote, *end;
    bool comma;
  };
  for (const Form& form :
       {Form{",", "\"", "\n", true}, Form{";", "\"", ";\n", true}, Form{"\t", "", "\t\r\n", true}, Form{" ", "\"", "\n", true},
        Form{"|", "", "\n", true}, Form{", ", "", ",\n", false}, Form{";", "", "\r", false}, Form{",", "\"", "\n", false}}) {
    std::string text = std::string("time") + form.separator + "P1" + form.separator + "P2" + form.end;
    for (int t = 0; t < 200; ++t) {
      const auto quoted = [&](const std::string& x) { return form.quote + x + form.quote; };
      text += quoted(cell(0.01 * t, form.comma)) + form.separator + quoted(cell(wave(t, 0), form.comma)) + form.separator +
              quoted(cell(wave(t, 1), form.comma)) + form.end;
    }
    const Record record = read(scratch.write("a.csv", text));
    const std::string what = fmt::format("'{}' {} {}", form.separator, form.quote, form.comma);
    expect_waves(record, 200, 2, what);
    EXPECT_NEAR(record.info.rate_Hz, 100.0, 1e-6) << what;
    EXPECT_EQ(record.info.channels[1].name, "P2") << what;
  }
}

TEST(ExportedTable, ThousandsInGroups) {
  const Scratch scratch;
  for (const auto& [signs, comma] : {std::pair<std::string, bool>{",", false}, {".", true}, {"'", false}, {"\xC2\xA0", true}}) {
    std::string text = "Time;P1\n";
    for (int t = 0; t < 300; ++t) {
      const double x = wave(t, 0) * 9000.0;
      std::string number = cell(std::abs(x), comma);
      if (std::abs(x) >= 1000.0) number.insert(1, signs);
      text += fmt::format("{};{}{}\n", cell(0.01 * t, comma), x < 0.0 ? "-" : "", number);
    }
    const Record record = read(scratch.write("a.csv", text));
    ASSERT_EQ(record.samples.rows(), 300) << signs;
    for (int t = 0; t < 300; ++t) ASSERT_NEAR(record.samples(t, 0), 9000.0 * wave(t, 0), 1e-4) << signs << t;
  }
  std::string whole = "Time;P1\n";
  for (int t = 0; t < 300; ++t) whole += fmt::format("{:.2f};{}\n", 0.01 * t, t % 3 == 0 ? "1,204" : "998");
  EXPECT_NE(refusal(scratch.write("b.csv", whole)).find("it parts thousands"), std::string::npos);
}

TEST(ExportedTable, WordsForWhatIsMissingAndTextThatIsNone) {
  const Scratch scratch;
  const auto table = [](const std::string& word) {
    std::string text = "Time,P1,P2\n0.00," + word + "," + word + "\n";
    for (int t = 1; t < 300; ++t) text += fmt::format("{:.2f},{},{}\n", 0.01 * t, t == 50 ? word : cell(wave(t, 0)), "0.5");
    return text;
  };
  for (const char* word : {"overflow", "Fault", "#WERT!", "#N/A", "saturated", "n.v.", "-Infinity", "n.d.", "N/D", "No Value",
                           "<null>", "BurnOut", "Under Range", "+++++", "9.91E+37", "3.402823466e+38"}) {
    const Record record = read(scratch.write("a.csv", table(word)));
    ASSERT_EQ(record.samples.rows(), 300) << word;
    EXPECT_TRUE(std::isnan(record.samples(50, 0)) && std::isnan(record.samples(0, 0))) << word;
    EXPECT_EQ(record.info.channels[0].name, "P1") << word;
  }
  std::string text = table("NaN");
  text.replace(text.rfind("NaN"), 3, "train");
  EXPECT_NE(refusal(scratch.write("b.csv", text)).find("empty the cell"), std::string::npos);
  EXPECT_NE(refusal(scratch.write("c.csv", "P1,P2\nA7,1\nA7,2\nA7,3\n")).find("line 3 has 'A7' in column 1"),
            std::string::npos);
}

TEST(ExportedTable, TimeUnderANameThatDoesNotSayIt) {
  const Scratch scratch;
  std::string text = "X_Value,P1,P2\n", drift = "Drift,P1,P2\n";
  for (int t = 0; t < 400; ++t) {
    text += fmt::format("{:.6f},{},{}\n", t / 100.8, cell(wave(t, 0)), cell(wave(t, 1)));
    drift += fmt::format("{:.6f},{},{}\n", std::sqrt(t + 1.0), cell(wave(t, 0)), cell(wave(t, 1)));
  }
  const Record record = read(scratch.write("a.csv", text));
  expect_waves(record, 400, 2, "X_Value");
  EXPECT_NEAR(record.info.rate_Hz, 100.8, 1e-3);
  EXPECT_EQ(read(scratch.write("b.csv", drift)).info.channels.size(), 3U);
}

TEST(ExportedTable, AClockForEachChannel) {
  const Scratch scratch;
  for (const double other : {1.0, 0.5}) {
    std::string text = "Time 1,P1,Time 2,P2\n";
    for (int t = 0; t < 400; ++t)
      text += fmt::format("{:.4f},{},{:.4f},{}\n", t / 100.8, cell(wave(t, 0)), t / (100.8 * other), cell(wave(t, 1)));
    const Record record = read(scratch.write("a.csv", text));
    expect_waves(record, 400, 2, "two clocks");
    EXPECT_EQ(told(record.info, "column 3 runs at 50.4 Hz, another of time at 100.8 Hz"), other == 0.5);
  }
}

TEST(ExportedTable, Utf16WithAndWithoutItsMark) {
  const Scratch scratch;
  std::u16string text = u"time_s,Br\u00FCcke\n";
  for (int t = 0; t < 60; ++t) {
    for (const char c : fmt::format("{:.2f},{}\n", 0.01 * t, cell(wave(t, 0)))) text += static_cast<char16_t>(c);
  }
  for (const bool big : {false, true}) {
    for (const bool mark : {false, true}) {
      std::string bytes;
      for (const char16_t c : (mark ? u"\uFEFF" : u"") + text) {
        const char low = static_cast<char>(c & 0xFF), high = static_cast<char>(c >> 8);
        bytes += big ? std::string{high, low} : std::string{low, high};
      }
      const Record record = read(scratch.write("a.csv", bytes));
      expect_waves(record, 60, 1, mark ? "mark" : "no mark");
      EXPECT_EQ(record.info.channels[0].name,
                "Br\xC3\xBC"
                "cke");
    }
  }
}

TEST(ExportedTable, ALastLineCutInsideANumberIsLeftOut) {
  const Scratch scratch;
  std::string text = "time_s,P1\n";
  for (int t = 0; t < 100; ++t) text += fmt::format("{:.2f},{}\n", 0.01 * t, cell(wave(t, 0)));
  expect_waves(read(scratch.write("whole.csv", text.substr(0, text.size() - 1))), 100, 1, "without its last line end");
  const Record cut = read(scratch.write("cut.csv", text.substr(0, text.size() - 3)));
  expect_waves(cut, 99, 1, "cut");
  EXPECT_TRUE(told(cut.info, "line 101, the last, has no end"));
}

TEST(ExportedTable, ColumnsOfTimeAreNoChannels) {
  const Scratch scratch;
  std::string text = "Date and time,time_ms,t,P1\n";
  for (int t = 0; t < 200; ++t)
    text += fmt::format("2024-05-17 10:00:{:06.3f},{},{},{}\n", 0.01 * t, 10 * t, t, cell(wave(t, 0)));
  const Record record = read(scratch.write("a.csv", text));
  EXPECT_EQ(record.info.channels.front().name, "t");  // counts: no time
  EXPECT_NEAR(record.info.rate_Hz, 100.0, 1e-6);
  // Whole seconds beside milliseconds: the finer column is the clock.
  std::string coarse = "Date,Time,time_ms,P1\n";
  for (int t = 0; t < 200; ++t) coarse += fmt::format("2024-05-17,10:00:{:02},{},{}\n", t / 100, 10 * t, cell(wave(t, 0)));
  const Record fine = read(scratch.write("c.csv", coarse));
  expect_waves(fine, 200, 1, "coarse");
  EXPECT_EQ(fine.info.rate_source, "time column 'time_ms'");
  // A name that says time above what is none is told.
  std::string none = "time,P1\n";
  for (int t = 0; t < 200; ++t) none += cell(wave(t, 1)) + "," + cell(wave(t, 0)) + "\n";
  const Record odd = read(scratch.write("b.csv", none));
  EXPECT_EQ(odd.samples.cols(), 2);
  EXPECT_TRUE(told(odd.info, "column 'time' does not run like time"));
}

TEST(ExportedTable, RowsThatAreThereTwiceAreLeftOutOnce) {
  const Scratch scratch;
  for (const bool same : {true, false}) {
    std::string text = "time_s,P1\n";
    for (int i = 0; i < 300; ++i) {
      const int t = i < 200 ? i : i - 30;
      text += fmt::format("{:.2f},{}\n", 0.01 * t, cell(wave(same ? t : i, 0)));
    }
    const auto file = scratch.write("a.csv", text);
    if (same) {
      const Record record = read(file);
      expect_waves(record, 270, 1, "twice");
      EXPECT_TRUE(told(record.info, "30 rows from sample 200 (line 202) on have time stamps that were there before"));
    } else {
      EXPECT_NE(refusal(file).find("a.csv:202: the time runs backwards by 0.3 s at sample 200"), std::string::npos)
          << refusal(file);
    }
  }
}

TEST(Matrix, TimeInTheFirstColumnAndChannelsAlongRows) {
  const Scratch scratch;
  const Eigen::MatrixXd samples = same_samples();
  Eigen::MatrixXd timed(samples.rows(), samples.cols() + 1);
  timed << Eigen::VectorXd::LinSpaced(400, 0.0, 399.0 / 128.0), samples;
  for (const bool transposed : {false, true}) {
    const Eigen::MatrixXd matrix = transposed ? Eigen::MatrixXd(timed.transpose()) : timed;
    io::write_npy(matrix, scratch.file("a.npy"));
    write_mat(scratch.file("5.mat"), matrix, MAT_FT_MAT5, true);
    write_mat(scratch.file("73.mat"), matrix, MAT_FT_MAT73, false);
    for (const char* name : {"a.npy", "5.mat", "73.mat"}) {
      const Record record = read(scratch.file(name));
      ASSERT_EQ(record.samples.cols(), samples.cols()) << name << transposed;
      EXPECT_EQ(record.samples, samples) << name << transposed;
      EXPECT_NEAR(record.info.rate_Hz, 128.0, 1e-6) << name;
      EXPECT_EQ(record.info.channels.front().position, 2) << name;
      EXPECT_EQ(told(record.info, "channels run along the rows"), transposed) << name;
    }
  }
}

TEST(Matrix, WhatIsNoneIsNamed) {
  const Scratch scratch;
  const std::string python = TWINDECK_PYTHON;
  const std::string program =
      "import numpy as n, scipy.io as s; d = n.arange(600.0).reshape(100, 3, 2); c = n.empty(2, object); c[0] = n.sin(d[:, :, "
      "0]); "
      "c[1] = 'still air'; r = n.array([(1, 2), (3, 4)], dtype=[('a', 'f8'), ('b', 'f8')]); "
      "s.savemat('three.mat', {'acc': d}); s.savemat('flat.mat', {'acc': n.sin(d[:, :, :1])}); s.savemat('cell.mat', {'runs': "
      "c}); "
      "s.savemat('structs.mat', {'run': r})";
  if (std::system(fmt::format("cd '{}' && {} -c \"{}\" >/dev/null 2>&1", scratch.file("").string(), python, program).c_str()) !=
      0)
    GTEST_SKIP() << "SciPy is not installed";
  EXPECT_NE(refusal(scratch.file("three.mat")).find("'acc' has 3 dimensions (100 x 3 x 2)"), std::string::npos);
  EXPECT_NE(refusal(scratch.file("structs.mat")).find("'run' is an array of 2 structures"), std::string::npos)
      << refusal(scratch.file("structs.mat"));
  for (const char* name : {"flat.mat", "cell.mat"}) {
    const Record record = read(scratch.file(name));
    ASSERT_EQ(record.samples.rows(), 100) << name;
    EXPECT_NEAR(record.samples(7, 2), std::sin(7 * 6 + 4.0), 1e-12) << name;
  }
}

TEST(Matrix, FilesOfOtherProgramsAreNamedWithAWayOut) {
  const Scratch scratch;
  for (const auto& [bytes, way] : {std::pair<std::string, std::string>{"PK\3\4....data.npy", "numpy.save"},
                                   {"PAR1....", "read_parquet"},
                                   {"\x80\4\x95....", "numpy.save"},
                                   {"\x1F\x8B\x08....", "unpack"},
                                   {"TDSm....", "CSV"}})
    EXPECT_NE(refusal(scratch.write("a.bin", bytes)).find(way), std::string::npos) << refusal(scratch.file("a.bin"));
  std::string fields = "{'descr': [('time', '<f8'), ('P1', '<f8')], 'fortran_order': False, 'shape': (9,), }";
  fields.resize(117, ' ');
  EXPECT_NE(refusal(scratch.write("a.npy", "\x93NUMPY\1" + std::string(1, '\0') + "v" + std::string(1, '\0') + fields + "\n"))
                .find("numpy.column_stack"),
            std::string::npos);
}

TEST(Matrix, ATableOfCompoundRowsIsNamedWithItsColumns) {
  const Scratch scratch;
  struct Row {
    double time, value;
  };
  std::vector<Row> rows(50, Row{0.5, 1.5});
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(Row));
  H5Tinsert(type, "time", HOFFSET(Row, time), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "P1", HOFFSET(Row, value), H5T_NATIVE_DOUBLE);
  const hid_t file = H5Fcreate(scratch.file("t.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hsize_t size = rows.size();
  const hid_t space = H5Screate_simple(1, &size, nullptr),
              set = H5Dcreate2(file, "table", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data());
  H5Dclose(set);
  H5Sclose(space);
  H5Tclose(type);
  H5Fclose(file);
  EXPECT_NE(refusal(scratch.file("t.h5")).find("'table' is a table of compound rows (time, P1)"), std::string::npos)
      << refusal(scratch.file("t.h5"));
}

TEST(UniversalNames, ChannelsThatDifferInRecord6OrAnotherTitleLine) {
  const Scratch scratch;
  const std::string sound = universal_58(same_samples(), 128.0, false);
  const auto one_title = [&](bool entities) {
    std::string text = sound;
    for (int c = 1; c <= 4; ++c) {
      const std::size_t title = text.find(fmt::format("{:<80}\n", fmt::format("A{}", c)));
      text.replace(title, 2, "v2");
      text.replace(text.find("NONE\n", title), 4, fmt::format("L{:03}", c));  // the second title line
      if (entities) {
        const std::string record = fmt::format("    1         0    0         0 {:<10}", "NONE");
        const std::size_t identity = text.find(record, title);
        text.replace(identity + record.size() - 10, 4, fmt::format("P{:<3}", c));
      }
    }
    return text;
  };
  const RecordInfo named = read(scratch.write("a.uff", one_title(true))).info;
  EXPECT_EQ(named.channels[2].name, "P3+z");
  for (const char* name : {"P3+z", "P3", "L003", "3+z", "p3"})
    EXPECT_EQ(match_columns(named, {name}, {}, "a.uff").columns, (std::vector<Eigen::Index>{2})) << name;
  const RecordInfo titled = read(scratch.write("b.uff", one_title(false))).info;
  EXPECT_EQ(match_columns(titled, {"L002"}, {}, "b.uff").columns, (std::vector<Eigen::Index>{1}));
}

TEST(UniversalNames, TheUnitOfTheAbscissaCounts) {
  const Scratch scratch;
  std::string text = universal_58(same_samples(), 0.128, false);  // a step in ms
  for (std::size_t at = 0; (at = text.find("Time                 s ", at)) != std::string::npos; ++at)
    text.replace(at + 21, 2, "ms");
  EXPECT_NEAR(read(scratch.write("ms.uff", text)).info.rate_Hz, 128.0, 1e-3);
  for (std::size_t at = 0; (at = text.find("Time                 ms", at)) != std::string::npos; ++at)
    text.replace(at + 21, 2, "??");
  EXPECT_NEAR(read(scratch.write("likely.uff", text)).info.rate_Hz, 128.0, 1e-3);
}

TEST(ColumnMatch, AnotherSpellingIsMatchedWithAWord) {
  RecordInfo info;
  info.names_channels = true;
  for (const char* name : {"ACC 2", "ACC_1", "Temp"}) {
    info.channels.emplace_back();
    info.channels.back().name = name;
  }
  const ColumnMatch match = match_columns(info, {"acc1", "Acc-2"}, {}, "a.csv");
  EXPECT_EQ(match.columns, (std::vector<Eigen::Index>{1, 0}));
  EXPECT_NE(match.warning.find("acc1 is its 'ACC_1'"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::records
