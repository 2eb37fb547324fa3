"""Exudyn: its own rigid body, explicit Runge-Kutta of order 6 on the Lie group; the support is a function in Python."""

import math
import sys

# First, for it keeps what Exudyn prints apart from the answers.
from . import task

sys.exudynFast = True  # the variant without checks of indices
import exudyn
from exudyn.itemInterface import MarkerBodyRigid, RigidBodySpringDamper, SensorNode
from exudyn.rigidBodyUtilities import RigidBodyInertia

import numpy as np

READ = ("Position", "Velocity", "AngularVelocity", "RotationMatrix")


def support(rotor):
    """The wrench of support and drive at the end a of the rotor, in O, with the sign of Exudyn's springs."""
    c1, c2, d1, d2, tau = (getattr(rotor, name) for name in ("c1", "c2", "d1", "d2", "tau"))

    def wrench(_mbs, _t, _item, displacement, rotation, velocity, omega, *_parameters):
        x, y, z = displacement
        v_x, v_y, v_z = velocity
        w_x, w_y, w_z = omega
        # Tait and Bryan's angles, turned about x, then y, then z.
        a, b, c = rotation
        cos_a, sin_a, cos_b = math.cos(a), math.sin(a), math.cos(b)
        t_x, across, up = cos_b * math.cos(c), math.sin(c), -math.sin(b) * math.cos(c)
        t_y, t_z = cos_a * across - sin_a * up, sin_a * across + cos_a * up
        sine = math.hypot(t_y, t_z)
        f = c2 * (math.atan2(sine, t_x) / sine if sine else 1.0)
        # eq. 14: F = −c1 r_a − d1 v_a, M = −c2 γ − d2 t×(dt/dt); eq. 32: M = τ n
        along, drive = d2 * (w_x * t_x + w_y * t_y + w_z * t_z), tau / (1.0 + t_x)
        return [
            c1 * x + d1 * v_x,
            c1 * y + d1 * v_y,
            c1 * z + d1 * v_z,
            d2 * w_x - along * t_x - tau,
            d2 * w_y - along * t_y - f * t_z - drive * t_y,
            d2 * w_z - along * t_z + f * t_y - drive * t_z,
        ]

    return wrench


def assembled(rotor):
    """The system, and a sensor for each of READ."""
    mbs = exudyn.SystemContainer().AddSystem()
    body = mbs.CreateRigidBody(
        inertia=RigidBodyInertia(mass=rotor.m, inertiaTensor=np.diag([rotor.Ja, rotor.Jt, rotor.Jt])),
        referencePosition=rotor.r_c,
        referenceRotationMatrix=rotor.attitude,
        initialVelocity=rotor.v_c,
        initialAngularVelocity=rotor.omega,
        gravity=rotor.g,
        nodeType=exudyn.NodeType.RotationRotationVector,
        returnDict=True,
    )
    if any((rotor.c1, rotor.c2, rotor.d1, rotor.d2, rotor.tau)):
        ends = [
            mbs.AddMarker(MarkerBodyRigid(bodyNumber=number, localPosition=position))
            for number, position in ((mbs.CreateGround(), [0, 0, 0]), (body["bodyNumber"], [-rotor.l, 0, 0]))
        ]
        mbs.AddObject(RigidBodySpringDamper(markerNumbers=ends, springForceTorqueUserFunction=support(rotor)))
    kinds = [getattr(exudyn.OutputVariableType, name) for name in READ]
    common = {"nodeNumber": body["nodeNumber"], "storeInternal": True, "writeToFile": False}
    sensors = [mbs.AddSensor(SensorNode(outputVariableType=kind, **common)) for kind in kinds]
    mbs.Assemble()
    return mbs, sensors


def main():
    asked = task.read("exudyn")
    times, steps = asked.times, asked.steps()

    def prepare(step):
        mbs, sensors = assembled(asked.rotor)
        count = steps[step] * asked.parts[-1]
        settings = exudyn.SimulationSettings()
        settings.timeIntegration.startTime = times[0]
        settings.timeIntegration.endTime = times[-1]
        settings.timeIntegration.numberOfSteps = count
        settings.solution.file.write = False
        settings.solution.sensors.writePeriod = (times[-1] - times[0]) / asked.parts[-1]

        def run():
            mbs.SolveDynamic(settings, solverType=exudyn.DynamicSolverType.RK67)

        def read(_):
            # A row a part, the start before them; the first column is the time.
            shown = (mbs.GetSensorStoredData(sensor)[asked.parts[1:], 1:] for sensor in sensors)
            r_c, v_c, omega, attitude = shown
            return task.Motion(r_c, v_c, omega, attitude[:, ::3], None, count)

        return task.Attempt(run, read)

    asked.answer("RK67", "step", steps, prepare)


if __name__ == "__main__":
    main()
