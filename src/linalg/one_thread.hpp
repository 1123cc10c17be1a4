#pragma once

namespace twindeck::linalg {

/// Holds the dense kernels under CHOLMOD and Eigen to one thread: a sum split between threads is a different sum, and results
/// must not depend on how many there are. Does nothing where the BLAS is not OpenBLAS. Cheap, may be called again.
void use_one_thread();

}  // namespace twindeck::linalg
