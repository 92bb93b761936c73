#pragma once

#include <cstddef>
#include <functional>

namespace contensou::reduction {

/// The data of StopTimeTable's loops. Stop times are tau* = pivoting |u0| + v0 M(k0), with panels of polynomials for M.
///
/// Let v_mu = v0/mu and D = |u0| + v_mu. A start lies on one of four branches. The branches meet at k0 = v_mu/|u0| =
/// 1/2, 1 and 2. On each branch the coordinate
///   y = min(|u0|, v_mu, ||u0| - v_mu|)/D
/// is 0 at k0 = 0, 1 or infinity, at which M can be singular. The exponent of y + lowest and the first `cut_bits` bits
/// of its mantissa number the panel within the branch, so that panels become narrow towards y = 0.
struct StopTimePanels {
  static constexpr int terms = 8;
  static constexpr int cut_bits = 4;
  static constexpr int octaves = 64;
  static constexpr double lowest = 0x1p-63;  ///< smallest y + lowest; its biased exponent is 0 modulo 64
  static constexpr std::size_t per_branch = std::size_t{octaves} << cut_bits;
  /// Number of used panels of a branch, those with y <= 1/3.
  static constexpr std::size_t used = (std::size_t{octaves - 3} << cut_bits) + 6;
  static constexpr std::size_t branches = 4;
  static constexpr std::size_t near_one = per_branch;       ///< added to the number of a panel if 1/2 < v_mu/|u0| < 2
  static constexpr std::size_t above_one = 2 * per_branch;  ///< added if v_mu/|u0| > 1

  /// Coefficients of the powers of the distance y + lowest - (left edge of the panel).
  struct alignas(64) Panel {
    double c[terms];
  };

  double inverse_mu = 0;
  double pivoting = 0;            ///< P/|u0|
  const Panel* panels = nullptr;  ///< branches times per_branch; the coefficients of an unused panel are NaN

  /// Returns the stop time of a start for which the polynomial's value is not usable, and NaN for an invalid start.
  std::function<double(double u0, double v0)> otherwise;
};

/// A function that computes the stop times of starts (u0[i], v0[i]), i < size. All such functions give the same bits
/// for a start at any place in the array, because no product and sum are fused.
using StopTimeLoop = void(const StopTimePanels&, const double* u0, const double* v0, double* tau, std::size_t size);
StopTimeLoop run_plain;
#ifdef __x86_64__
StopTimeLoop run_avx2;
#endif

/// Returns the fastest loop that this processor can run.
StopTimeLoop& run_fastest();

/// Returns the stop time of one start by the polynomials; NaN if the value is not usable.
double from_panels(const StopTimePanels& table, double u0, double v0);

/// Returns the number of the panel of a start.
std::size_t panel_of(const StopTimePanels& table, double u0, double v0);

}  // namespace contensou::reduction
