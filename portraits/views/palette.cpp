#include "views/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "data/round_numbers.hpp"

namespace contensou::portraits {

namespace {

constexpr std::array<unsigned, 9> viridis_steps{0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                                0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};

std::vector<Colour> spread(const std::vector<Colour>& colours, std::size_t count) {
  std::vector<Colour> result;
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(colours[count == 1 ? 0 : i * (colours.size() - 1) / (count - 1)]);
  }
  return result;
}

/// Returns the number of bands of an interval so that a band is 1, 2 or 5 times a power of ten, in the unit of the bar.
std::size_t bands_per(double interval, double unit) {
  for (std::size_t count : {3, 4, 5, 2}) {
    constexpr double same = 1e-6;
    const double step = interval / unit / static_cast<double>(count) * (1 + same);
    if (step < round_down(step) * (1 + 2 * same)) return count;
  }
  return 1;
}

/// Returns bands of equal width; bands_per gives their number in an interval.
TimeBands linear_bands(double longest, double interval, double unit, const Palette& palette) {
  const std::size_t per_interval = bands_per(interval, unit);
  TimeBands bands;
  bands.edges = multiples(0, longest, interval / static_cast<double>(per_interval));
  bands.colours = spread(palette.times, bands.edges.size() + 1);
  for (std::size_t band = 0; band <= bands.edges.size(); band += per_interval) {
    if (band > 0) bands.arrows.push_back((bands.begin(bands.marked.back()) + bands.begin(band)) / 2);
    bands.marked.push_back(band);
  }
  return bands;
}

}  // namespace

Colour viridis(double fraction, double white) {
  const double place = fraction * (viridis_steps.size() - 1);
  const auto index = std::min(static_cast<std::size_t>(place), viridis_steps.size() - 2);
  const double part = place - static_cast<double>(index);
  unsigned rgb = 0;
  for (int shift : {16, 8, 0}) {
    const double low = (viridis_steps[index] >> shift) & 0xFF, high = (viridis_steps[index + 1] >> shift) & 0xFF;
    rgb |= static_cast<unsigned>(std::lround(white * 255 + (1 - white) * (low + part * (high - low)))) << shift;
  }
  return {rgb};
}

Palette palette(bool screen) {
  std::vector<Colour> times;
  constexpr int steps = 64;
  // Times next to the stop are darkest on paper and lightest on a dark screen. All contrast 3:1 with the ground.
  for (int i = 0; i <= steps; ++i) {
    const double fraction = static_cast<double>(i) / steps;
    times.push_back(viridis(screen ? 1 - 0.6 * fraction : 0.55 * fraction));
  }
  if (screen) {
    return {{{0x10141c}, {0xe3e8f0}, {0x9aa5b8}, 1.25, 1.15},
            {0x7fb4e6},
            {0xf0a35e},
            {0xff6f91},
            {0xe3e8f0},
            {0x6b778c},
            {0x55627a},
            {0x1a2130},
            times};
  }
  return {{}, {0x0b4f8a}, {0xc8621a}, {0xc2185b}, {0x222222}, {0x8a8f98}, {0xa9b0ba}, {0xf6f7f9}, times};
}

std::size_t TimeBands::band(double tau) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(edges, tau) - edges.begin());
}

TimeBands bands_of(const std::vector<const Portrait*>& portraits, double unit, const Palette& palette, double most) {
  double longest = 0, of_highlights = 0;
  std::vector<double> isochrones;
  const auto take_longest = [](double& time, const std::vector<PortraitOrbit>& orbits) {
    for (const PortraitOrbit& orbit : orbits) {
      if (std::isfinite(orbit.tau_left[0])) time = std::max(time, orbit.tau_left[0]);
    }
  };
  for (const Portrait* portrait : portraits) {
    take_longest(longest, portrait->orbits);
    take_longest(longest, portrait->through);
    take_longest(of_highlights, portrait->highlight);
    for (const Isochrone& isochrone : portrait->isochrones) isochrones.push_back(isochrone.tau_stop);
  }
  if (longest == 0) longest = of_highlights > 0 ? of_highlights : 1;
  longest = std::min(longest, most);
  const double step = portraits.front()->isochrone_step;
  if (isochrones.empty()) return linear_bands(longest, unit * round_down(longest / unit / 4), unit, palette);
  if (step > 0) return linear_bands(longest, step, unit, palette);
  std::ranges::sort(isochrones);
  isochrones.erase(std::unique(isochrones.begin(), isochrones.end()), isochrones.end());
  TimeBands bands{isochrones, spread(palette.times, isochrones.size() + 1), {}, {}};
  for (std::size_t band = 0; band <= isochrones.size(); ++band) {
    if (band > 0) bands.arrows.push_back((bands.begin(band - 1) + bands.begin(band)) / 2);
    bands.marked.push_back(band);
  }
  return bands;
}

TimeBands logarithmic_bands(double shortest, double longest, double unit, const Palette& palette) {
  constexpr int per_decade = 6;
  // Edges are sixths of decades in the unit of the bar.
  const int top = static_cast<int>(std::ceil(per_decade * std::log10(longest / unit)));
  TimeBands bands;
  for (int i = static_cast<int>(std::floor(per_decade * std::log10(shortest / unit))); i < top; ++i) {
    bands.edges.push_back(unit * std::pow(10, static_cast<double>(i) / per_decade));
    if (i % per_decade == 0) bands.marked.push_back(bands.edges.size());
  }
  bands.colours = spread(palette.times, bands.edges.size() + 1);
  return bands;
}

ColourBar colour_bar(const TimeBands& bands, const PortraitCaption& caption) {
  const std::string& unit = caption.time_unit_name;
  ColourBar bar{caption.time_symbol + " left" + (unit.empty() ? "" : " (" + unit + ")"), bands.colours, {}};
  std::vector<double> begins;
  for (std::size_t band : bands.marked) begins.push_back(bands.begin(band) / caption.time_unit);
  const bool equal = begins.front() == 0;
  const std::vector<Text> powers = equal ? std::vector<Text>{} : powers_of_ten(begins);
  // Bands have equal heights on the bar.
  for (std::size_t i = 0; i < begins.size(); ++i) {
    bar.ticks.push_back({static_cast<double>(bands.marked[i]) / static_cast<double>(bands.colours.size()),
                         equal ? number(begins[i]) : powers[i]});
  }
  return bar;
}

Text time_left(const PortraitCaption& caption) {
  const std::string& unit = caption.time_unit_name;
  return "time left " + caption.time_symbol + (unit.empty() ? "" : ", " + unit);
}

}  // namespace contensou::portraits
