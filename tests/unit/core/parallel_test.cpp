#include "core/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"

namespace twindeck {
namespace {

/// Four threads, whatever the machine has, and the earlier number afterwards.
class Parallel : public testing::Test {
 protected:
  void SetUp() override { set_thread_count(4); }
  void TearDown() override { set_thread_count(before_); }

 private:
  int before_ = thread_count();
};

/// What parallel_for throws where work throws at each of `bad`, the low ones latest in time; "" when it throws nothing.
std::string thrown_where(const std::vector<int>& bad, int count, std::vector<std::atomic<int>>& calls) {
  try {
    parallel_for(count, [&](int i) {
      ++calls[static_cast<std::size_t>(i)];
      for (const int one : bad) {
        if (one != i) continue;
        std::this_thread::sleep_for(std::chrono::milliseconds(20 * (count - i)));
        throw InputError({"", 0, std::to_string(i)}, "is bad");
      }
    });
  } catch (const InputError& error) {
    return error.place().key;
  }
  return "";
}

// Oracle: the sum of squares below n is (n - 1) n (2 n - 1) / 6; each index once, whatever the chunk.
TEST_F(Parallel, CallsEachIndexOnce) {
  for (const int chunk : {1, 3, 8, 1000}) {
    std::vector<std::atomic<int>> calls(101);
    parallel_for(
        calls.size(), [&](std::size_t i) { ++calls[i]; }, chunk);
    for (const std::atomic<int>& one : calls) EXPECT_EQ(one, 1);
  }
  std::vector<long> square(101);
  parallel_for(square.size(), [&](std::size_t i) { square[i] = static_cast<long>(i * i); });
  EXPECT_EQ(std::accumulate(square.begin(), square.end(), 0L), 100L * 101L * 201L / 6L);
  parallel_for(0, [](int) { FAIL() << "nothing to do"; });
}

// Oracle: two tasks that wait for each other end only where they run at the same time.
TEST_F(Parallel, RunsSideBySide) {
  std::atomic<int> here = 0;
  parallel_for(2, [&](int) {
    ++here;
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (here < 2 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
  });
  EXPECT_EQ(here, 2);
  EXPECT_EQ(thread_count(), 4);
}

// Oracle: of indices 2, 3 and 7 the lowest is thrown, although it throws last in time; and all below it were called.
TEST_F(Parallel, ThrowsTheExceptionOfTheLowestIndex) {
  for (const int threads : {1, 2, 4, 16}) {
    set_thread_count(threads);
    std::vector<std::atomic<int>> calls(8);
    EXPECT_EQ(thrown_where({7, 3, 2}, 8, calls), "2") << threads << " threads";
    for (int i = 0; i <= 2; ++i) EXPECT_EQ(calls[static_cast<std::size_t>(i)], 1) << i;
  }
  std::vector<std::atomic<int>> calls(8);
  EXPECT_EQ(thrown_where({}, 8, calls), "");
}

// Oracle: what comes after an exception is not begun: of 10000 tasks of 1 ms far fewer than all have run.
TEST_F(Parallel, LeavesOutWhatComesAfterAnException) {
  std::atomic<int> calls = 0;
  const auto work = [&](int i) {
    ++calls;
    if (i == 0) throw std::runtime_error("first");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  EXPECT_THROW(parallel_for(10000, work), std::runtime_error);
  EXPECT_LT(calls, 5000);
}

// Oracle: an inner loop calls each of its indices on the thread that called it, and its exception reaches the outermost caller.
TEST_F(Parallel, NestsOnTheCallingThread) {
  std::vector<std::atomic<int>> calls(6 * 5);
  parallel_for(6, [&](int i) {
    const std::thread::id own = std::this_thread::get_id();
    parallel_for(5, [&](int j) {
      EXPECT_EQ(std::this_thread::get_id(), own);
      ++calls[static_cast<std::size_t>(5 * i + j)];
    });
  });
  for (const std::atomic<int>& one : calls) EXPECT_EQ(one, 1);
  const auto nested = [](int i) {
    parallel_for(5, [i](int j) {
      if (i == 4 && j == 3) throw InputError({"", 0, "inner"}, "is bad");
    });
  };
  EXPECT_THROW(parallel_for(6, nested), InputError);
  parallel_for(6, [](int) {});  // works on after an exception
}

/// Room that no two tasks may be in at the same time; neither copied nor moved.
struct Room {
  explicit Room(std::atomic<int>& made) { ++made; }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;
  int uses = 0;
  std::atomic<bool> taken = false;
};

// Oracle: at most one room a thread, none used by two tasks at once, and as many uses as indices.
TEST_F(Parallel, GivesEachThreadItsOwnRoom) {
  std::atomic<int> made = 0, uses = 0;
  std::atomic<bool> shared = false;
  const auto use = [&](Room& room, int) {
    if (room.taken.exchange(true)) shared = true;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    ++room.uses, ++uses;
    room.taken = false;
  };
  parallel_for_with(
      200, [&] { return Room(made); }, use);
  EXPECT_FALSE(shared);
  EXPECT_EQ(uses, 200);
  EXPECT_GE(made, 1);
  EXPECT_LE(made, 4);
  const auto no_room = []() -> int { throw std::bad_alloc(); };
  EXPECT_THROW(parallel_for_with(8, no_room, [](int&, int) {}), std::bad_alloc);
}

}  // namespace
}  // namespace twindeck
