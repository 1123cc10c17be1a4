#pragma once

namespace twindeck::steps {

/// Sets the number of threads of our own parallel loops and returns it; 0 means all of the machine's.
///
/// BLAS and Eigen always get one thread: how they cut a product into blocks depends on the number of threads, and with it the
/// last digits of the result; our own loops sum in a fixed order. Private to run_step.
int set_threads(int asked);

}  // namespace twindeck::steps
