"""SciPy: DOP853, and LSODA as the compiled loop of odeint; both call a right-hand side in plain Python."""

from scipy.integrate import odeint, solve_ivp

from . import equations, task


def main():
    asked = task.read("scipy")
    rotor, times = asked.rotor, asked.times
    f, begin = equations.in_numbers(rotor), equations.start(rotor)

    def dop853(tolerance):
        span = (times[0], times[-1])

        def run():
            return solve_ivp(f, span, begin, "DOP853", times, rtol=tolerance, atol=tolerance)

        def read(result):
            return task.Motion(**equations.motion(rotor, result.y.T[1:]), evaluations=result.nfev)

        return task.Attempt(run, read)

    def lsoda(tolerance):
        def run():
            return odeint(f, begin, times, rtol=tolerance, atol=tolerance, tfirst=True, mxstep=10**8, full_output=True)

        def read(result):
            states, told = result
            counts = {"steps": int(told["nst"][-1]), "evaluations": int(told["nfe"][-1])}
            return task.Motion(**equations.motion(rotor, states[1:]), **counts)

        return task.Attempt(run, read)

    asked.answer("LSODA", "tolerance", asked.decades, lsoda)
    asked.answer("DOP853", "tolerance", asked.decades, dop853)


if __name__ == "__main__":
    main()
