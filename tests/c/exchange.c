#include "exchange.h"

#include <stdlib.h>
#include <string.h>

/* An iteration of events that takes more is taken for one without an end. */
enum { EVENT_ITERATIONS = 100 };

void enter_continuous_time(struct rotor *rotor)
{
    fmi2EventInfo info = {.newDiscreteStatesNeeded = fmi2True};
    int iterations = 0;
    while (info.newDiscreteStatesNeeded && iterations++ < EVENT_ITERATIONS) {
        memset(&info, 0x5a, sizeof info);
        DONE(rotor, NewDiscreteStates, &info);
        CHECK(!info.terminateSimulation, "an event wants the end");
    }
    CHECK(iterations <= EVENT_ITERATIONS, "the events have no end");
    DONE_PLAIN(rotor, EnterContinuousTimeMode);
}

static void rates(struct rotor *rotor, double t, const fmi2Real *x, fmi2Real *rate)
{
    DONE(rotor, SetTime, t);
    DONE(rotor, SetContinuousStates, x, states.count);
    set_inputs(rotor, t);
    DONE(rotor, GetDerivatives, rate, states.count);
}

/* `to` = `x` + `h` `rate` */
static void moved(fmi2Real *to, const fmi2Real *x, double h, const fmi2Real *rate)
{
    for (size_t i = 0; i < states.count; i++) {
        to[i] = x[i] + h * rate[i];
    }
}

/* After a step: whether the FMU asks for an event, by its indicators or its word. */
static bool has_event(struct rotor *rotor, double *signs)
{
    size_t count = (size_t)number("fmiModelDescription.numberOfEventIndicators");
    fmi2Real *indicators = allocated(count, sizeof *indicators);
    fmi2Boolean enter = 7, terminate = 7;
    bool crossed = false;
    DONE(rotor, GetEventIndicators, indicators, count);
    for (size_t i = 0; i < count; i++) {
        double sign = indicators[i] > 0.0 ? 1.0 : -1.0;
        crossed |= signs[i] != 0.0 && signs[i] != sign;
        signs[i] = sign;
    }
    free(indicators);
    DONE(rotor, CompletedIntegratorStep, fmi2True, &enter, &terminate);
    CHECK(terminate == fmi2False, "a step wants the end");
    return crossed || enter != fmi2False;
}

int integrate(struct rotor *rotor, double start, double h, int count)
{
    size_t n = states.count;
    fmi2Real *x = allocated(n, sizeof *x), *at = allocated(n, sizeof *at), *k[4];
    double *signs = allocated((size_t)number("fmiModelDescription.numberOfEventIndicators"), sizeof *signs);
    int events = 0;
    for (int i = 0; i < 4; i++) {
        k[i] = allocated(n, sizeof **k);
    }
    DONE(rotor, GetContinuousStates, x, n);
    for (int i = 0; i < count; i++) {
        double t = start + i * h;
        rates(rotor, t, x, k[0]);
        moved(at, x, 0.5 * h, k[0]);
        rates(rotor, t + 0.5 * h, at, k[1]);
        moved(at, x, 0.5 * h, k[1]);
        rates(rotor, t + 0.5 * h, at, k[2]);
        moved(at, x, h, k[2]);
        rates(rotor, t + h, at, k[3]);
        for (size_t j = 0; j < n; j++) {
            x[j] += h / 6.0 * (k[0][j] + 2.0 * k[1][j] + 2.0 * k[2][j] + k[3][j]);
        }
        DONE(rotor, SetTime, start + (i + 1) * h);
        DONE(rotor, SetContinuousStates, x, n);
        set_inputs(rotor, start + (i + 1) * h);
        if (has_event(rotor, signs)) {
            events++;
            DONE_PLAIN(rotor, EnterEventMode);
            enter_continuous_time(rotor);
            DONE(rotor, GetContinuousStates, x, n);
        }
    }
    for (int i = 0; i < 4; i++) {
        free(k[i]);
    }
    free(x);
    free(at);
    free(signs);
    return events;
}
