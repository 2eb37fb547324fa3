/* Model exchange with the host's own Runge-Kutta loop and its events. Where it arrives, tests/fmu/test_model_exchange.py and
   model/tests/all/exchange.rs compare with co-simulation. */
#include "exchange.h"
#include "parts.h"
#include "rotor.h"

#include <math.h>
#include <stdlib.h>

/* Steps over a span of half a second. */
enum { STEPS = 1000 };
static const double SPAN = 0.5;

void model_exchange(void)
{
    fmi2Real *nominals = allocated(states.count, sizeof *nominals), *values = new_trace(1);
    const struct variable *chart = variable("state.chart");
    fmi2Integer first = 0, last = 0;
    struct rotor rotor = new_rotor(fmi2ModelExchange);
    initialize(&rotor);
    enter_continuous_time(&rotor);
    DONE(&rotor, GetNominalsOfContinuousStates, nominals, states.count);
    DONE(&rotor, GetInteger, &chart->reference, 1, &first);
    int events = integrate(&rotor, time_at(0), SPAN / STEPS, STEPS);
    DONE(&rotor, GetInteger, &chart->reference, 1, &last);
    CHECK(first == last || events > 0, "the chart went from %d to %d without an event", first, last);
    read_reals(&rotor, values);
    for (size_t i = 0; i < real_count; i++) {
        CHECK(isfinite(values[i]), "the variable %u is %g", reals[i], values[i]);
    }
    DONE_PLAIN(&rotor, Terminate);
    free_rotor(&rotor);
    free(nominals);
    free(values);
}
