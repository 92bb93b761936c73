#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/planar_reduction.hpp"
#include "planar/section_field.hpp"
#include "planar/solution.hpp"

namespace contensou::reduction {

/// The field f and its derivatives at a point.
struct Jet {
  Eigen::Vector2d f;
  Eigen::Matrix2d slopes;
  double error = 0;  ///< error of the derivatives, if they are computed as differences
  Eigen::MatrixX3d basis = {};
};

/// Returns f with its derivatives; empty if the field has no value at x.
std::optional<Jet> jet_of(const SmoothField& field, const Eigen::Vector2d& x);

/// Returns D f for a field f with a denominator D.
SmoothField with_cleared_denominator(const SmoothField& field);

/// Returns the field of x/unit, f(unit x)/unit. A unit that is a power of 2 causes no rounding.
SmoothField in_units(const SmoothField& field, double unit);

/// Returns the field -f, whose motions are those of f with the time reversed.
SmoothField backward(const SmoothField& field);

/// Returns point i of a sequence of points spread evenly over the square [0, 1] x [0, 1] (M. Roberts' R2).
Eigen::Vector2d evenly_spread(int i);

struct Box {
  Eigen::Vector2d centre, radii;

  /// Returns the coordinates in which the box is [-1, 1] x [-1, 1].
  Eigen::Vector2d inside(const Eigen::Vector2d& x) const { return (x - centre).cwiseQuotient(radii); }
};

/// Returns the weight w of planar.md (R59) for f = (F, G): 1/(|F|/radius + |G|/radius + |div f|), or 0 if it is
/// infinite.
double weight(const Box& box, const Jet& jet);

/// Returns the box about x in which V is fitted.
Box box_about(const Eigen::Vector2d& x);

enum class FactorForm { constant, affine, polynomial, linear_v, quadratic_v, linear_u, quadratic_u, product, basis };
inline constexpr int factor_forms = 8;  ///< number of forms that are tried; a basis of the field replaces all of them

/// Returns true if coefficients that were fitted in a box are valid everywhere.
inline bool holds_everywhere(FactorForm form) { return form == FactorForm::affine || form == FactorForm::basis; }

std::string_view name(FactorForm form);

/// Returns the box, widened in the directions in which V is a polynomial of this form, because V is known there, too.
Box widened(FactorForm form, Box box, double factor);

/// The inverse integrating factor V in a box.
class InverseFactor {
 public:
  static constexpr int most = Basis::most;
  template <int Columns>
  using Terms = Eigen::Matrix<double, Eigen::Dynamic, Columns, 0, most, Columns>;

  /// The row V, dV/du, dV/dv.
  using Value = Eigen::RowVector3d;

  InverseFactor(FactorForm form, Box box, Terms<1> coefficients)
      : form_(form), box_(std::move(box)), coefficients_(std::move(coefficients)) {}

  /// Returns the functions of the form, with their derivatives. V is a sum of these functions; for a product, ln V is.
  static Terms<3> terms(FactorForm form, const Box& box, const Eigen::Vector2d& x, const Jet& jet);

  /// @param jet  jet.slopes is used only for the derivatives of an affine form, jet.basis only for the form `basis`
  Value operator()(const Eigen::Vector2d& x, const Jet& jet) const;

  /// Returns the misfit (R59) at one point, but divided by V at this point, not by the mean square of V over the box.
  double residual(const Eigen::Vector2d& x, const Jet& jet) const;

  /// f . grad V - V div f, and the sum of the sizes of its terms and of the terms of V and div f. Not for a product.
  struct Misfit {
    double value, size;
  };
  Misfit misfit(const Eigen::Vector2d& x, const Jet& jet) const;

  /// Returns the magnitude of V: the sum of the absolute values of its terms, which cancel in V.
  double size(const Eigen::Vector2d& x, const Jet& jet) const;

  FactorForm form() const { return form_; }
  int terms() const { return static_cast<int>(coefficients_.size()); }
  const Box& box() const { return box_; }

  /// True if the centre of the box lies on the invariant curve V = 0.
  bool vanishes = false;

  /// Relative error of the coefficients, if they are scaled so that size() is 1.
  double error = 0;

 private:
  FactorForm form_;
  Box box_;
  Terms<1> coefficients_;
};

/// Values of f at points of a box. The first points are for the fit of V, the others test the fit.
struct FieldSamples {
  Box box;
  Jet centre;
  std::vector<Eigen::Vector2d> points = {};
  std::vector<Jet> jets = {};
  double error = 0;  ///< error of the derivatives, relative to the divisor of the misfit (R59)

  int fitted() const { return static_cast<int>(points.size()) * 8 / 13; }
};

/// Returns the samples; empty if the field has no values in a fifth of the box or more.
std::optional<FieldSamples> sample(const SmoothField& field, const Box& box);

struct FactorFit {
  InverseFactor factor;  ///< scaled to V = 1 at the centre of the box, unless V vanishes there
  TriedForm tried;
  bool small;   ///< true if the singular value and the misfit are small
  bool unique;  ///< true if V is unique except for a constant factor
};

/// Returns the best V of this form; empty if all functions of the form vanish.
/// @param like  V in another box, NaN outside: of several V the result is the one that continues this V. It is empty if
///              none does. Without effect on a product.
std::optional<FactorFit> fit_factor(FactorForm form, const FieldSamples& samples,
                                    const std::function<double(const Eigen::Vector2d& x)>& like = {});

/// Returns the inverse integrating factor V of a system as a formula. V is a sum with rational coefficients of
/// monomials in u, v of degree 4 or less, or of products of the field with 1, u, v, or of functions of the field's own
/// basis.
///
/// @param field  field whose V is such a sum
std::string recognised(const SmoothField& field, const Eigen::Vector2d& start);

/// Follows the orbit through the start, a level line of the first integral H, to its end.
/// @param cleared  true if V was fitted for the product of the field and its denominator
/// @param factor  inverse integrating factor in a box about `start`
/// @param most_work  number of evaluations of the field after which the end is left undecided
/// @param unit    length by which u and v are divided in all arguments; the motion has no units
std::shared_ptr<const PlanarOrbit::Motion> follow(const SmoothField& field, bool cleared, const InverseFactor& factor,
                                                  const Eigen::Vector2d& start, double unit, int most_work);

}  // namespace contensou::reduction
