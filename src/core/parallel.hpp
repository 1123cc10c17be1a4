#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <type_traits>

namespace twindeck {

/// Sets how many threads parallel_for uses (at least 1) when the calling thread starts it.
void set_thread_count(int threads);
/// Number of threads that parallel_for uses. Without set_thread_count: OMP_NUM_THREADS, or the number of processors.
[[nodiscard]] int thread_count();
/// How many processors this process may use.
[[nodiscard]] int processor_count();

namespace parallel_detail {

/// Calls work(context, thread, i) for i = 0 … count - 1; see parallel_for. `thread` is below thread_count() at the time of the
/// call, and two calls with the same number never run at the same time.
void run(std::ptrdiff_t count, std::ptrdiff_t chunk, void (*work)(void* context, int thread, std::ptrdiff_t i), void* context);

}  // namespace parallel_detail

/// Calls work(i) for i = 0 … count - 1 in parallel on thread_count() threads.
///
/// A free thread takes the next `chunk` indices, in increasing order. Each index must write to its own memory. The caller
/// sums over indices afterwards, in the order of the indices, so that results do not depend on the number of threads.
/// A call within another parallel_for runs on the calling thread alone.
///
/// @throws what work throws, after all threads have stopped. If several indices throw, the exception of the lowest index is
///         thrown: indices above an index that threw are skipped, indices below it still run. The exception is therefore
///         the same for any number of threads.
template <typename Index, typename Work>
void parallel_for(Index count, Work&& work, std::ptrdiff_t chunk = 1) {
  using Callable = std::remove_reference_t<Work>;
  const auto call = [](void* context, int, std::ptrdiff_t i) { (*static_cast<Callable*>(context))(static_cast<Index>(i)); };
  parallel_detail::run(static_cast<std::ptrdiff_t>(count), chunk, call, const_cast<std::remove_const_t<Callable>*>(&work));
}

/// The same, with told(done, count) after each index, never twice at a time.
template <typename Index, typename Work, typename Told>
void parallel_for_told(Index count, const Work& work, const Told& told) {
  std::mutex counting;
  int done = 0;
  parallel_for(count, [&](Index i) {
    work(i);
    const std::scoped_lock lock(counting);
    told(++done, static_cast<int>(count));
  });
}

/// The same for work that needs its own workspace in each thread. Calls work(state, i), where `state` is what make() returned
/// when the thread took its first index.
template <typename Index, typename Make, typename Work>
void parallel_for_with(Index count, const Make& make, const Work& work, std::ptrdiff_t chunk = 1) {
  using State = std::invoke_result_t<const Make&>;
  struct Context {
    const Make& make;
    const Work& work;
    std::unique_ptr<std::unique_ptr<State>[]> states;
  };
  Context all{make, work, std::make_unique<std::unique_ptr<State>[]>(static_cast<std::size_t>(thread_count()))};
  const auto call = [](void* context, int thread, std::ptrdiff_t i) {
    auto& [make_state, work_on, states] = *static_cast<Context*>(context);
    std::unique_ptr<State>& state = states[static_cast<std::size_t>(thread)];
    if (!state) state.reset(new State(make_state()));  // so that State needs no move
    work_on(*state, static_cast<Index>(i));
  };
  parallel_detail::run(static_cast<std::ptrdiff_t>(count), chunk, call, &all);
}

}  // namespace twindeck
