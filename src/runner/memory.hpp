#pragma once

namespace twindeck::runner {

/// Makes the C library keep freed memory for the next allocation. By default it returns large blocks to the system at once. A
/// step with many time histories of some megabytes then spends a third of its time on new pages. Does nothing if the C library
/// is not glibc.
void keep_freed_memory();

}  // namespace twindeck::runner
