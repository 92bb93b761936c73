#pragma once

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/inertia.hpp"
#include "output/output.hpp"

namespace contensou::program {

/// Numbers from least to most in equal steps, or in equal ratios; both ends are among them.
struct Range {
  double least, most;
  long count = 1;
  bool in_ratios = false;

  /// The number at a place from 0 to count - 1, rounded once where long double has digits to spare.
  double operator[](long place) const;
};

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
///   npy  NumPy's format 1.0: float64, shape (v0, u0), or (mu, v0, u0) if mu is a range
///   csv  columns mu,u0,v0,tau_stop
///
/// @param output  not finished here
/// @throws BadInput     if the array would be larger than any file
/// @throws FileFailure  if there is no room for it
void sweep(const SweepRequest& request, OutputFile& output);

}  // namespace contensou::program
