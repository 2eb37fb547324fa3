/* The default experiment, as a master runs it; after a reset and in a new instance it has the same bits. */
#include "parts.h"
#include "rotor.h"

#include <math.h>
#include <stdlib.h>

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
        DONE_PLAIN(&rotor, Terminate);
        DONE_PLAIN(&rotor, Reset);
        CHECK(again == 0 || same_bits(first, second, (size_t)count * real_count), "run %d has other bits", again + 1);
    }
    for (size_t i = 0; i < (size_t)count * real_count; i++) {
        CHECK(isfinite(first[i]), "the variable %u is %g", reals[i % real_count], first[i]);
    }
    CHECK(!same_bits(first, first + real_count, real_count), "the rotor stands still");
    free_rotor(&rotor);
    free(first);
    free(second);
}
