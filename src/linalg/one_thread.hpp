#pragma once

#include <cstddef>

namespace twindeck::linalg {

/// Limits OpenBLAS to one thread. A sum that is split between threads is rounded differently, and results must not depend on
/// the number of threads. Does nothing if the BLAS is not OpenBLAS. Cheap; may be called repeatedly and from several threads:
/// the first call sets the limit. Eigen needs none: no source that includes it is compiled with OpenMP.
void use_one_thread();

/// [bytes] Working memory that OpenBLAS takes for each thread that calls it: address space, of which it uses a small part.
constexpr std::size_t blas_memory_bytes = std::size_t{128} << 20U;

/// Takes OpenBLAS's working memory for `threads` threads at once, before the data fill the memory. If OpenBLAS gets no memory
/// later, it asks again without end. The memory is kept for later calls. Does nothing if the BLAS is not OpenBLAS.
/// @return false if this process may not use so much memory (ulimit -v); nothing was taken then
[[nodiscard]] bool reserve_blas_memory(int threads);

/// During its lifetime, OpenMP regions that the calling thread enters run on that thread alone. CHOLMOD opens a region of four
/// threads for each supernode, whatever the caller asked for. If cores are few or busy, starting these threads costs more than
/// the factorisation.
class SerialScope {
 public:
  SerialScope();
  ~SerialScope();
  SerialScope(const SerialScope&) = delete;
  SerialScope& operator=(const SerialScope&) = delete;

 private:
  int levels_;
};

}  // namespace twindeck::linalg
