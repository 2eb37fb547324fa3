"""scikit-sundae: CVODE of SUNDIALS with Adams' methods; calls a right-hand side in plain Python."""

from sksundae.cvode import CVODE

from . import equations, task


def main():
    asked = task.read("scikit-sundae")
    rotor, times = asked.rotor, asked.times
    f, begin = equations.in_numbers(rotor), equations.start(rotor)

    def right_hand_side(t, y, dy):
        dy[:] = f(t, y)

    def adams(tolerance):
        solver = CVODE(right_hand_side, method="Adams", rtol=tolerance, atol=tolerance, max_num_steps=10**8)

        def read(result):
            if not result.success:
                raise ArithmeticError(result.message)
            return task.Motion(**equations.motion(rotor, result.y[1:]), evaluations=int(result.nfev))

        return task.Attempt(lambda: solver.solve(times, begin), read)

    asked.answer("CVODE Adams", "tolerance", asked.decades, adams)


if __name__ == "__main__":
    main()
