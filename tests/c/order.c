/* Calls where they are not legal: refused with a line in the log, and the run goes on as if they had not been. */
#include "parts.h"
#include "rotor.h"

#include <math.h>
#include <stdlib.h>

/* What is legal in no state of a co-simulation instance. */
static void only_in_model_exchange(struct rotor *rotor)
{
    fmi2Real values[64] = {0.0};
    fmi2EventInfo info;
    fmi2Boolean enter = fmi2False, terminate = fmi2False;
    REFUSED_PLAIN(rotor, EnterEventMode);
    REFUSED(rotor, NewDiscreteStates, &info);
    REFUSED_PLAIN(rotor, EnterContinuousTimeMode);
    REFUSED(rotor, CompletedIntegratorStep, fmi2True, &enter, &terminate);
    REFUSED(rotor, SetTime, 0.0);
    REFUSED(rotor, SetContinuousStates, values, states.count);
    REFUSED(rotor, GetDerivatives, values, states.count);
    REFUSED(rotor, GetEventIndicators, values, 1);
    REFUSED(rotor, GetContinuousStates, values, states.count);
    REFUSED(rotor, GetNominalsOfContinuousStates, values, states.count);
}

/* Questions that have no answer of this type. */
static void status_of_other_types(struct rotor *rotor)
{
    fmi2Status status;
    fmi2Real real;
    fmi2Integer integer;
    fmi2Boolean boolean;
    fmi2String string;
    REFUSED(rotor, GetStatus, fmi2LastSuccessfulTime, &status);
    REFUSED(rotor, GetRealStatus, fmi2DoStepStatus, &real);
    REFUSED(rotor, GetIntegerStatus, fmi2DoStepStatus, &integer);
    REFUSED(rotor, GetBooleanStatus, fmi2LastSuccessfulTime, &boolean);
    REFUSED(rotor, GetStringStatus, fmi2PendingStatus, &string);
    REFUSED_PLAIN(rotor, CancelStep);
}

static void bad_steps(struct rotor *rotor, int i)
{
    double t = time_at(i);
    const double steps[] = {0.0, -0.01, NAN, INFINITY, 1e-300};
    const double times[] = {t + 0.5, t - 0.5, NAN, INFINITY};
    for (size_t j = 0; j < sizeof steps / sizeof *steps; j++) {
        /* Near zero a step may be that small. */
        if (t + steps[j] == t || !(steps[j] > 0.0) || isinf(steps[j])) {
            REFUSED(rotor, DoStep, t, steps[j], fmi2True);
        }
    }
    for (size_t j = 0; j < sizeof times / sizeof *times; j++) {
        REFUSED(rotor, DoStep, times[j], 0.01, fmi2True);
    }
}

static void bad_experiments(struct rotor *rotor)
{
    REFUSED(rotor, SetupExperiment, fmi2False, 0.0, NAN, fmi2False, 0.0);
    REFUSED(rotor, SetupExperiment, fmi2False, 0.0, 1.0, fmi2True, 0.0);
    REFUSED(rotor, SetupExperiment, fmi2True, -1.0, 0.0, fmi2False, 0.0);
    REFUSED(rotor, SetupExperiment, fmi2True, NAN, 0.0, fmi2False, 0.0);
}

void order(void)
{
    enum { STEPS = 4 };
    fmi2Real *straight = new_trace(STEPS), *disturbed = new_trace(STEPS);
    struct rotor rotor = started_rotor();
    run(&rotor, 0, STEPS, straight);
    free_rotor(&rotor);

    rotor = new_rotor(fmi2CoSimulation);
    bad_experiments(&rotor);
    only_in_model_exchange(&rotor);
    REFUSED_PLAIN(&rotor, ExitInitializationMode);
    REFUSED_PLAIN(&rotor, Terminate);
    REFUSED(&rotor, DoStep, time_at(0), 0.01, fmi2True);
    status_of_other_types(&rotor);
    DONE(&rotor, SetupExperiment, fmi2False, 0.0, time_at(0), fmi2False, 0.0);
    DONE_PLAIN(&rotor, EnterInitializationMode);
    only_in_model_exchange(&rotor);
    REFUSED_PLAIN(&rotor, EnterInitializationMode);
    REFUSED(&rotor, SetupExperiment, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    REFUSED_PLAIN(&rotor, Terminate);
    REFUSED(&rotor, DoStep, time_at(0), 0.01, fmi2True);
    status_of_other_types(&rotor);
    set_inputs(&rotor, time_at(0));
    DONE_PLAIN(&rotor, ExitInitializationMode);
    for (int i = 0; i < STEPS; i++) {
        only_in_model_exchange(&rotor);
        REFUSED_PLAIN(&rotor, EnterInitializationMode);
        REFUSED_PLAIN(&rotor, ExitInitializationMode);
        REFUSED(&rotor, SetupExperiment, fmi2False, 0.0, 0.0, fmi2False, 0.0);
        status_of_other_types(&rotor);
        bad_steps(&rotor, i);
        run(&rotor, i, 1, disturbed + (size_t)i * real_count);
    }
    CHECK(same_bits(straight, disturbed, STEPS * real_count), "refused calls change the run");
    DONE_PLAIN(&rotor, Terminate);
    REFUSED_PLAIN(&rotor, Terminate);
    REFUSED(&rotor, DoStep, time_at(STEPS), 0.01, fmi2True);
    REFUSED_PLAIN(&rotor, EnterInitializationMode);
    only_in_model_exchange(&rotor);
    free_rotor(&rotor);
    free(straight);
    free(disturbed);
}
