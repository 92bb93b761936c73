#include "answers/verbs/fields.hpp"

#include "answers/verbs/aim_answer.hpp"
#include "answers/verbs/bounce_answer.hpp"
#include "answers/verbs/check_answer.hpp"
#include "answers/verbs/engine_answer.hpp"
#include "answers/verbs/fit_answer.hpp"
#include "answers/verbs/phase_plane_answer.hpp"
#include "answers/verbs/roll_answer.hpp"
#include "answers/verbs/stop_answer.hpp"

namespace contensou::answers {

std::vector<VerbFields> field_table() {
  return {
      {"all",
       {
           {"`law`, `route`", "", "names"},
           {"`mu`", "", "patch radius over R"},
       }},
      {"stop", stop_fields()},
      {"stop --batch",
       {
           {"in: `mu`, `u0`, `v0`; out: `tau_stop`, of several `--law` a `tau_stop_LAW` for each", "speed",
            "all other columns pass through"},
           {"with --ball in: `slip`, `spin`; out: `t_stop`", "m/s, 1/s; s", "the same in SI units"},
       }},
      {"orbit",
       {
           {"`tau`, `u`, `v`, `ln_v`", "speed", "ln_v does not underflow"},
           {"`k`, `beta`", "", "v/(mu abs(u)); the regularised time (2.8), 0 at the start"},
           {"`u_estimate`, `v_estimate`, `ln_v_estimate`", "speed",
            "with --estimate: the asymptotic solution for small mu at the same tau; 0 from its own stop, E1, on"},
           {"`t`, JSON `ball`; `tau_left`", "s; speed", "of a ball, as of stop; with --time-left"},
           {"`q`, `p`; `integral`", "",
            "with --reduction: v/u and ln v; ln abs(u) - ln w(k), the same on every row; inf where it has no value: on "
            "the axes, on a ray, at rest"},
       }},
      {"law",
       {
           {"`k`, `phi`, `psi`", "", "force over f N, moment over f N times patch radius"},
       }},
      {"roll", roll_fields()},
      {"roll --batch",
       {
           {"in: `slip`, `spin`, or `vx`, `vy`, `wx`, `wy`, `wz`", "m/s, 1/s",
            "the start; all other columns pass through"},
           {"out: `t_rolls`, `x_rolls`, `y_rolls`", "s, m, m",
            "when and where the slip is below --rolling-below, 0.001 m/s unless it is given"},
           {"`t_spin_ends`, `x_spin_ends`, `y_spin_ends`", "s, m, m", "when and where the spin ends; 0 without spin"},
           {"`slip_length`, `turns`, `path`", "m, 1, m",
            "slid by the contact point; about the vertical; of the centre until it rolls or rests"},
           {"`t_rest`, `x_rest`, `y_rest`", "s, m, m",
            "rest of the centre, with --rolling-friction, which holds it on the slope; of a puck, in place of t_rolls, "
            "x_rolls, y_rolls"},
       }},
      {"bounce", bounce_fields()},
      {"portrait",
       {
           {"CSV `kind`, `index`; `u`, `v`, `ln_v`; `k`", "; speed; 1",
            "orbit, highlight, through, isochrone; number of the line; states on it"},
           {"`tau` (JSON `tau_left`, `tau_stop`); `t`", "speed; s", "time left; of a ball"},
           {"`beta`", "1/speed", "of --view regularised: regularised time (2.8) of an orbit from its first state on"},
           {"JSON `portraits` [...]; CSV `mu`, `law`", "",
            "of several --mu or --law: a list of portraits; two columns before the others"},
           {"`view`, `window` [U, V] or [[U1, U2], [V1, V2]], `drive`, `version`, `ball`, `seconds_per_tau`", "",
            "where it comes from; with a drive; the last two of a ball"},
       }},
      {"portrait --system",
       {
           {"`system`, `kind`, `rays`; `centre`; `window`", "", "as `reduce` has them; [[U1, U2], [V1, V2]]"},
           {"`form`; `equilibria` [{`u`, `v`, `kind`, `eigenvalues`}]; `separatrices`", "",
            "without a scaling: as `reduce` has it, null for steps; eigenvalues [[re, im], [re, im]]; orbits"},
           {"CSV `kind`, `index`, `u`, `v`, `tau`", "", "as `portrait` has them; inf where the centre is not reached"},
       }},
      {"portrait --facts", phase_plane_fields()},
      {"sweep",
       {
           {"`mu`, `u0`, `v0`, `tau_stop`; with --ball `spin`, `slip`, `t_stop`", "speed; 1/s, m/s, s",
            "npy: the times alone, shape (N_v0, N_u0) or (N_mu, N_v0, N_u0); (N_slip, N_spin)"},
       }},
      {"check", check_fields()},
      {"check --against", check_against_fields()},
      {"terminal", terminal_fields()},
      {"reduce",
       {
           {"`system`; `drive`", "", "--system, in place of law, mu and body; with --drive"},
           {"`generators` [{`time`: c, `matrix`: A, `shift`: b}]; CSV `time`, `a11` ... `b2`", "",
            "c t d/dt + (A x + b) d/dx, x = (u, v); the first is what is reduced by; `within` where one does not hold "
            "across the lines where the field is not smooth"},
           {"`singular_values`; `level`; `gap`", "",
            "of the determining equations, over the largest; what counts as 0 is below level; how far the others are"},
           {"`form`; `factor`; `tried` [{`form`, `singular_value`, `gap`}]", "",
            "scaling, or the form of the inverse integrating factor V that solves the system, null for none; V in "
            "words; "
            "forms of V in the order in which they were tried"},
           {"`canonical` {`q`, `p`, `dp_dq`}; `first_integral`", "",
            "v/u and ln v; of a system the angle of a direction and ln of the distance, over those of the start; p "
            "less its value on one orbit"},
           {"`rays` [{`k` or `angle`, `attracts`}]", "",
            "also `to_centre`, `radial`, `angular`, `order`: the motion on it, eigenvalues along it and across, 2 for "
            "a "
            "double ray"},
           {"`kind`; `turn` {`factor`, `sigma`}; `undecided`", "",
            "node, saddle, focus, ... of the blown-up centre, null if not decided; a turn of a focus; the reason"},
           {"JSON `strip` [{`ln_k` or `q`, `p`, `u`, `v`, `tau_left`}]", "1, 1, speed, speed, speed",
            "the orbit of the start, before and after it; of a focus turn by turn"},
           {"JSON `copies` [{`factor`, `u0`, `v0`, `tau_stop`}]", "1, speed, speed, speed",
            "starts to which the symmetry moves this one: their orbits are the same strip, ln of the factor higher in "
            "p"},
           {"`tau_stop`; `accuracy`; `end`; `routes` [{`name`, `tau_stop`}]", "speed",
            "inf where the centre is not reached, null before a border or if not decided; its relative error; null if "
            "not decided; section: by the general way; `failure` of a route instead"},
           {"`period`; `by_steps` {`difference`, `time`}", "",
            "time after which the motion returns; difference of its state from that of steps, relative, and when"},
       }},
      {"fit", fit_fields()},
      {"balls",
       {
           {"`name`, `description`, `sources`; `body`, `law`", "", "ball, hollow-ball, disc or ring; its own"},
           {"`radius`, `patch_radius`; `mass`; `friction`, `mu`; `slip`, `spin`; `gravity`",
            "m; kg; 1; m/s, 1/s; m/s^2", "the typical start"},
       }},
      {"aim", aim_fields()},
      {"engine", engine_fields()},
      {"paper",
       {
           {"`equation`, `statement`, `printed`, `computed`, `verdict`, `recorded`, `correction`, `at`", "",
            "JSON: in `claims`"},
       }},
      {"literature",
       {
           {"`name`, `source`, `link`, `read`", "",
            "what of the source was read: the abstract, its code, textbooks, or a citation"},
           {"`published`, `computed`; `verdict`, `recorded`", "", "agrees or differs; JSON: in `rows`"},
       }},
  };
}

}  // namespace contensou::answers
