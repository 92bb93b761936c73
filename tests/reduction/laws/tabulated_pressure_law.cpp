#include "contensou/reduction/tabulated_pressure_law.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Catch::Matchers::Contains;

namespace {

/// Computes Phi, Psi and 1 - Psi/Psi(0) of a table of pressures in long double. Elliptic integrals are computed by the
/// arithmetic-geometric mean; the integral between two rows by tanh-sinh, split at k.
class RingsOfTable {
 public:
  RingsOfTable(std::vector<double> rho, std::vector<double> pressure)
      : rho_(std::move(rho)), pressure_(std::move(pressure)) {}

  struct Answer {
    long double force, moment, deficit;
  };

  Answer operator()(double k) const {
    const long double load = over([&](const Place&) { return 1.0L; }, k);
    const long double pivoting = over([&](const Place& at) { return at.radius; }, k);
    const long double force = over([&](const Place& at) { return at.inside ? at.cross : at.along; }, k);
    const long double moment = over([&](const Place& at) { return at.radius * (at.inside ? at.along : at.cross); }, k);
    return {force / load, moment / load, 1 - moment / pivoting};
  }

 private:
  struct Place {
    long double radius;
    bool inside;        ///< true if k < radius
    long double along;  ///< (2/pi) E
    long double cross;  ///< (2/pi) (E - (1 - q^2) K)/q
  };

  /// @param distance  radius^2 - k^2
  static Place place(long double radius, long double k, long double distance) {
    const bool inside = distance > 0;
    const long double larger = inside ? radius : k;
    const long double q = (inside ? k : radius) / larger;
    long double a = 1;
    long double b = std::sqrt(std::abs(distance)) / larger;
    long double sum = 0;
    if (b == 0) return {radius, inside, 2 / std::numbers::pi_v<long double>, 2 / std::numbers::pi_v<long double>};
    for (long double power = 1; std::abs(a - b) > 1e-19L * a && power < 1e6L; power *= 2) {
      const long double half_difference = (a - b) / 2;
      sum += power * half_difference * half_difference;
      const long double mean = (a + b) / 2;
      b = std::sqrt(a * b);
      a = mean;
    }
    return {radius, inside, (1 - q * q / 2 - sum) / a, (q * q / 2 - sum) / a / q};
  }

  template <class Part>
  long double over(Part part, double k) const {
    static boost::math::quadrature::tanh_sinh<long double> rule(12);
    long double total = 0;
    for (std::size_t i = 1; i < rho_.size(); ++i) {
      const long double inner = rho_[i - 1];
      const long double outer = rho_[i];
      const long double width = (outer - inner) * (outer + inner);
      if (width == 0 || (pressure_[i - 1] == 0 && pressure_[i] == 0)) continue;
      const long double behind = (k - inner) * (k + inner);
      const auto at = [&](long double share) {
        const long double pressure = (1 - share) * pressure_[i - 1] + share * pressure_[i];
        const long double radius = std::sqrt(inner * inner + share * width);
        return pressure * width * part(place(radius, k, share * width - behind));
      };
      const long double cut = behind / width;
      if (cut > 0 && cut < 1) {
        total += rule.integrate(at, 0.0L, cut, 1e-12L) + rule.integrate(at, cut, 1.0L, 1e-12L);
      } else {
        total += rule.integrate(at, 0.0L, 1.0L, 1e-12L);
      }
    }
    return total;
  }

  std::vector<double> rho_;
  std::vector<double> pressure_;
};

TabulatedPressureLaw table(const std::function<double(double)>& pressure, int rows) {
  const Eigen::ArrayXd rho = Eigen::ArrayXd::LinSpaced(rows, 0, 1);
  return {"table", rho, rho.unaryExpr(pressure)};
}

TabulatedPressureLaw table_of(const std::vector<double>& rho, const std::vector<double>& pressure) {
  return {"table", Eigen::Map<const Eigen::ArrayXd>(rho.data(), std::ssize(rho)),
          Eigen::Map<const Eigen::ArrayXd>(pressure.data(), std::ssize(pressure))};
}

/// Compares Phi, Psi and 1 - Psi/Psi(0) of a table with RingsOfTable, for many k and next to every row.
struct Comparison {
  WorstCase force{"Phi"}, moment{"Psi"}, deficit{"1 - Psi/Psi(0)"};

  void add(const std::vector<double>& rho, const std::vector<double>& pressure, const std::string& name,
           std::vector<double> ks = {}) {
    const TabulatedPressureLaw law = table_of(rho, pressure);
    const RingsOfTable rings(rho, pressure);
    const bool beside_rows = ks.empty();
    if (beside_rows) ks = {1e-6, 1e-3, 0.05, 0.3, 0.77, 1, 1.3, 8, 1e3};
    for (double edge : rho) {
      if (edge == 0 || !beside_rows) continue;
      for (double factor : {1 - 1e-4, 1 - 1e-15, 1.0, 1 + 1e-9, 1 + 3e-2}) ks.push_back(factor * edge);
    }
    for (double k : ks) {
      const std::string where = fmt::format("{}, k = {}", name, k);
      const auto wanted = rings(k);
      force.add(wanted.force, law({k, 1}).force, where);
      moment.add(wanted.moment, law({k, 1}).moment, where);
      if (k > 0.02) deficit.add(wanted.deficit, law.moment_deficit({k, 1}), where);
    }
  }

  void check(double eps) const {
    CHECK_WITHIN_EPS(force, eps);
    CHECK_WITHIN_EPS(moment, eps);
    CHECK_WITHIN_EPS(deficit, eps);
  }
};

}  // namespace

TEST_CASE("a steep flank loses no digit, however steep", "[tabulated_pressure_law][route]") {
  Comparison comparison;
  for (double gap : {2e-16, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.1}) {
    const double edge = 0.5 + gap;
    comparison.add({0, 0.5, edge, 1}, {1, 1, 0, 0}, fmt::format("down over {}", gap));
    comparison.add({0, 0.5, edge, 1}, {1e-3, 0, 1, 1}, fmt::format("up over {}", gap));
    comparison.add({0, 0.5, 0.5, edge, edge, 1}, {0, 0, 1, 1, 0, 0}, fmt::format("annulus of {}", gap));
    comparison.add({0, 0.5, edge, edge + gap, 1}, {0, 0, 1, 0, 0}, fmt::format("roof over {}", gap));
  }
  comparison.add({0, 1e-3, 1.001e-3, 0.999, 1}, {1e4, 1e4, 1, 1, 0}, "a spike in the centre");
  comparison.add({0, 1e-3, 1.001e-3, 0.9, 0.9001, 0.9002, 1}, {1e6, 1e6, 0, 0, 4e-3, 0, 0}, "a spike and a thin ring");
  // The law computes rows far from k in groups.
  std::vector<double> rho, pressure;
  for (int i = 0; i <= 300; ++i) {
    rho.push_back(i / 300.0);
    pressure.push_back(i % 2 == 0 ? 1 : 100);
  }
  comparison.add(rho, pressure, "up and down", {1e-9, 0.01, 0.3335, 0.9, 2.0});
  comparison.check(12);
}

TEST_CASE("tables at random, with steps and spikes", "[tabulated_pressure_law][route]") {
  std::mt19937 random(11);
  const auto uniform = [&] { return std::generate_canonical<double, 53>(random); };
  Comparison comparison;
  for (int i = 0; i < 12; ++i) {
    std::vector<double> rho{0};
    const int rows = 2 + static_cast<int>(random() % 9);
    while (std::ssize(rho) < rows) rho.push_back(uniform());
    for (int n = 0; n < rows / 3; ++n) rho.push_back(std::min(rho.back() * (1 + std::pow(10, -16 * uniform())), 1.0));
    std::ranges::sort(rho);
    rho.push_back(1);
    std::vector<double> pressure;
    for (std::size_t n = 0; n < rho.size(); ++n) pressure.push_back(uniform() < 0.3 ? 0 : std::pow(10, 6 * uniform()));
    comparison.add(rho, pressure, fmt::format("table {}", i));
  }
  comparison.check(12);
}

TEST_CASE("the unit of the pressure does not matter", "[tabulated_pressure_law][symmetry]") {
  for (double unit : {1e-300, 1e6, 1.7e308}) {
    const TabulatedPressureLaw law = table([unit](double rho) { return unit * (1 - rho / 2); }, 7);
    const TabulatedPressureLaw one = table([](double rho) { return 1 - rho / 2; }, 7);
    CHECK(law({0.7, 1}).force == Approx(one({0.7, 1}).force).epsilon(1e-14));
  }
}

TEST_CASE("a disc of half the patch stops like a patch of half the radius", "[tabulated_pressure_law][symmetry]") {
  for (double gap : {0.0, 2e-16}) {
    const Flow step({table_of({0, 0.5, 0.5 + gap, 1}, {1, 1, 0, 0}), 1, {.chi = 1, .gamma = 2}});
    const Flow half({PressureLaw::uniform(), 0.5, {.chi = 1, .gamma = 2}});
    for (double v : {0.01, 0.5, 1.0, 7.0, 1e3}) {
      CAPTURE(gap, v);
      CHECK(step.stop_time({1, v}).tau == Approx(half.stop_time({1, v}).tau).epsilon(4e-15));
    }
  }
}

TEST_CASE("a table names its steps and sharp bends as kinks", "[tabulated_pressure_law][limit]") {
  using Kinks = std::vector<double>;
  CHECK(table_of({0, 0.3, 0.3, 0.5, 0.5 + 2e-16, 1}, {1, 1, 2, 2, 0, 0}).kinks() == Kinks{0.3, 0.5, 0.5 + 2e-16});
  CHECK(table_of({0, 0.5, 1}, {1, 1, 1}).kinks() == Kinks{1});
  CHECK(table_of({0, 0.5, 1}, {1, 0.75, 0}).kinks().empty());
  CHECK(table([](double rho) { return std::sin(1e3 * rho) + 1; }, 1000).kinks().size() == 32);
  CHECK(Law(table_of({0, 0.3, 0.3, 1}, {1, 1, 0, 0})).kinks() == Kinks{0.3});
}

TEST_CASE("a load within the centre's last digits is refused with a way out", "[tabulated_pressure_law][domain]") {
  for (double radius : {1e-12, 1e-160}) {
    CHECK_THROWS_MATCHES(table_of({0, radius, radius, 1}, {1, 1, 0, 0}), std::runtime_error,
                         Catch::Matchers::Predicate<std::runtime_error>([](const std::runtime_error& error) {
                           return std::string(error.what()).find("radius of the loaded part") != std::string::npos;
                         }));
  }
  CHECK_NOTHROW(table_of({0, 1e-300, 1e-12, 1}, {1, 2, 1, 1}));
  CHECK_NOTHROW(table_of({0, 1e-9, 1e-9, 1}, {1, 1, 0, 0}));
}

TEST_CASE("a table that is no pressure is refused, naming the row", "[tabulated_pressure_law][domain]") {
  struct Refused {
    std::vector<double> rho, pressure;
    std::string words, more = {};
  };
  for (const auto& [rho, pressure, words, more] :
       std::vector<Refused>{{{0.1, 1}, {1, 1}, "row 1", "begin at 0"},
                            {{0, 0.9}, {1, 1}, "row 2", "end at 1"},
                            {{0, 0.5, 0.4, 1}, {1, 1, 1, 1}, "row 3", "not decrease"},
                            {{0, 0.5, 0.5, 0.5, 1}, {1, 1, 1, 1, 1}, "row 4", "two rows"},
                            {{0, 0, 1}, {1, 1, 1}, "row 2", "one row only"},
                            {{0, 1}, {1, -1}, "row 2", "-1"},
                            {{0, 1}, {HUGE_VAL, 1}, "row 1"},
                            {{0, std::nan(""), 1}, {1, 1, 1}, "row 2"},
                            {{0, 1}, {0, 0}, "every row"},
                            {{0}, {1}, "two or more"},
                            {{0, 1}, {1}, "two or more"}}) {
    CHECK_THROWS_WITH(table_of(rho, pressure), Contains(words) && Contains(more));
  }
}
