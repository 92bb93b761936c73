#pragma once

namespace contensou::portraits {

/// The axis of v, from height 0 at the stop to height 1 at the speed `top`: h = (x + x^s)/2 with x = v/top.
///
/// While a ball slides, v falls and u hardly: x shows that. Near the stop k = v/(mu |u|) goes to 0, where Phi is
/// Phi'(0) k and Psi is Psi(0); by (2.6) d ln|u|/d ln v = r k Psi/Phi, which goes to s = r Psi(0)/Phi'(0). So |u| falls
/// like v^s, and against x^s every orbit runs straight into the origin. With s = 1 the axis is linear.
struct SpeedScale {
  double top;
  double exponent = 1;  ///< s, in (0, 1]

  bool linear() const { return exponent == 1; }
  double height(double ln_v) const;
  double slope(double ln_v) const;  ///< d height/d ln v
  double ln_v(double height) const;
};

}  // namespace contensou::portraits
