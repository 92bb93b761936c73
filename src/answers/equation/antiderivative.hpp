#pragma once

#include <cstddef>
#include <optional>

#include "answers/input/expression.hpp"

namespace contensou::answers {

/// Returns an antiderivative by a variable; other variables are constants. Empty if the bounded search finds none.
///
/// The search knows rational functions whose denominator has rational roots and quadratic factors, products of
/// polynomials, exp, sin, cos and logarithms, roots of linear and quadratic functions, and substitutions by a part of
/// the formula. The logarithms are those of absolute values. The caller checks the result: no step is proved.
std::optional<Expression> antiderivative(const Expression& f, std::size_t variable);

}  // namespace contensou::answers
