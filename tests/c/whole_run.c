/* The default experiment, as a master runs it; after a reset and in a new instance it has the same bits. */
#include "parts.h"
#include "rotor.h"

#include <math.h>
#include <stdlib.h>

/* |energy.residual| in parts of the largest energy seen; the tests of the packaged FMU look more closely. */
static const double RESIDUAL = 1e-6;

/* What energies count with in the solver's absolute tolerance, however little there is [J]. */
static const double NOMINAL = 1.0;

static void check_energy(const fmi2Real *trace, int count)
{
    double largest = 0.0, residual = 0.0;
    for (size_t j = 0; j < real_count; j++) {
        for (size_t i = 0; i < (size_t)count; i++) {
            double value = trace[i * real_count + j];
            if (!CHECK(isfinite(value), "the variable %u is %g at step %zu", reals[j], value, i)) {
                return;
            }
            if (reals[j] == variable("energy.residual")->reference) {
                residual = fmax(residual, fabs(value));
            } else if (reals[j] == variable("energy.kinetic")->reference) {
                largest = fmax(largest, value);
            }
        }
    }
    CHECK(residual <= RESIDUAL * fmax(largest, NOMINAL), "the energy is off by %g J of %g J", residual, largest);
}

static void check_status(struct rotor *rotor, int count)
{
    fmi2Status status = fmi2Pending;
    fmi2Real time = -1.0;
    fmi2Boolean terminated = 7;
    DONE(rotor, GetStatus, fmi2DoStepStatus, &status);
    DONE(rotor, GetRealStatus, fmi2LastSuccessfulTime, &time);
    DONE(rotor, GetBooleanStatus, fmi2Terminated, &terminated);
    CHECK(status == fmi2OK && fabs(time - time_at(count)) < 1e-9 && terminated == fmi2False,
          "after %d steps the status is %d, the time %.17g and terminated %d", count, status, time, terminated);
}

void whole_run(void)
{
    double stop = number("DefaultExperiment.stopTime");
    int whole = (int)lround((stop - time_at(0)) / communication_step());
    int count = whole < options.steps ? whole : options.steps;
    fmi2Real *first = new_trace(count), *second = new_trace(count);
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    for (int again = 0; again < 3; again++) {
        if (again == 2) {
            free_rotor(&rotor);
            rotor = new_rotor(fmi2CoSimulation);
        }
        DONE(&rotor, SetupExperiment, fmi2True, number("DefaultExperiment.tolerance"), time_at(0), fmi2True, stop);
        DONE_PLAIN(&rotor, EnterInitializationMode);
        set_inputs(&rotor, time_at(0));
        DONE_PLAIN(&rotor, ExitInitializationMode);
        run(&rotor, 0, count, again == 0 ? first : second);
        check_status(&rotor, count);
        if (count == whole) {
            REFUSED(&rotor, DoStep, time_at(count), 0.1, fmi2True);
        }
        DONE_PLAIN(&rotor, Terminate);
        DONE_PLAIN(&rotor, Reset);
        CHECK(again == 0 || same_bits(first, second, (size_t)count * real_count), "run %d has other bits", again + 1);
    }
    check_energy(first, count);
    CHECK(!same_bits(first, first + real_count, real_count), "the rotor stands still");
    free_rotor(&rotor);
    free(first);
    free(second);
}
