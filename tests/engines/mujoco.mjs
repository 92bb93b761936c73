// A ball on a plane in MuJoCo.
import loadMujoco from "mujoco-js";
import { fading, slipOf } from "./fading.mjs";

const mujoco = await loadMujoco();

/** A vector in the axes of a body, in those of the world. */
function turned([w, x, y, z], [a, b, c]) {
  const t = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * t[0] + y * t[2] - z * t[1], b + w * t[1] + z * t[0] - x * t[2], c + w * t[2] + x * t[1] - y * t[0]];
}

/**
 * @param model  {dt, option, contact, plane, geom}: attributes of <option>, of a <pair> (none: by those of the two
 *               geoms), of the plane and of the ball
 * @param end    s
 */
export function mujocoTimes(ball, { dt, option, contact = "", plane = "", geom = "" }, end) {
  const alone = contact ? 'contype="0" conaffinity="0"' : "";
  mujoco.FS.writeFile("/ball.xml", `<mujoco>
    <option timestep="${dt}" gravity="0 0 ${-ball.gravity}" tolerance="1e-14" ${option}/>
    <worldbody>
      <geom name="plane" type="plane" size="50 50 .1" ${alone} ${plane}/>
      <body pos="0 0 ${ball.radius}">
        <freejoint/>
        <geom name="ball" type="sphere" size="${ball.radius}" mass="${ball.mass}" ${alone} ${geom}/>
      </body>
    </worldbody>
    ${contact ? `<contact><pair geom1="plane" geom2="ball" ${contact}/></contact>` : ""}
  </mujoco>`);
  const model = mujoco.MjModel.loadFromXML("/ball.xml");
  const data = new mujoco.MjData(model);
  for (let i = 0; i < 2000; ++i) mujoco.mj_step(model, data); // until it lies
  data.qvel[0] = ball.slip;
  data.qvel[5] = ball.spin;
  const step = () => {
    mujoco.mj_step(model, data);
    const w = turned(data.qpos.slice(3, 7), data.qvel.slice(3, 6));
    return { slip: slipOf(ball.radius, data.qvel, w), spin: w[2] };
  };
  const times = fading(ball, step, dt, end);
  data.delete();
  model.delete();
  return times;
}
