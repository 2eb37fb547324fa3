"""MuJoCo: its own rigid body on a free joint, Runge-Kutta of order 4; the support acts through a callback in Python."""

import math

import mujoco
import numpy as np

from . import task

MODEL = """
<mujoco>
  <option integrator="RK4" gravity="{gravity}"><flag contact="disable" constraint="disable"/></option>
  <worldbody>
    <body>
      <freejoint/>
      <inertial pos="0 0 0" mass="{rotor.m}" diaginertia="{rotor.Ja} {rotor.Jt} {rotor.Jt}"/>
    </body>
  </worldbody>
</mujoco>
"""


def support(rotor):
    """The callback that adds the wrench of support and drive: the force in O, the moment in the body's frame."""
    l, c1, c2, d1, d2, tau = (getattr(rotor, name) for name in ("l", "c1", "c2", "d1", "d2", "tau"))

    def passive(_model, data):
        x, y, z, a, b, c, d = data.qpos.tolist()
        v_x, v_y, v_z, _, q, r = data.qvel.tolist()
        # The columns of the attitude, as MuJoCo normalises it; the first is the axis.
        k = 2.0 / (a * a + b * b + c * c + d * d)
        t_x, t_y, t_z = 1.0 - k * (c * c + d * d), k * (b * c + a * d), k * (b * d - a * c)
        j_x, j_y, j_z = k * (b * c - a * d), 1.0 - k * (b * b + d * d), k * (c * d + a * b)
        k_x, k_y, k_z = k * (b * d + a * c), k * (c * d - a * b), 1.0 - k * (b * b + c * c)
        # The rate of the axis; q and r are the transverse rates in the body's frame.
        dt_x, dt_y, dt_z = r * j_x - q * k_x, r * j_y - q * k_y, r * j_z - q * k_z
        # eq. 14: F = −c1 r_a − d1 v_a, M_c = −l t×F − c2 γ − d2 t×(dt/dt); eq. 32: M = τ n
        F_x = -c1 * (x - l * t_x) - d1 * (v_x - l * dt_x)
        F_y = -c1 * (y - l * t_y) - d1 * (v_y - l * dt_y)
        F_z = -c1 * (z - l * t_z) - d1 * (v_z - l * dt_z)
        sine = math.hypot(t_y, t_z)
        f = c2 * (math.atan2(sine, t_x) / sine if sine else 1.0)
        drive = tau / (1.0 + t_x)
        M_x = l * (F_y * t_z - F_z * t_y) + tau
        M_y = l * (F_z * t_x - F_x * t_z) + f * t_z + drive * t_y
        M_z = l * (F_x * t_y - F_y * t_x) - f * t_y + drive * t_z
        data.qfrc_passive[:] = (
            F_x,
            F_y,
            F_z,
            M_x * t_x + M_y * t_y + M_z * t_z,
            M_x * j_x + M_y * j_y + M_z * j_z - d2 * q,
            M_x * k_x + M_y * k_y + M_z * k_z - d2 * r,
        )

    return passive


def main():
    asked = task.read("mujoco")
    rotor = asked.rotor
    model = mujoco.MjModel.from_xml_string(MODEL.format(rotor=rotor, gravity=" ".join(map(repr, rotor.g))))
    data = mujoco.MjData(model)
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, rotor.attitude.flatten())
    if any((rotor.c1, rotor.c2, rotor.d1, rotor.d2, rotor.tau)):
        mujoco.set_mjcb_passive(support(rotor))
    steps = asked.steps()

    def prepare(step):
        def reset():
            mujoco.mj_resetData(model, data)
            model.opt.timestep = step
            data.qpos[:] = [*rotor.r_c, *quaternion]
            data.qvel[:] = [*rotor.v_c, *rotor.attitude.T @ rotor.omega]

        def run():
            states = []
            for parts in np.diff(asked.parts).tolist():
                mujoco.mj_step(model, data, parts * steps[step])
                states.append(np.concatenate([data.qpos, data.qvel]))
            return np.array(states)

        def read(states):
            frames = np.empty((len(states), 9))
            for frame, state in zip(frames, states):
                mujoco.mju_quat2Mat(frame, state[3:7])
            frames = frames.reshape(-1, 3, 3)
            omega = np.einsum("nij,nj->ni", frames, states[:, 10:])
            count = steps[step] * asked.parts[-1]
            return task.Motion(states[:, :3], states[:, 7:10], omega, frames[:, :, 0], None, count, 4 * count)

        return task.Attempt(run, read, reset)

    asked.answer("RK4", "step", steps, prepare)


if __name__ == "__main__":
    main()
