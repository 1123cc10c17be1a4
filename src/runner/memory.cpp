#include "runner/memory.hpp"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace twindeck::runner {

void keep_freed_memory() {
#if defined(__GLIBC__)
  constexpr int gigabyte = 1 << 30, megabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, gigabyte);  // below it no block is mapped by itself, which freeing would undo
  mallopt(M_TRIM_THRESHOLD, gigabyte);  // so much may lie free
  mallopt(M_TOP_PAD, 64 * megabyte);    // a thread's heap grows, and stays, by so much
#endif
}

}  // namespace twindeck::runner
