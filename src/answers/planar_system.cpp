#include "answers/planar_system.hpp"

#include <memory>

#include "answers/formulas.hpp"

namespace contensou::answers {

reduction::PlanarField parse_planar_system(const std::string& text, const std::map<std::string, double>& parameters) {
  const FormulaShape shape{{"u'", "v'"}, {"u", "v"}, "a system is \"u' = F; v' = G\""};
  const auto formulas = std::make_shared<Formulas>(shape, text, parameters);
  return [formulas](const Eigen::Vector2d& x) {
    const auto [u, v] = (*formulas)({x[0], x[1]});
    return Eigen::Vector2d(u, v);
  };
}

}  // namespace contensou::answers
