#pragma once

#include <cstddef>
#include <functional>

namespace contensou::reduction {

/// What StopTimeTable's loops read: stop times tau* = pivoting |u0| + v0 M(k0), the function M as polynomials.
///
/// With v_mu = v0/mu and D = |u0| + v_mu a start lies on one of four branches, which meet at k0 = v_mu/|u0| = 1/2, 1
/// and 2, at
///   y = min(|u0|, v_mu, ||u0| - v_mu|)/D,
/// 0 where M may be singular: at k0 = 0, 1 and infinity. The exponent of y + lowest and `cut_bits` bits of its mantissa
/// number the panels of a branch: they become narrow towards y = 0.
struct StopTimePanels {
  static constexpr int terms = 8;
  static constexpr int cut_bits = 4;
  static constexpr int octaves = 64;
  static constexpr double lowest = 0x1p-63;  ///< its exponent is 0 modulo 64
  static constexpr std::size_t per_branch = std::size_t{octaves} << cut_bits;
  static constexpr std::size_t used = (std::size_t{octaves - 3} << cut_bits) + 6;  ///< of a branch: y <= 1/3
  static constexpr std::size_t branches = 4;
  static constexpr std::size_t near_one = per_branch;       ///< 1/2 < v_mu/|u0| < 2
  static constexpr std::size_t above_one = 2 * per_branch;  ///< v_mu/|u0| > 1

  /// Coefficients of the powers of y + lowest - left edge.
  struct alignas(64) Panel {
    double c[terms];
  };

  double inverse_mu = 0;
  double pivoting = 0;            ///< P/|u0|
  const Panel* panels = nullptr;  ///< branches times per_branch; of NaN where a panel is not to be used

  /// The stop time of a start for which `usable` rejects what the polynomials say: of every start that is none, too.
  std::function<double(double u0, double v0)> otherwise;
};

/// The stop times of starts (u0[i], v0[i]), i < size. No product and sum are fused, and each start is treated alike
/// wherever it stands: all these functions give the same bits.
using StopTimeLoop = void(const StopTimePanels&, const double* u0, const double* v0, double* tau, std::size_t size);
StopTimeLoop run_plain;
#ifdef __x86_64__
StopTimeLoop run_avx2;
#endif

/// The fastest that this processor can run.
StopTimeLoop& run_fastest();

/// What the polynomials say of one start; NaN if `otherwise` is to be asked.
double from_panels(const StopTimePanels& table, double u0, double v0);

/// Where a start lies: its panel, and what is left of y + lowest from the panel's left edge.
struct PlaceInPanels {
  std::size_t panel;
  double t;
};

/// @param w  mu |u0|, in the unit of v0; not both 0
PlaceInPanels place_in_panels(double w, double v0);

/// The number of the panel that it lies in.
std::size_t panel_of(const StopTimePanels& table, double u0, double v0);

}  // namespace contensou::reduction
