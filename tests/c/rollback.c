/* FMU states: saved, used again, brought back in any order and from any stage; what follows has the same bits. */
#include "parts.h"
#include "rotor.h"

#include <stdlib.h>

enum { STEPS = 20, AFTER = 10 };

/* What follows from the state at each point is what followed before, in whatever order they are brought back. */
static void any_order(void)
{
    enum { POINTS = 16 };
    fmi2FMUstate saved[POINTS] = {NULL};
    fmi2Real *straight = new_trace(POINTS + AFTER), *again = new_trace(AFTER);
    struct rotor rotor = started_rotor();
    for (int i = 0; i < POINTS + AFTER; i++) {
        if (i < POINTS) {
            DONE(&rotor, GetFMUstate, &saved[i]);
        }
        run(&rotor, i, 1, straight + (size_t)i * real_count);
    }
    for (int i = 0; i < POINTS; i++) {
        int point = 7 * i % POINTS;
        DONE(&rotor, SetFMUstate, saved[point]);
        run(&rotor, point, AFTER, again);
        CHECK(same_bits(again, straight + (size_t)point * real_count, AFTER * real_count),
              "what follows the state at point %d has other bits", point);
    }
    for (int i = 0; i < POINTS; i++) {
        int point = 5 * i % POINTS;
        DONE(&rotor, FreeFMUstate, &saved[point]);
        CHECK(saved[point] == NULL, "a freed state is not null");
        DONE(&rotor, FreeFMUstate, &saved[point]);
    }
    free_rotor(&rotor);
    free(straight);
    free(again);
}

/* A master that tries each step twice, with one state object for the whole run. */
static void reused(void)
{
    fmi2FMUstate state = NULL, first;
    fmi2Real *straight = new_trace(STEPS), *tried = new_trace(STEPS);
    struct rotor rotor = started_rotor();
    run(&rotor, 0, STEPS, straight);
    free_rotor(&rotor);
    rotor = started_rotor();
    DONE(&rotor, GetFMUstate, &state);
    first = state;
    for (int i = 0; i < STEPS; i++) {
        double t = time_at(i);
        DONE(&rotor, GetFMUstate, &state);
        CHECK(state == first, "the object is not used again");
        set_inputs(&rotor, t + 0.3);
        DONE(&rotor, DoStep, t, 2.7 * (time_at(i + 1) - t), fmi2False);
        DONE(&rotor, SetFMUstate, state);
        run(&rotor, i, 1, tried + (size_t)i * real_count);
    }
    CHECK(same_bits(straight, tried, STEPS * real_count), "steps that are taken back leave a trace");
    DONE(&rotor, FreeFMUstate, &state);
    free_rotor(&rotor);
    free(straight);
    free(tried);
}

/* A state of each stage of the life brings that stage back. */
static void stages(void)
{
    fmi2FMUstate instantiated = NULL, initialization = NULL, stepping = NULL, terminated = NULL;
    fmi2Real *straight = new_trace(AFTER), *again = new_trace(AFTER);
    const struct variable *mass = variable("rotor.m");
    fmi2Real other = 2.0 * mass->start, found = 0.0;
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    DONE(&rotor, GetFMUstate, &instantiated);
    DONE(&rotor, SetupExperiment, fmi2False, 0.0, time_at(0), fmi2False, 0.0);
    DONE_PLAIN(&rotor, EnterInitializationMode);
    set_inputs(&rotor, time_at(0));
    DONE(&rotor, GetFMUstate, &initialization);
    DONE_PLAIN(&rotor, ExitInitializationMode);
    DONE(&rotor, GetFMUstate, &stepping);
    run(&rotor, 0, AFTER, straight);
    DONE_PLAIN(&rotor, Terminate);
    DONE(&rotor, GetFMUstate, &terminated);

    DONE(&rotor, SetFMUstate, initialization);
    DONE(&rotor, SetReal, &mass->reference, 1, &other);
    DONE(&rotor, SetFMUstate, initialization);
    DONE(&rotor, GetReal, &mass->reference, 1, &found);
    CHECK(found == mass->start, "a parameter is not brought back");
    DONE_PLAIN(&rotor, ExitInitializationMode);
    run(&rotor, 0, AFTER, again);
    CHECK(same_bits(straight, again, AFTER * real_count), "from initialization mode the run has other bits");

    DONE(&rotor, SetFMUstate, terminated);
    REFUSED(&rotor, DoStep, time_at(AFTER), 0.01, fmi2True);
    /* A state outlives a reset. */
    DONE_PLAIN(&rotor, Reset);
    DONE(&rotor, SetFMUstate, stepping);
    run(&rotor, 0, AFTER, again);
    CHECK(same_bits(straight, again, AFTER * real_count), "from step mode the run has other bits");

    DONE(&rotor, SetFMUstate, instantiated);
    initialize(&rotor);
    run(&rotor, 0, AFTER, again);
    CHECK(same_bits(straight, again, AFTER * real_count), "from the instantiated state the run has other bits");

    DONE(&rotor, FreeFMUstate, &instantiated);
    DONE(&rotor, FreeFMUstate, &initialization);
    DONE(&rotor, FreeFMUstate, &stepping);
    DONE(&rotor, FreeFMUstate, &terminated);
    free_rotor(&rotor);
    free(straight);
    free(again);
}

void rollback(void)
{
    if (claims("CoSimulation.canGetAndSetFMUstate")) {
        any_order();
        reused();
        stages();
    }
}
