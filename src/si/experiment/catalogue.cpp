#include "contensou/si/catalogue.hpp"

#include <algorithm>

namespace contensou::si {

namespace {

Body body_of(std::string_view name) { return *std::ranges::find(bodies(), name, &Body::name); }

}  // namespace

const std::vector<CatalogueEntry>& catalogue() {
  static const std::vector<CatalogueEntry> entries{
      {"pool",
       {.ball = {.name = "pool ball on cloth", .mass = 0.1701, .radius = 0.028575},
        .contact = {.friction = 0.2, .patch = SpinDeceleration{10}},
        .start = SlipAndSpin{.slip = 1, .spin = 100}},
       "Size, mass (2.25 in, 0.1701 kg), friction (0.15 to 0.4), spin deceleration (5 to 15 rad/s^2) and rolling\n"
       "friction (0.005 to 0.015): billiards.colostate.edu/threads/physics.html. The patch follows from the spin\n"
       "deceleration."},
      {"steel",
       {.ball = {.name = "steel ball of 20 mm on glass", .mass = 0.0327, .radius = 0.010},
        .contact = {.friction = 0.12,
                    .patch = HertzModuli{.youngs_modulus = {2.1e11, 7.0e10}, .poisson_ratio = {0.3, 0.22}}},
        .start = SlipAndSpin{.slip = 0.5, .spin = 100}},
       "Patch by Hertz's formula with handbook moduli of steel and glass; friction assumed."},
      {"bowling",
       {.ball = {.name = "bowling ball on a dry lane", .mass = 6.8, .radius = 0.1085},
        .contact = {.friction = 0.2,
                    .patch = HertzModuli{.youngs_modulus = {4.186e9, 4.186e9}, .poisson_ratio = {0.3, 0.3}}},
        .start = SlipAndSpin{.slip = 8, .spin = 10}},
       "Regulation size and mass; friction assumed. Patch by Hertz's formula with E* = 2.3 GPa assumed:\n"
       "the two equal pairs of moduli stand for that value only."},
      {"rubber",
       {.ball = {.name = "rubber ball on steel", .mass = 0.072, .radius = 0.025},
        .contact = {.friction = 0.6,
                    .patch = HertzModuli{.youngs_modulus = {2e6, 2.1e11}, .poisson_ratio = {0.49, 0.3}}},
        .start = SlipAndSpin{.slip = 1, .spin = 50}},
       "Patch by Hertz's formula; the moduli of rubber (2 MPa, 0.49) and the friction are assumed."},
      {"gel",
       {.ball = {.name = "gel ball on a rigid plane", .mass = 0.113, .radius = 0.030},
        .contact = {.friction = 0.5,
                    .patch = HertzModuli{.youngs_modulus = {5e4, 2.1e11}, .poisson_ratio = {0.49, 0.3}}},
        .start = SlipAndSpin{.slip = 0.5, .spin = 30}},
       "Patch by Hertz's formula; the moduli of the gel (50 kPa, 0.49) and the friction are assumed, the plane is\n"
       "steel. The patch is large (mu = 0.24): the ball where sliding and spinning are seen to be coupled."},
      {"basketball",
       {.ball = {.name = "basketball on a wooden floor", .mass = 0.6, .radius = 0.121, .body = body_of("hollow-ball")},
        .contact = {.friction = 0.5, .patch = PatchRadius{5.84e-3}, .law = "uniform"},
        .start = SlipAndSpin{.slip = 1, .spin = 20}},
       "Size and mass within the rules (750 to 770 mm around, 580 to 620 g); J of a thin shell and the friction are\n"
       "assumed. Air of 0.55 bar above the room's carries the weight: the pressure is uniform, and the patch has the\n"
       "area m g over it."},
      {"puck",
       {.ball = {.name = "ice hockey puck", .mass = 0.163, .radius = 0.0381, .body = body_of("disc")},
        .contact = {.friction = 0.1, .patch = WholeFace{}},
        .start = SlipAndSpin{.slip = 5, .spin = 100}},
       "Regulation size and mass (3 in across, 5.5 to 6 oz); friction on ice, between 0.05 and 0.15, and uniform\n"
       "pressure on the whole face assumed."},
      {"curling-stone",
       {.ball = {.name = "curling stone on pebbled ice", .mass = 19, .radius = 0.145, .body = body_of("disc")},
        .contact = {.friction = 0.008, .patch = PatchRadius{0.065}, .law = "ring"},
        .start = SlipAndSpin{.slip = 2, .spin = 1.57}},
       "Radii of stone and running band, 145 and 65 mm, and spin: DigitalCurling, simulator_fcv1.cpp; mass within\n"
       "the rules (17.24 to 19.96 kg). J_z of a disc and a thin band assumed; and a constant friction, where ice has\n"
       "less at speed: 0.0072 at 2 m/s to 0.0098 at 0.5 m/s in that simulator's fit. It does not curl here.",
       "the curling stone does not curl here: "
       "its friction is the same at the front and at the back, so that it goes straight"},
  };
  return entries;
}

const CatalogueEntry* find_ball(std::string_view name) {
  const auto found = std::ranges::find(catalogue(), name, &CatalogueEntry::name);
  return found == catalogue().end() ? nullptr : &*found;
}

}  // namespace contensou::si
