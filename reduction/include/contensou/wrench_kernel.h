/// The wrench of a contact patch in one header, for programs without the library and for CUDA: C++17, <cmath> alone. No
/// function allocates or throws. In CUDA all functions run on host and device. Theory: contensou/si/wrench.hpp.
///
///     const auto [fx, fy, m] = contensou::kernel::wrench<contensou::kernel::Exact>(vx, vy, w, f * N, radius);
#pragma once

#include <cmath>

#if defined(__CUDACC__) || defined(__HIPCC__)
#define CONTENSOU_HOST_DEVICE __host__ __device__
#elif defined(__GNUC__)
#define CONTENSOU_HOST_DEVICE [[gnu::always_inline]] inline  // else g++ -O2 makes function calls in a polynomial
#else
#define CONTENSOU_HOST_DEVICE inline
#endif

namespace contensou::kernel {

/// Friction of a patch on a body: force in N, moment about the normal in N m.
template <class T>
struct Wrench {
  T fx, fy, m;
};

/// Force and moment with their derivatives. Rows: fx, fy, m. Columns: by vx, by vy in m/s and by w in rad/s.
template <class T>
struct WrenchSlopes {
  T fx, fy, m;
  T slopes[3][3];
};

/// Speeds of a patch in one unit.
template <class T>
struct Slip {
  T sliding;  ///< v of the patch centre, >= 0
  T p, r;     ///< sliding speed and rim speed, each divided by the larger of the two
  T gap;      ///< |v^2 - rim^2|, rim is the rim speed
  T y;        ///< 1 - (smaller speed/larger speed)^2
};

/// Friction at a slip. A type is a law if its call operator takes a Slip and returns a Friction.
template <class T>
struct Friction {
  T force;         ///< Phi/p, where the force is f N Phi
  T moment;        ///< Psi/r, where the moment is f N radius Psi
  T force_slope;   ///< slope a in dPhi = a (r dp - p dr), with p and r of Slip
  T moment_slope;  ///< slope b in dPsi = -b (r dp - p dr)
};

/// Returns c0 + c1 x + c2 x^2 + ..., summed in groups of four terms that the processor can compute in parallel.
template <class T, class... More>
CONTENSOU_HOST_DEVICE constexpr T polynomial(T x, T square, double c0, double c1, double c2, double c3, More... more) {
  const T sum = static_cast<T>(c0) + static_cast<T>(c1) * x + (static_cast<T>(c2) + static_cast<T>(c3) * x) * square;
  if constexpr (sizeof...(more) == 0) {
    return sum;
  } else {
    return sum + square * square * polynomial(x, square, more...);
  }
}

// The numbers in Exact and Uniform come from tests/si/wrench_kernel.py. Before they are rounded, values are within
// 1e-16 of the law and slopes within 4e-16.

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
    T g = 0, h = 0, c = 0;  // for k = p/r > 1 the result is {g, h, c r, c}
    if (y >= static_cast<T>(0.5)) {
      const T x = (y - static_cast<T>(0.70710678118654752)) / (y + static_cast<T>(0.70710678118654752)), x2 = x * x;
      g = polynomial(x, x2, 0.96190659426731, 0.19187552486001952, 0.149084065720948, 0.1312914117695403,
                     0.11756841820327281, 0.1082912010499383, 0.10059918367279014, 0.09464274958657316,
                     0.08950087541269489, 0.08525131037529438, 0.08149754787119957, 0.078264227162809,
                     0.0749297222657328, 0.07237164664917121, 0.07878340419683787, 0.07645590497418735);
      h = polynomial(x, x2, 0.25667702313576346, -0.035430868860621786, -0.01763821490921442, -0.013604709872505337,
                     -0.010004450584237918, -0.008343407236273305, -0.006814684010725436, -0.005923433975933529,
                     -0.0050875905671623695, -0.004537658368943323, -0.004015698706959541, -0.0036453634234560354,
                     -0.0032755247110523755, -0.0030116489072405557, -0.003067910814140791, -0.002850992031510163);
      c = (g - 3 * h) / y;
    } else {
      const T y2 = y * y, by_log = y > 0 ? y * std::log(y) : 0;
      g = polynomial(y, y2, 0.8488263631567752, 0.21220659078919363, 0.031359726395144547, 0.012673815141945259,
                     0.006863852821450759, 0.004084164896778682, -0.0011442619147128065, -0.023992210907279717,
                     -0.05526040900484313, -0.03370317691445262, -0.0020290414510833674, 0.00011461754343776461) +
          y * by_log *
              polynomial(y, y2, 0.07957747154431893, 0.09947183647427947, 0.10879650130220221, 0.11417660781858778,
                         0.11629967051682476, 0.10589344443495839, 0.06431843222493028, 0.014895427447238747);
      c = polynomial(y, y2, 0.4244131815783876, 0.28459384872995763, 0.2749866838276666, 0.2725377710807206,
                     0.2715706405265358, 0.2707987444590404, 0.2621212806340326, 0.16667643820747532,
                     -0.2596660967354723, -0.8658620961940847, -0.7099823465501379, -0.14218806830695793) +
          by_log * polynomial(y, y2, 0.3183098861837905, 0.5968310365925494, 0.8703785923672355, 1.142371120181363,
                              1.4136106688061327, 1.681895998664058, 1.9116141830120834, 1.9020228048084944,
                              1.3163810931360984, 0.4456963561849244, 0.041001941944150126, -0.0005538068596478298);
      h = (g - y * c) / 3;
    }
    if (!(at.p < at.r)) return {g, h, c * at.r, c};
    const T inner = g - at.p * at.p * c;
    return {g, (g + y * inner) / 3, inner, inner * at.p};
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

/// The Pade law of V. F. Zhuravlev, 1998 (Zh98), near to Exact: Phi = 3 pi k/(8 + 3 pi k), Psi = 3 pi/(16 + 15 pi k).
struct Pade {
  template <class T>
  CONTENSOU_HOST_DEVICE Friction<T> operator()(const Slip<T>& at) const {
    const T scale = static_cast<T>(0.84882636315677512);  // 8/(3 pi)
    const T g = 1 / (scale * at.r + at.p), h = 1 / (2 * scale * at.r + 5 * at.p);
    return {g, h, scale * g * g, 5 * h * h};
  }
};

/// Returns the slip of a patch.
/// @param per  1/(larger of sliding and rim)
/// @param gap  |sliding^2 - rim^2|
template <class T>
CONTENSOU_HOST_DEVICE Slip<T> slip_of(T sliding, T rim, T per, T gap) {
  const bool slides = sliding > rim;
  return {sliding, slides ? 1 : sliding * per, slides ? rim * per : 1, gap, gap * per * per};
}

/// Computes the result of `wrench` (below), and the slopes only if with_slopes is true.
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
  const T per = 1 / (sliding > rim ? sliding : rim);
  const Slip<T> at = slip_of(sliding, rim, per, gap);
  const T p = at.p, r = at.r;
  const Friction<T> friction = law(at);
  const T x = vx * per, y = vy * per, turn = w < 0 ? -r : r;
  result.fx = -limit * (friction.force * x);
  result.fy = -limit * (friction.force * y);
  result.m = -friction.moment * (limit < 1 ? limit * radius * turn : limit * turn * radius);
  if constexpr (with_slopes) {
    const T along_x = sliding > 0 ? vx / sliding : 0, along_y = sliding > 0 ? vy / sliding : 0;
    const T arm = w < 0 ? -radius : radius, falls = friction.force - friction.force_slope * r;
    const T weight = limit < 1 ? limit * per : per, rest = limit < 1 ? 1 : limit;  // keep products from overflowing
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
///
/// Accuracy  in double 4 eps, in float 1e-6, relative to the law for k from 1e-8 to 1e8. No finite argument gives NaN.
///           The result overflows only if f N radius overflows.
/// Source    numerics.md (R48), (R50); Zh98 (1.3) to (1.6) for the exact law and the Pade law.
/// @param vx, vy  velocity of the patch centre over the other body in m/s
/// @param w       angular velocity about the normal in rad/s
/// @param limit   f N in newtons; for 0 or less there is no contact, and force and moment are 0
/// @param radius  patch radius in m, >= 0
/// @param creep   speed in m/s, >= 0, below which friction is viscous (contensou/si/wrench.hpp); 0: dry friction
template <class Law, class T>
CONTENSOU_HOST_DEVICE Wrench<T> wrench(T vx, T vy, T w, T limit, T radius, T creep = 0, const Law& law = {}) {
  const WrenchSlopes<T> found = friction_of_patch<false>(vx, vy, w, limit, radius, creep, law);
  return {found.fx, found.fy, found.m};
}

/// Returns force, moment and their nine slopes. At rest without creep, the slopes are 0. Parameters: see `wrench`.
template <class Law, class T>
CONTENSOU_HOST_DEVICE WrenchSlopes<T> wrench_slopes(T vx, T vy, T w, T limit, T radius, T creep = 0,
                                                    const Law& law = {}) {
  return friction_of_patch<true>(vx, vy, w, limit, radius, creep, law);
}

/// Slip and spin after a time step, and the friction during the step.
template <class T>
struct Step {
  T vx, vy, w;  ///< m/s and rad/s
  T fx, fy, m;  ///< mean force in N and mean moment in N m; multiplied by dt, the impulse to apply to the bodies
};

/// Returns slip and spin after an implicit time step under dry friction, and the mean force and moment of this step.
///
/// Slip and spin q after the step solve q = q0 + dt W(q)/inertia, where W(q) is the friction after the step. No creep
/// speed is needed: q is 0 if the impulse that stops slip and spin lies within the limit surface. The difference from
/// the continuous motion is of first order in dt.
///
/// Derivation. Friction acts against the slip, so the slip keeps its direction. Two numbers remain: the sliding speed x
/// and the rim speed y. The step changes (X, Y) = q0 to x = X - B Phi, y = Y - C Psi, where B and C are the changes of
/// x and y by the impulse f N dt. The energy is half of q.q with the scalar product q.q' = x x'/B + y y'/C.
/// - Direction: q(t) = (X + t B Y, Y - t C X) is q0 plus a perpendicular vector. From x = 0 to y = 0, q(t) has each
///   direction once. At the solution it is parallel to (X - B Phi, Y - C Psi). With S = C X^2 + B Y^2, this is g(t) = 0
///   for g(t) = t + (B y Phi - C x Psi)/S. A root exists, because g has the sign of t at x = 0 and at y = 0. Newton's
///   step is halved while |g| grows. A step out of the interval of the root ends at x = 0 or y = 0, or bisects.
/// - Length: the result is s q(t) with s = (q.q0 - D)/(q.q) and D = x Phi + y Psi >= 0. At a root it is the solution.
///   For each t with s > 0, (s q).(s q) = s q.q0 - s D <= |s q| |q0|. So no step adds energy, even if Newton's method
///   has not ended. If s <= 0, the step ends at rest.
/// - Rest: at a root, q0 = (B Phi, C Psi) + s q. The limit surface is the curve (B Phi, C Psi). Phi does not fall and
///   Psi does not rise with k. So a point is outside if it lies above and to the right of a point of the curve, and
///   inside if it lies below and to the left. Hence q0 is outside if s > 0, inside if s <= 0: each root decides
///   correctly. The iteration ends at once where X <= B Phi and Y <= C Psi, because q0 is then inside.
/// - Slip or spin alone: t = 0 is the root. If the radius is 0, w stays.
/// B or C may be 0, because no formula divides by them. If S underflows, the smaller of X and Y has an inertia so large
/// that it stays. The unit of speeds is the largest speed; B, C, S are in units of `unit`, so that t is of order 1.
///
/// Accuracy  t to 64 eps. The energy after the step is at most 1 + 4 eps times the energy before. Finite arguments give
///           no NaN, unless radius w or f N dt overflows. A NaN gives NaN, except at rest.
/// @param vx, vy, w      slip in m/s and spin in rad/s; they contain all other forces of the step
/// @param by_force       change of slip by a unit of impulse at the contact in 1/kg, >= 0: chi/m, for a ball 3.5/m
/// @param by_moment      change of spin by a unit of angular impulse in 1/(kg m^2), >= 0: 1/J_z
/// @param limit, radius  see `wrench`
/// @param dt             time step in s; for 0 or less nothing happens
/// @param max_newton     largest number of Newton's steps, halved steps included
template <class Law, class T>
CONTENSOU_HOST_DEVICE Step<T> step(T vx, T vy, T w, T by_force, T by_moment, T limit, T radius, T dt,
                                   const Law& law = {}, int max_newton = 60) {
  constexpr T eps = static_cast<T>(sizeof(T) < sizeof(double) ? 1.1920929e-7 : 2.220446049250313e-16);
  const auto larger = [](T a, T b) { return a < b ? b : a; };
  const T impulse = limit * dt, rim = std::fabs(radius * w), size = larger(larger(std::fabs(vx), std::fabs(vy)), rim);
  const T most = size / (eps * eps);
  T B = by_force * impulse, C = by_moment * radius * impulse * radius;
  B = most < B ? most : B, C = most < C ? most : C;
  const T unit = larger(B, C), lambda = unit / size;
  if (impulse <= 0 || size == 0 || unit == 0) return {vx, vy, w, 0, 0, 0};
  B /= unit, C /= unit;
  const T along_x = vx / size, along_y = vy / size;
  T X = std::sqrt(along_x * along_x + along_y * along_y), Y = rim / size, S = C * X * X + B * Y * Y;
  if (S < eps * eps * eps * eps) (X < Y ? X : Y) = 0, B = C = 1, S = X * X + Y * Y;
  T t = 0, low = -X / (lambda * B * Y), high = Y / (lambda * C * X);  // low and high enclose the root
  T power = 0, last = 0, move = 0, least = INFINITY;                  // least is |g| at t = last
  bool rests = false;
  for (int i = 0;; ++i) {
    const T x = larger(X + lambda * t * B * Y, 0), y = larger(Y - lambda * t * C * X, 0);
    const T per = 1 / larger(x, y);
    const Slip<T> at = slip_of(x, y, per, std::fabs((x - y) * (x + y)));
    const Friction<T> friction = law(at);
    const T phi = friction.force * at.p, psi = friction.moment * at.r;
    power = x * phi + y * psi;
    rests = X <= lambda * B * phi && Y <= lambda * C * psi;
    const T pulls = B * y * phi / S, turns = C * x * psi / S, g = t + pulls - turns;
    if (rests || i >= max_newton || !(g < 0 || g > 0)) break;
    (g < 0 ? low : high) = t;
    const T slope = 1 + lambda * (per * per * (B * y * friction.force_slope + C * x * friction.moment_slope) -
                                  B * C * (X * phi + Y * psi) / S);
    const bool grows = std::fabs(g) > least;
    move = grows ? move / 2 : -g / slope;
    const T tiny = 64 * eps / std::fabs(move);
    if ((grows || slope > 0) && tiny * (pulls + turns) >= 1 && tiny * (lambda * S * std::fabs(t) + X * Y) >= lambda * S)
      break;
    if (!grows) {
      last = t, least = std::fabs(g);
      if (!(slope > 0 && t + move > low && t + move < high)) {
        move = ((g < 0 ? high : low) - t) / (i == 0 ? 1 : 2), least = INFINITY;
      }
    }
    if (last + move == t) break;
    t = last + move;
  }
  const T turned = lambda * t, longer = 1 + turned * turned * B * C, shortens = (power / S + turned * t) / longer;
  const T s = (1 - lambda * B * C * power / S) / longer;
  if (rests || s <= 0) {
    const bool slides = !(X > 0 && by_force > 0), spins = !(Y > 0 && by_moment > 0);
    const T stops = slides ? 0 : -1 / (by_force * dt);
    return {slides ? vx : 0, slides ? vy : 0, spins ? w : 0, vx * stops, vy * stops, spins ? 0 : -w / (by_moment * dt)};
  }
  const T force = X > 0 ? limit * (s * t * Y - C * X * shortens) / X : 0;
  const T fx = force * along_x, fy = force * along_y;
  const T m = (w < 0 ? limit : -limit) * radius * (s * t * X + B * Y * shortens);
  return {vx + by_force * dt * fx, vy + by_force * dt * fy, w + by_moment * dt * m, fx, fy, m};
}

}  // namespace contensou::kernel
