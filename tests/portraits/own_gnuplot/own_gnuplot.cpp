#include <tuple>

#include <gnuplot-iostream.h>
#include <contensou/portraits/phase_portrait.hpp>
#include <contensou/reduction/flow.hpp>
#include <contensou/reduction/laws.hpp>

int main() {
  using namespace contensou;
  const reduction::Flow flow(reduction::HertzLaw{}, 0.8);
  const portraits::PhasePortrait portrait = portraits::phase_portrait(flow, {.sides = {{1, 1}}});
  Gnuplot gp;
  gp << "set terminal pngcairo size 720,450\nset output 'own.png'\nset xlabel 'u'\nset ylabel 'v'\n"
     << "set key outside top\nset samples 501\nplot [-1:1] [0:1] 0.8*abs(x) linecolor 'red' title 'k = 1'";
  for (const auto& orbit : portrait.orbits)
    gp << ", " << gp.file1d(std::tie(orbit.u, orbit.v)) << " with lines linecolor 'black' notitle";
  for (const auto& line : portrait.isochrones)
    gp << ", " << gp.file1d(std::tie(line.u, line.v)) << " with lines linecolor 'gray50' dashtype 2 notitle";
  gp << "\n";
}
