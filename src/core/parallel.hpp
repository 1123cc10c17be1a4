#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace twindeck {

/// Sets how many threads parallel_for uses (at least 1) when the calling thread starts it.
void set_thread_count(int threads);
/// How many threads parallel_for uses. Without set_thread_count it is as many as the machine has, or as OMP_NUM_THREADS says.
[[nodiscard]] int thread_count();
/// How many processors this process may use.
[[nodiscard]] int processor_count();

namespace parallel_detail {

/// Calls work(context, thread, i) for i = 0 … count - 1; see parallel_for. `thread` is below thread_count() at the time of the
/// call, and two calls with the same number never run at the same time.
void run(std::ptrdiff_t count, std::ptrdiff_t chunk, void (*work)(void* context, int thread, std::ptrdiff_t i), void* context);

}  // namespace parallel_detail

/// Calls work(i) for i = 0 … count - 1, side by side on thread_count() threads.
///
/// Threads take `chunk` indices at a time, in increasing order, whenever they are free. Each index must write to places of its
/// own; sums over indices are taken by the caller afterwards, in the order of the indices, so that the number of threads
/// changes no digit. Where it is called within another parallel_for it runs on the calling thread alone.
///
/// @throws what work throws, when all threads have stopped. Where several indices throw, it is the exception of the lowest one:
///         indices above one that has thrown are left out, indices below it still run. So the exception, too, is the same
///         whatever the number of threads.
template <typename Index, typename Work>
void parallel_for(Index count, Work&& work, std::ptrdiff_t chunk = 1) {
  using Callable = std::remove_reference_t<Work>;
  const auto call = [](void* context, int, std::ptrdiff_t i) { (*static_cast<Callable*>(context))(static_cast<Index>(i)); };
  parallel_detail::run(static_cast<std::ptrdiff_t>(count), chunk, call, const_cast<std::remove_const_t<Callable>*>(&work));
}

/// The same for work that needs room of its own in each thread: calls work(state, i), where `state` is what make() returned
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
