#pragma once

#include <malloc.h>

namespace softbody {

/// For a process that holds one body: the large arrays of a model that is replaced go back to the system at
/// once, and leave no holes in the heap. Other programs would allocate their images more slowly.
inline void keepHeapCompact() {
  constexpr int kLargeArray = 1 << 18;  // [bytes]
  mallopt(M_MMAP_THRESHOLD, kLargeArray);
}

}  // namespace softbody
