#pragma once

#include <optional>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/inertia.hpp"
#include "input/range.hpp"
#include "output/output.hpp"
#include "output/progress.hpp"

namespace contensou::program {

/// The starts of a sweep: every mu with every v0 with every u0. Their order is that of a C array, u0 the fastest.
struct SweepGrid {
  Range mu;
  bool mu_is_range;  ///< whether the array has an axis for it
  Range u0;
  Range v0;

  /// Also where it would not fit an integer.
  double points() const;
};

enum class SweepFormat { npy, csv };

/// How a sweep is computed.
struct SweepRequest {
  reduction::Law law;
  reduction::Inertia body;
  SweepGrid grid;
  SweepFormat format;
  int threads = 1;
  bool progress = false;
};

/// Writes the stop times of all starts in the memory of a few blocks of them; the bytes do not depend on the number of
/// threads.
///   npy  float64, shape (v0, u0), or (mu, v0, u0) if mu is a range
///   csv  columns mu,u0,v0,tau_stop
///
/// @param output  not finished here
/// @throws BadInput     if the array would be larger than any file
/// @throws FileFailure  if there is no room for it
void sweep(const SweepRequest& request, OutputFile& output);

}  // namespace contensou::program
