#pragma once

namespace contensou::portraits {

/// An axis of v from height 0 at the stop to height 1 at the speed `top`: h = (x + x^s)/2 with x = v/top.
///
/// The term x shows sliding, while v falls and u hardly changes. The term x^s shows the approach to the stop. There k =
/// v/(mu |u|) tends to 0, the force Phi to Phi'(0) k and the moment Psi to Psi(0). The equations of motion (2.6) give d
/// ln|u|/d ln v = r k Psi/Phi, which tends to s = r Psi(0)/Phi'(0). Therefore |u| falls like v^s, and in x^s every
/// orbit is straight at the origin. For s = 1 the axis is linear.
struct SpeedScale {
  double top;
  double exponent = 1;  ///< s, in (0, 1]

  bool linear() const { return exponent == 1; }
  double height(double ln_v) const;
  double slope(double ln_v) const;  ///< returns d height/d ln v
  double ln_v(double height) const;
};

}  // namespace contensou::portraits
