// Oracle: a file that was cut off or changed is refused as bad input, or gives the very samples that went into it; never
// others, never another kind of failure. The cuts are exhaustive, the changes drawn with fixed seeds.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <random>
#include <stdexcept>

#include "core/error.hpp"
#include "npy_double.hpp"
#include "records/inspect.hpp"
#include "records/scan_hdf5.hpp"
#include "refusal.hpp"
#include "same_samples.hpp"
#include "universal_writer.hpp"

namespace twindeck::records {
namespace {

const Eigen::MatrixXd kSmall = same_samples().topLeftCorner(12, 3);

/// Every cut of a file: refused with the file's name, or read whole (where only a later variable is gone).
void expect_cuts_seen(const Scratch& scratch, const std::string& name, const std::string& whole, std::size_t step) {
  ASSERT_EQ(refusal(scratch.write(name, whole)), "");
  std::size_t refused = 0;
  for (std::size_t bytes = 1; bytes < whole.size(); bytes += step) {
    const auto file = scratch.write(name, whole.substr(0, bytes));
    try {
      const Record record = read(file);
      EXPECT_EQ(record.samples, kSmall) << name << " cut to " << bytes << " of " << whole.size() << " bytes";
    } catch (const InputError& error) {
      ++refused;
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(refused, 0.8 * static_cast<double>(whole.size()) / static_cast<double>(step)) << name;
}

TEST(CutFiles, MatVersions4And5) {
  const Scratch scratch;
  for (const bool compressed : {false, true}) {
    write_mat(scratch.file("a.mat"), kSmall, MAT_FT_MAT5, compressed);
    expect_cuts_seen(scratch, "a.mat", content_of(scratch.file("a.mat")), 1);
  }
  mat_t* mat = Mat_CreateVer(scratch.file("4.mat").c_str(), nullptr, MAT_FT_MAT4);
  add_variable(mat, "acc", kSmall, MAT_COMPRESSION_NONE);
  Mat_Close(mat);
  expect_cuts_seen(scratch, "4.mat", content_of(scratch.file("4.mat")), 1);
}

TEST(CutFiles, Mat73AndNpy) {
  const Scratch scratch;
  write_mat(scratch.file("a.mat"), kSmall, MAT_FT_MAT73, true);
  expect_cuts_seen(scratch, "a.mat", content_of(scratch.file("a.mat")), 7);
  io::write_npy(kSmall, scratch.file("a.npy"));
  expect_cuts_seen(scratch, "a.npy", content_of(scratch.file("a.npy")), 1);
}

TEST(CutFiles, UniversalFilesLoseNoChannelWithoutAWord) {
  const Scratch scratch;
  for (const bool binary : {false, true}) {
    const std::string whole = universal_58(kSmall, 128.0, binary);
    for (std::size_t bytes = 8; bytes < whole.size(); ++bytes) {
      // Every cut near the end of a set, every fifth elsewhere.
      if (bytes % 5 != 0 && whole.substr(bytes - 8, 30).find("    -1") == std::string::npos) continue;
      const auto file = scratch.write("a.uff", whole.substr(0, bytes));
      std::string said = refusal(file);
      if (!said.empty()) {
        EXPECT_TRUE(said.find("breaks off") != std::string::npos || said.find("a.uff:") != std::string::npos) << said;
        continue;
      }
      // Read: then the file ends exactly after a set, which nothing in it gives away but the number of channels, or a note
      // tells.
      const RecordInfo info = read(file).info;
      const bool told = std::any_of(info.notes.begin(), info.notes.end(),
                                    [](const std::string& note) { return note.find("has no end") != std::string::npos; });
      const std::string rest = whole.substr(bytes);
      EXPECT_TRUE(told || rest.find_first_not_of('\n') == std::string::npos || rest.starts_with("    -1\n    58") ||
                  rest.starts_with("\n    -1\n    58"))
          << bytes << ": " << rest.substr(0, 30);
      for (const ChannelInfo& channel : info.channels) EXPECT_EQ(channel.samples, kSmall.rows());
      const Eigen::MatrixXd samples = read(file).samples;
      EXPECT_EQ(samples, Eigen::MatrixXd(kSmall.leftCols(samples.cols()))) << bytes;
    }
  }
}

TEST(CutFiles, AUniversalFileWithoutADelimiterKeepsItsSets) {
  const Scratch scratch;
  const std::string whole = universal_58(kSmall, 128.0, false);
  // One -1 both ends a set and begins the next, as some programs write.
  std::string shared = whole;
  const std::size_t two = shared.find("    -1\n    -1\n");
  shared.erase(two, 7);
  const Record record = read(scratch.write("shared.uff", shared));
  EXPECT_EQ(record.samples, kSmall);
  // A line that is neither: the set after it must not be skipped.
  std::string stray = whole;
  stray.insert(two + 7, "written by hand\n");
  EXPECT_NE(refusal(scratch.write("stray.uff", stray)).find("holds 'written by hand' between two sets, expected -1"),
            std::string::npos);
  std::string words = whole;
  words.replace(words.find('E', words.rfind("NONE") + 4), 4, "EoO1");
  const std::string said = refusal(scratch.write("words.uff", words));
  EXPECT_NE(said.find("expected numbers"), std::string::npos) << said;
  // The line is counted as an editor counts it.
  const std::size_t line =
      1 + static_cast<std::size_t>(std::count(words.begin(), words.begin() + static_cast<long>(words.find("EoO")), '\n'));
  EXPECT_NE(said.find(fmt::format("words.uff:{}: ", line)), std::string::npos) << said;
}

TEST(Damaged, ACompressedArrayWithAnotherChecksumIsRefused) {
  const Scratch scratch;
  write_mat(scratch.file("a.mat"), kSmall, MAT_FT_MAT5, true);
  const std::string whole = content_of(scratch.file("a.mat"));
  std::uint32_t bytes = 0;
  std::memcpy(&bytes, whole.data() + 132, 4);
  std::size_t wrong = 0;
  for (std::size_t at = 136; at < 136 + bytes; ++at) {
    std::string turned = whole;
    turned[at] = static_cast<char>(turned[at] ^ 0x10);
    const auto file = scratch.write("b.mat", turned);
    if (refusal(file).empty() && read(file).samples != kSmall) ++wrong;
  }
  EXPECT_EQ(wrong, 0U);
}

/// Sizes in a header are held against the file before anything is allocated: were they used, these would end in bad_alloc.
TEST(Damaged, SizesThatCannotBe) {
  const Scratch scratch;
  write_mat(scratch.file("a.mat"), kSmall, MAT_FT_MAT5, false);
  std::string five = content_of(scratch.file("a.mat"));
  for (const std::size_t word : {160U, 164U}) {  // rows, columns
    std::string absurd = five;
    const std::int32_t size = 0x7FFFFFF0;
    std::memcpy(absurd.data() + word, &size, 4);
    EXPECT_NE(refusal(scratch.write("b.mat", absurd)).find("with 288 bytes of data, expected 8 a value"), std::string::npos);
  }
  mat_t* mat = Mat_CreateVer(scratch.file("4.mat").c_str(), nullptr, MAT_FT_MAT4);
  add_variable(mat, "acc", kSmall, MAT_COMPRESSION_NONE);
  Mat_Close(mat);
  std::string four = content_of(scratch.file("4.mat"));
  const std::int32_t size = 0x7FFFFFF0;
  std::memcpy(four.data() + 4, &size, 4);
  EXPECT_NE(refusal(scratch.write("4.mat", four)).find("4.mat: breaks off in variable number 1"), std::string::npos);
  std::string universal = universal_58(kSmall, 128.0, true);
  for (const char* values : {" 999999999", "     1E300", "        -5", "         0", "       2.5"}) {
    std::string absurd = universal;
    absurd.replace(absurd.find("         4        12") + 10, 10, values);
    EXPECT_NE(refusal(scratch.write("a.uff", absurd)).find("a.uff:9: states "), std::string::npos)
        << values << refusal(scratch.file("a.uff"));
  }
}

TEST(Damaged, BytesChangedAtRandomAreRefusedOrRead) {
  const Scratch scratch;
  write_mat(scratch.file("5.mat"), kSmall, MAT_FT_MAT5, false);
  write_mat(scratch.file("5c.mat"), kSmall, MAT_FT_MAT5, true);
  mat_t* mat = Mat_CreateVer(scratch.file("4.mat").c_str(), nullptr, MAT_FT_MAT4);
  add_variable(mat, "acc", kSmall, MAT_COMPRESSION_NONE);
  Mat_Close(mat);
  io::write_npy(kSmall, scratch.file("a.npy"));
  scratch.write("t.uff", universal_58(kSmall, 128.0, false));
  scratch.write("b.uff", universal_58(kSmall, 128.0, true));
  std::string csv = "time_s,A_x [g],B_x,C_z\n";
  for (Eigen::Index t = 0; t < kSmall.rows(); ++t)
    csv += fmt::format("{:.3f},{},{},{}\n", 0.01 * static_cast<double>(t), kSmall(t, 0), kSmall(t, 1), kSmall(t, 2));
  scratch.write("a.csv", csv);
  std::mt19937 random(18);
  for (const char* name : {"5.mat", "5c.mat", "4.mat", "a.npy", "t.uff", "b.uff", "a.csv"}) {
    const std::string sound = content_of(scratch.file(name));
    for (int trial = 0; trial < 400; ++trial) {
      std::string turned = sound;
      // Headers are where damage does most: every other change falls into the first 300 bytes.
      for (unsigned k = 0, n = 1 + random() % 4; k < n; ++k) {
        turned[random() % (trial % 2 == 0 ? turned.size() : std::min<std::size_t>(turned.size(), 300))] =
            static_cast<char>(random());
      }
      if (trial % 5 == 0) turned.resize(random() % turned.size() + 1);
      const auto file = scratch.write(std::string("x") + name, turned);
      EXPECT_NO_THROW({
        const std::string said = refusal(file);
        for (const char c : said) EXPECT_GE(static_cast<unsigned char>(c), 0x20U) << said;
        try {
          for (const std::string& line : describe(inspect(file)))
            EXPECT_EQ(line.find_first_of(std::string("\0\x1b\n", 3)), std::string::npos);
        } catch (const InputError&) {
        }
      }) << name
         << ", trial " << trial;
    }
  }
}

TEST(Damaged, Hdf5ChunkThatTakesMoreThanTheFileIsRefusedBeforeItIsRead) {
  // A file found by make fuzz: one chunk of 4 GB, for which the library would ask for as much memory.
  const Scratch scratch;
  std::filesystem::copy_file(std::filesystem::path(TWINDECK_SOURCE_DIR) / "tests/fuzz/corpus/record_hdf5/chunk_beyond_the_file",
                             scratch.file("chunk.h5"));
  EXPECT_NE(refusal(scratch.file("chunk.h5")).find("takes more bytes than the file has"), std::string::npos)
      << refusal(scratch.file("chunk.h5"));
}

TEST(Damaged, Hdf5FileThatBreaksTheLibraryIsRefused) {
  // Found by make fuzz: HDF5 1.10.8 copies to address zero. A later library may read the file or refuse it; none may end this
  // program.
  const Scratch scratch;
  std::filesystem::copy_file(std::filesystem::path(TWINDECK_SOURCE_DIR) / "tests/fuzz/corpus/record_hdf5/breaks_the_library",
                             scratch.file("broken.h5"));
  EXPECT_NE(refusal(scratch.file("broken.h5")).find("broken.h5"), std::string::npos);
}

TEST(Survives, WhatEndsByItselfAndWhatThrowsButNoCrash) {
  EXPECT_TRUE(survives([] {}));
  EXPECT_TRUE(survives([] { throw std::runtime_error("the caller sees it"); }));
  EXPECT_FALSE(survives([] { std::raise(SIGSEGV); }));
  EXPECT_FALSE(survives([] { std::abort(); }));
}

TEST(Damaged, PipesAndDevicesAreRefused) {
  const Scratch scratch;
  ASSERT_EQ(::mkfifo(scratch.file("pipe.csv").c_str(), 0600), 0);
  EXPECT_NE(refusal(scratch.file("pipe.csv")).find("pipe.csv: is a pipe"), std::string::npos);
  EXPECT_NE(refusal("/dev/zero").find("/dev/zero: is a pipe, a socket or a device, expected a regular file"),
            std::string::npos);
  EXPECT_NE(refusal("/dev/stdin").find("/dev/stdin: "), std::string::npos);
  EXPECT_NE(refusal(scratch.file("")).find("is a folder"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::records
