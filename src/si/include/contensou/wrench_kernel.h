/// The wrench of a contact patch in one header, for programs without the library and for CUDA: C++17, <cmath> alone. No
/// function allocates or throws. In CUDA all run on host and device. contensou/si/wrench.hpp describes the law.
///
///     const auto [fx, fy, m] = contensou::kernel::wrench<contensou::kernel::Exact>(vx, vy, w, f * N, radius);
#pragma once

#include <cmath>

#if defined(__CUDACC__) || defined(__HIPCC__)
#define CONTENSOU_HOST_DEVICE __host__ __device__
#else
#define CONTENSOU_HOST_DEVICE
#endif

namespace contensou::kernel {

/// Friction of a patch on a body: force in N, moment about the normal in N m.
template <class T>
struct Wrench {
  T fx, fy, m;
};

/// Force and moment with their derivatives. Rows: fx, fy, m; columns: vx, vy in m/s and w in rad/s.
template <class T>
struct WrenchSlopes {
  T fx, fy, m;
  T slopes[3][3];
};

/// Speeds of a patch in one unit.
template <class T>
struct Slip {
  T sliding;  ///< v of the patch centre, >= 0
  T p, r;     ///< sliding and rim speed divided by the larger of both
  T gap;      ///< |v^2 - rim^2|
  T y;        ///< 1 - (smaller/larger)^2
};

/// Friction at a slip. A type is a law if it returns this of a Slip.
template <class T>
struct Friction {
  T force;         ///< Phi/p, where the force is f N Phi
  T moment;        ///< Psi/r, where the moment is f N radius Psi
  T force_slope;   ///< a in dPhi = a (r dp - p dr)
  T moment_slope;  ///< b in dPsi = -b (r dp - p dr)
};

/// Returns c0 + c1 x + c2 x^2 + ... by groups of four, which do not wait for each other.
template <class T, class... More>
CONTENSOU_HOST_DEVICE constexpr T polynomial(T x, T square, double c0, double c1, double c2, double c3, More... more) {
  const T sum = static_cast<T>(c0) + static_cast<T>(c1) * x + (static_cast<T>(c2) + static_cast<T>(c3) * x) * square;
  if constexpr (sizeof...(more) == 0) {
    return sum;
  } else {
    return sum + square * square * polynomial(x, square, more...);
  }
}

// tests/si/wrench_kernel.py derives the numbers in Exact and Uniform. They are within 1e-16 of the law.

/// Hertz's pressure, (1 - rho^2)^(1/2).
struct Exact {
  template <class T>
  CONTENSOU_HOST_DEVICE Friction<T> operator()(const Slip<T>& at) const {
    if (at.p < at.r) {
      const T s = at.p * at.p, unit = static_cast<T>(0.29452431127404312), c = unit * (4 - 3 * s);  // 3 pi/32
      return {unit * (4 - s), unit * (2 - s * (2 - static_cast<T>(0.75) * s)), c, c * at.p};
    }
    const T q = std::sqrt(at.gap), v = at.sliding;
    const T x = (q - static_cast<T>(0.41421356237309505) * v) / (q + static_cast<T>(2.4142135623730950) * v),
            x2 = x * x;
    const T g = polynomial(x, x2, 0.9071125286736317, 0.30425457749546636, 1.1551906332175033, 1.1449807610049823,
                           0.7563633902936407, 1.4866726675325146, 0.4958622190578202, 1.7214634834500315,
                           0.29468110475215387, 1.907691786507437, 0.12688185317068487, 2.065912842354644,
                           -0.0173887907824959, 2.1892388935102525, -0.184780075289385, 2.6397294344366022);
    const T c = polynomial(x, x2, 0.2596975262247793, -0.3206869212235045, -0.3360017295426326, 1.401431607477617,
                           -2.7468418160429025, 4.330171001887282, -6.119035992574208, 8.093614909711174,
                           -10.237654693981968, 12.539212345733436, -14.98810957931447, 17.576182266857984,
                           -20.295928234993998, 23.142044342661467, -26.126350845614272, 29.21053186837435,
                           -31.90065766821959, 35.164890287544374, -46.61997905823398, 50.72581028356366);
    return {g, (g - at.y * c) / 4, c * at.r, c};
  }
};

/// Uniform pressure over the patch.
struct Uniform {
  template <class T>
  CONTENSOU_HOST_DEVICE Friction<T> operator()(const Slip<T>& at) const {
    const T y = at.y;
    T g = 0, c = 0;
    if (y >= static_cast<T>(0.7)) {
      const T x = (y - static_cast<T>(0.83666002653407555)) / (y + static_cast<T>(0.83666002653407555)), x2 = x * x;
      g = polynomial(x, x2, 0.9791426852962801, 0.2184300936437155, 0.16686310263675963, 0.14644454232587734,
                     0.13052662878943747, 0.11999910993431816, 0.11121720929183494, 0.10450481514259446,
                     0.09866909329231978, 0.09390364384865552, 0.09167894200204739, 0.08799690759852175);
      c = polynomial(x, x2, 0.26107389706255946, -0.12326868589782627, -0.011580199386036001, -0.02729248709901724,
                     -0.005837322138450202, -0.012647632177126571, -0.0036775663447606377, -0.007492180884741245,
                     -0.0025929103071458534, -0.005035550175553556, -0.0019950390258439295, -0.0037250038746010593);
    } else {
      const T y2 = y * y, by_log = y > 0 ? y * std::log(y) : 0;
      g = polynomial(y, y2, 0.8488263631567752, 0.21220659078919213, 0.03135972629977761, 0.012673731430877045,
                     0.0068524332145976155, 0.0036971472715608194, -0.0049357598643536135, -0.03352391963807575,
                     -0.05340778579084518, -0.022865171723198054, -0.0009215808526156923, 3.822600504531261e-05) +
          y * by_log *
              polynomial(y, y2, 0.07957747153302237, 0.09947182259008312, 0.10879395026009595, 0.11405740002779263,
                         0.1145378242830845, 0.09702119247155407, 0.049801196004658536, 0.009022594458315516);
      c = polynomial(y, y2, 0.4244131815783876, 0.28459384872993243, 0.27498668366847984, 0.2725376614255451,
                     0.27155343704517915, 0.2699596306749284, 0.24743842999014526, 0.07169557415345758,
                     -0.4552033256505265, -0.85780998332887, -0.48569931510069797, -0.06846582325966477) +
          by_log * polynomial(y, y2, 0.3183098861837882, 0.5968310365719737, 0.8703785739947558, 1.1423674453801438,
                              1.413379486550398, 1.6764581076201643, 1.8595180374797047, 1.6939749945201164,
                              0.9839100440107605, 0.2615716338556759, 0.01830935030455892, -0.00016663754900414547);
    }
    if (at.p < at.r) {
      const T z = at.p * at.p, inner = g - z * c;
      return {g, (g + y * inner) / 3, inner, inner * at.p};
    }
    return {g, (g - y * c) / 3, c * at.r, c};
  }
};

/// An ellipse as limit surface, Phi^2 + (Psi/C)^2 = 1.
struct Elliptic {
  double c = 0.58904862254808623;  ///< C = Psi(0), by default of Hertz's pressure, 3 pi/16

  template <class T>
  CONTENSOU_HOST_DEVICE Friction<T> operator()(const Slip<T>& at) const {
    const T square = static_cast<T>(c) * static_cast<T>(c), g = 1 / std::sqrt(at.p * at.p + square * at.r * at.r),
            cube = square * g * g * g;
    return {g, square * g, cube * at.r, cube * at.p};
  }
};

/// The paper's approximation of Exact, Phi = 3 pi k/(8 + 3 pi k), Psi = 3 pi/(16 + 15 pi k).
struct Pade {
  template <class T>
  CONTENSOU_HOST_DEVICE Friction<T> operator()(const Slip<T>& at) const {
    const T scale = static_cast<T>(0.84882636315677512);  // 8/(3 pi)
    const T g = 1 / (scale * at.r + at.p), h = 1 / (2 * scale * at.r + 5 * at.p);
    return {g, h, scale * g * g, 5 * h * h};
  }
};

/// Computes the friction of `wrench`, its slopes only if asked for.
template <bool with_slopes, class Law, class T>
CONTENSOU_HOST_DEVICE WrenchSlopes<T> friction_of_patch(T vx, T vy, T w, T limit, T radius, T creep, const Law& law) {
  WrenchSlopes<T> result{};
  if (!(limit > 0)) return result;
  const auto larger = [](T a, T b) { return a < b ? b : a; };
  T slip = larger(larger(std::fabs(vx), std::fabs(vy)), creep), rim = std::fabs(radius * w);
  int exponent = 0;
  if (const T size = larger(slip, rim); !(size > static_cast<T>(1e-15) && size < static_cast<T>(1e15))) {
    // Scale all speeds by a power of 2, so that no square and no product overflows.
    int of_slip = 0, of_radius = 0, of_w = 0;
    slip = std::frexp(slip, &of_slip);
    rim = std::fabs(std::frexp(radius, &of_radius) * std::frexp(w, &of_w));
    if (!(slip > 0 || rim > 0)) return result;
    exponent = of_radius + of_w;
    if (!(rim > 0) || (slip > 0 && of_slip > exponent)) exponent = of_slip;
    vx = std::ldexp(vx, -exponent), vy = std::ldexp(vy, -exponent), creep = std::ldexp(creep, -exponent);
    rim = std::ldexp(rim, of_radius + of_w - exponent);
  }
  const T square = vx * vx + vy * vy + creep * creep, sliding = std::sqrt(square), gap = std::fabs(square - rim * rim);
  const bool slides = sliding > rim;
  const T per = 1 / (slides ? sliding : rim), p = slides ? 1 : sliding * per, r = slides ? rim * per : 1;
  const Friction<T> friction = law(Slip<T>{sliding, p, r, gap, gap * per * per});
  const T x = vx * per, y = vy * per, turn = w < 0 ? -r : r;
  result.fx = -limit * (friction.force * x);
  result.fy = -limit * (friction.force * y);
  result.m = -friction.moment * (limit < 1 ? limit * radius * turn : limit * turn * radius);
  if constexpr (with_slopes) {
    const T along_x = sliding > 0 ? vx / sliding : 0, along_y = sliding > 0 ? vy / sliding : 0;
    const T arm = w < 0 ? -radius : radius, falls = friction.force - friction.force_slope * r;
    const T weight = limit < 1 ? limit * per : per, rest = limit < 1 ? 1 : limit;  // so that little overflows
    const auto scaled = [&](T slope, T first, T second) {
      slope = slope * weight * first * second * rest;
      return exponent == 0 ? slope : std::ldexp(slope, -exponent);
    };
    const T across = scaled(falls * along_x * along_y, 1, 1), turns = friction.moment_slope * r;
    result.slopes[0][0] = scaled(falls * along_x * along_x - friction.force, 1, 1);
    result.slopes[0][1] = result.slopes[1][0] = across;
    result.slopes[1][1] = scaled(falls * along_y * along_y - friction.force, 1, 1);
    result.slopes[0][2] = scaled(friction.force_slope * x, arm, 1);
    result.slopes[1][2] = scaled(friction.force_slope * y, arm, 1);
    result.slopes[2][0] = scaled(turns * along_x, arm, 1);
    result.slopes[2][1] = scaled(turns * along_y, arm, 1);
    result.slopes[2][2] = scaled(-friction.moment_slope * p, radius, radius);
  }
  return result;
}

/// Returns force and moment of friction, 0 at rest. The power fx vx + fy vy + m w is never positive.
/// @param vx, vy  velocity of the patch centre over the other body in m/s
/// @param w       angular velocity about the normal in rad/s
/// @param limit   f N in newtons; for 0 or less there is no contact, and all is 0
/// @param radius  of the patch in m, >= 0
/// @param creep   speed in m/s, >= 0, below which friction is viscous (contensou/si/wrench.hpp); 0: dry friction
template <class Law, class T>
CONTENSOU_HOST_DEVICE Wrench<T> wrench(T vx, T vy, T w, T limit, T radius, T creep = 0, const Law& law = {}) {
  const WrenchSlopes<T> found = friction_of_patch<false>(vx, vy, w, limit, radius, creep, law);
  return {found.fx, found.fy, found.m};
}

/// Returns force, moment and their nine slopes. At rest without creep, the slopes are 0. Parameters as in `wrench`.
template <class Law, class T>
CONTENSOU_HOST_DEVICE WrenchSlopes<T> wrench_slopes(T vx, T vy, T w, T limit, T radius, T creep = 0,
                                                    const Law& law = {}) {
  return friction_of_patch<true>(vx, vy, w, limit, radius, creep, law);
}

}  // namespace contensou::kernel
