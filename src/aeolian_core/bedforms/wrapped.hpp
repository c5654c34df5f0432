#pragma once

namespace aeolian {

/// An index on a ring of n places, 0 to n - 1.
inline int wrapped(int i, int n) { return (i % n + n) % n; }

}  // namespace aeolian
