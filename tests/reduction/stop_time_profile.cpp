#include "contensou/reduction/stop_time_profile.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/orbit.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/quadrature_curve.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "reference_table.hpp"
#include "stop_times/stop_time_kernel.hpp"
#include "stops_above_one.hpp"
#include "user_laws.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Catch::Matchers::Contains;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Starts {
  std::vector<double> u0, v0;
};

std::vector<StopTimeKernel> kernels() {
  const auto own = stop_time_kernels();
  return {own.begin(), own.end()};
}

/// Starts that are all alike to a profile with one sheet or four: every k0 that a profile distinguishes, and beyond.
Starts random_starts(double mu, std::size_t count) {
  std::mt19937_64 generator(17);
  std::uniform_real_distribution<double> ln_k(-45, 45), ln_u(-3, 3);
  Starts starts;
  for (std::size_t i = 0; i < count; ++i) {
    const double u0 = (i % 2 == 0 ? 1 : -1) * std::exp(ln_u(generator));
    const double k =
        i % 3 == 0 ? 1 + 0.1 * std::sinh(ln_k(generator) / 4) / std::sinh(45.0 / 4) : std::exp(ln_k(generator));
    starts.u0.push_back(u0);
    starts.v0.push_back(mu * std::abs(u0) * k);
  }
  return starts;
}

std::vector<double> evaluated(const StopTimeProfile& profile, const Starts& starts, unsigned threads = 1) {
  std::vector<double> tau(starts.u0.size());
  profile.evaluate(starts.u0, starts.v0, tau, threads);
  return tau;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// How many places of two arrays of one size differ.
std::size_t differ(const std::vector<double>& a, const std::vector<double>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += !same_bits(a[i], b[i]);
  return count;
}

WorstCase over_table(const char* table, const Law& law) {
  WorstCase worst(table);
  std::map<double, StopTimeProfile> profiles;
  for (const ReferenceRow& row : reference_table(table)) {
    const double mu = row.input("mu");
    const auto& profile = profiles.try_emplace(mu, ReducedSystem(law, mu)).first->second;
    worst.add(row.result("tau_stop"), profile(row.input("u0"), row.input("v0")), row.where());
  }
  return worst;
}

}  // namespace

TEST_CASE("profile of the Pade ball", "[stop_time_profile][table]") {
  CHECK_WITHIN_EPS(over_table("stop_pade", PadeLaw{}), 2);
}

TEST_CASE("profile of the exact ball", "[stop_time_profile][table]") {
  CHECK_WITHIN_EPS(over_table("stop_hertz", HertzLaw{}), 2);
}

TEST_CASE("profiles of other bodies", "[stop_time_profile][table]") {
  WorstCase worst("bodies");
  for (const ReferenceRow& row : reference_table("bodies")) {
    const Law law = row.text("law") == "pade" ? Law(PadeLaw{}) : Law(HertzLaw{});
    const StopTimeProfile profile(ReducedSystem(law, row.input("mu"), {row.input("chi"), row.input("gamma")}));
    worst.add(row.result("tau_stop"), profile(row.input("u0"), row.input("v0")), row.where());
  }
  CHECK_WITHIN_EPS(worst, 2);
}

TEST_CASE("profiles where k tends to a ray or to infinity", "[stop_time_profile][table]") {
  WorstCase worst("all regimes");
  for (const auto& [mu, u0, v0, tau] : stops_above_one) {
    worst.add(tau, StopTimeProfile(ReducedSystem(PadeLaw{}, mu))(u0, v0), fmt::format("mu = {}, u0 = {}", mu, u0));
  }
  CHECK_WITHIN_EPS(worst, 2);
}

TEST_CASE("a profile meets the quadrature between its own nodes", "[stop_time_profile][route]") {
  for (const Law& law : named_laws()) {
    WorstCase worst(law.name());
    for (double mu : {1e-9, 1e-3, 0.1, 0.7}) {
      const ReducedSystem system(law, mu);
      const auto curve = std::make_shared<const QuadratureCurve>(law, system.r());
      const Starts starts = random_starts(mu, 2000);
      const auto tau = evaluated(StopTimeProfile(system), starts);
      for (std::size_t i = 0; i < tau.size(); ++i) {
        const double wanted = Orbit(system, {starts.u0[i], starts.v0[i]}, curve).stop_time();
        worst.add(wanted, tau[i], fmt::format("mu = {}, u0 = {}, v0 = {}", mu, starts.u0[i], starts.v0[i]));
      }
    }
    CHECK_WITHIN_EPS(worst, 4);
  }
}

TEST_CASE("a user's law has a profile, and its name decides nothing", "[stop_time_profile][route]") {
  const ReducedSystem system(Impostor{}, 0.3);
  CHECK(StopTimeProfile(system)(1, 0.3) ==
        Approx(stop_time(ReducedSystem(HertzLaw{}, 0.3), {1, 0.3}).tau).epsilon(1e-14));
}

TEST_CASE("one start and many, cut and shared in any way, have the same bits", "[stop_time_profile][invariant]") {
  for (const Law& law : paper_laws()) {
    const double mu = 0.3;
    const StopTimeProfile profile(ReducedSystem(law, mu));
    const Starts starts = random_starts(mu, (std::size_t{1} << 18) + 77);  // large enough for streaming stores
    const auto whole = evaluated(profile, starts);
    for (unsigned threads : {2U, 3U, 16U}) CHECK(differ(evaluated(profile, starts, threads), whole) == 0);

    std::vector<double> pieces(whole.size());
    std::size_t begin = 0;
    for (std::size_t size = 0; begin < whole.size(); begin += size, ++size) {
      size = std::min(size, whole.size() - begin);
      profile.evaluate(std::span(starts.u0).subspan(begin, size), std::span(starts.v0).subspan(begin, size),
                       std::span(pieces).subspan(begin, size));
    }
    CHECK(differ(pieces, whole) == 0);

    for (bool over_u0 : {true, false}) {
      std::vector<double> in_place = over_u0 ? starts.u0 : starts.v0;
      profile.evaluate(over_u0 ? std::span<const double>(in_place) : starts.u0,
                       over_u0 ? starts.v0 : std::span<const double>(in_place), in_place, 2);
      CHECK(differ(in_place, whole) == 0);
    }

    std::vector<double> row(300);
    for (std::size_t i = 0; i < 5000; i += 101) {
      profile.evaluate_row(std::span(starts.u0).subspan(i, row.size()), starts.v0[i], row, 2);
      CHECK(same_bits(row[0], whole[i]));
      CHECK(same_bits(row[row.size() - 1], profile(starts.u0[i + row.size() - 1], starts.v0[i])));
    }
  }
}

TEST_CASE("every instruction set makes the same bits", "[stop_time_profile][invariant]") {
  REQUIRE(stop_time_kernels().front().name == "baseline");
  CHECK(StopTimeProfile::instruction_set() == stop_time_kernels().back().name);
  for (const Law& law : paper_laws()) {
    for (double mu : {0.01, 0.3, 1.0}) {
      const StopTimeProfile profile(ReducedSystem(law, mu));
      Starts starts = random_starts(mu, 50'001);
      // Some that need care, alone and in company.
      for (std::size_t i : {3U, 4U, 20'000U, 40'000U, 50'000U}) starts.v0[i] = i % 2 == 0 ? -1 : 1e-300;
      for (std::size_t i : {4U, 5'000U, 20'001U}) starts.u0[i] = i % 2 == 0 ? infinity : 1e300;
      const std::size_t size = starts.u0.size();
      const std::vector<double> row(size, starts.v0[7]);
      const auto run = [&](const StopTimeKernel& kernel, const double* v0, std::size_t v0_step, bool streaming) {
        std::vector<double> tau(size + 1);  // one double off what vectors like
        kernel.run(profile.table(), {starts.u0.data(), v0, v0_step, tau.data() + 1, size, streaming});
        return tau;
      };
      const StopTimeKernel& baseline = stop_time_kernels().front();
      const auto of_starts = run(baseline, starts.v0.data(), 1, false);
      const auto of_row = run(baseline, row.data(), 1, false);
      CHECK(std::isnan(of_starts[1 + 4]));
      for (const StopTimeKernel& kernel : kernels()) {
        for (bool streaming : {false, true}) {
          CAPTURE(law.name(), mu, kernel.name, streaming);
          CHECK(differ(run(kernel, starts.v0.data(), 1, streaming), of_starts) == 0);
          CHECK(differ(run(kernel, row.data(), 0, streaming), of_row) == 0);
        }
      }
    }
  }
}

TEST_CASE("a body far from unit inertia differs by a factor", "[stop_time_profile][limit]") {
  for (const Law& law : paper_laws()) {
    for (double mu : {1e-8, 0.1, 1.0, 2.0}) {
      const StopTimeProfile profile(ReducedSystem(law, mu));
      const Starts starts = random_starts(mu, 1000);
      const auto tau = evaluated(profile, starts);
      for (int power : {-300, -120, 90, 300}) {
        const Inertia far{std::ldexp(profile.system().inertia().chi, -power),
                          std::ldexp(profile.system().inertia().gamma, -power)};
        const auto far_tau = evaluated(StopTimeProfile(ReducedSystem(law, mu, far)), starts);
        WorstCase worst(law.name());
        for (std::size_t i = 0; i < tau.size(); ++i) {
          worst.add(tau[i], std::ldexp(far_tau[i], -power), fmt::format("mu = {}, start {}, 2^{}", mu, i, power));
        }
        CHECK_WITHIN_EPS(worst, 4);
      }
    }
  }
}

TEST_CASE("starts that need care", "[stop_time_profile][limit]") {
  for (const Law& law : paper_laws()) {
    for (double mu : {1e-300, 1e-10, 0.1, 1.0}) {
      CAPTURE(law.name(), mu);
      const ReducedSystem system(law, mu);
      const StopTimeProfile profile(system);
      CHECK(profile(0, 0) == 0);
      CHECK(profile(-0.0, 0) == 0);
      CHECK(profile(0, 3) == Approx(system.sliding_limit(3)).epsilon(4 * eps));
      CHECK(profile(0.1, 0) == Approx(system.pivoting_limit(0.1)).epsilon(4 * eps));
      CHECK(profile(-2, 1) == profile(2, 1));
      CHECK(profile(0, std::numeric_limits<double>::max()) == infinity);
      // Alike but for a power of two, in the middle of the double range and near its ends.
      const double here = profile(1.3, 0.7);
      for (int power : {-1030, -950, -850, 850, 950, 1000}) {
        const double scaled = profile(std::ldexp(1.3, power), std::ldexp(0.7, power));
        CAPTURE(power, here, scaled);
        const double u = std::ldexp(std::ldexp(1.3, power), -power), v = std::ldexp(std::ldexp(0.7, power), -power);
        const double wanted = std::ldexp(profile(u, v), power);
        CHECK((scaled == wanted || std::abs(scaled - wanted) <= std::max(2 * eps * wanted, 1e-323)));
      }
    }
  }
}

TEST_CASE("what is no start is refused alone and is not a number among others", "[stop_time_profile][domain]") {
  const StopTimeProfile profile(ReducedSystem(PadeLaw{}, 0.1));
  const std::vector<double> bad{infinity, -infinity, not_a_number};
  for (double x : bad) {
    CHECK_THROWS_WITH(profile(x, 1), Contains("StopTimeProfile"));
    CHECK_THROWS_WITH(profile(1, x), Contains("StopTimeProfile"));
  }
  CHECK_THROWS_WITH(profile(1, -1e-300), Contains("v0 >= 0") || Contains("v >= 0"));

  for (const Law& law : paper_laws()) {
    for (double mu : {1e-300, 0.1}) {
      const StopTimeProfile many(ReducedSystem(law, mu));
      for (double x : {infinity, -infinity, not_a_number, -1.0, -1e-300}) {
        for (std::size_t place = 0; place < 19; ++place) {
          Starts starts{std::vector<double>(19, 2.0), std::vector<double>(19, 1.0)};
          starts.v0[place] = x;
          const auto tau = evaluated(many, starts);
          if (!std::isfinite(x)) starts.u0[(place + 1) % 19] = x;
          const auto more = evaluated(many, starts);
          for (std::size_t i = 0; i < tau.size(); ++i) {
            CHECK((i == place ? std::isnan(tau[i]) : same_bits(tau[i], many(2, 1))));
            if (!std::isfinite(x) && i == (place + 1) % 19) CHECK(std::isnan(more[i]));
          }
        }
      }
    }
  }

  std::vector<double> two(2), three(3);
  CHECK_THROWS_WITH(profile.evaluate(two, three, two), Contains("2 u0, 3 v0, 2 tau"));
  CHECK_THROWS_WITH(profile.evaluate(two, two, three), Contains("3 tau"));
  CHECK_THROWS_WITH(profile.evaluate(two, two, two, 0), Contains("0 threads"));
  CHECK_THROWS_WITH(profile.evaluate_row(two, 1, three), Contains("3 tau"));
  CHECK_NOTHROW(profile.evaluate({}, {}, {}, 4));
}
