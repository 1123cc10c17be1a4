#pragma once

namespace twindeck::runner {

/// Sets the number of threads of our own parallel loops and returns it. 0 means one per processor, or fewer where the memory
/// that this process may use is limited (ulimit -v).
///
/// BLAS and Eigen always use one thread: their division of a product into blocks, and so the last digits of the result, depend
/// on the number of threads. Our own loops sum in a fixed order. Private to run_step.
///
/// @throws InputError  where the machine or its limits do not give the threads, their stacks or the working memory of BLAS
int set_threads(int asked);

}  // namespace twindeck::runner
