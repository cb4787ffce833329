/// Fills tables of energies.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace candil {

/// Calls function(row) for each row of a table, on all threads. A thread that waits for the others takes no other work
/// meanwhile: that could ask for the same table, which is being made.
template <typename Function>
void for_each_row(int count, const Function& function) {
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(0, count, function); });
}

}  // namespace candil
