#pragma once

namespace twindeck::linalg {

/// Holds the dense kernels under CHOLMOD and Eigen to one thread: a sum split between threads is a different sum, and results
/// must not depend on how many there are. Does nothing where the BLAS is not OpenBLAS. Cheap, may be called again.
void use_one_thread();

/// While it lives, OpenMP regions that the calling thread meets run on that thread alone. CHOLMOD opens regions of four threads
/// of its own for each supernode, whatever the caller asked for; where cores are fewer or busy, waking them costs more than the
/// factorisation.
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
