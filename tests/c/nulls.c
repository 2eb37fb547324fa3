/* Null pointers in every argument of every function: refused, without a crash and without a change. */
#include "exchange.h"
#include "parts.h"
#include "rotor.h"

#include <stdlib.h>

/* Without an instance nobody can be told: the status is all. */
#define NO_INSTANCE(function, ...) \
    CHECK(fmi.function(NULL, __VA_ARGS__) == fmi2Error, "fmi2" #function " of no instance is an error")
#define NO_INSTANCE_PLAIN(function) \
    CHECK(fmi.function(NULL) == fmi2Error, "fmi2" #function " of no instance is an error")

static void without_an_instance(void)
{
    const fmi2ValueReference reference = variable("rotor.m")->reference;
    const fmi2String text = "logAll";
    const fmi2Integer one = 1;
    fmi2Real real = 0.0;
    fmi2Integer integer = 0;
    fmi2String string = NULL;
    fmi2FMUstate state = NULL;
    fmi2Byte byte = 0;
    fmi2EventInfo info;
    fmi2Status status;
    size_t size;
    NO_INSTANCE(SetDebugLogging, fmi2True, 1, &text);
    fmi.FreeInstance(NULL);
    NO_INSTANCE(SetupExperiment, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    NO_INSTANCE_PLAIN(EnterInitializationMode);
    NO_INSTANCE_PLAIN(ExitInitializationMode);
    NO_INSTANCE_PLAIN(Terminate);
    NO_INSTANCE_PLAIN(Reset);
    NO_INSTANCE(GetReal, &reference, 1, &real);
    NO_INSTANCE(GetInteger, &reference, 1, &integer);
    NO_INSTANCE(GetBoolean, &reference, 1, &integer);
    NO_INSTANCE(GetString, &reference, 1, &string);
    NO_INSTANCE(SetReal, &reference, 1, &real);
    NO_INSTANCE(SetInteger, &reference, 1, &integer);
    NO_INSTANCE(SetBoolean, &reference, 1, &integer);
    NO_INSTANCE(SetString, &reference, 1, &string);
    NO_INSTANCE(GetFMUstate, &state);
    NO_INSTANCE(SetFMUstate, state);
    NO_INSTANCE(FreeFMUstate, &state);
    NO_INSTANCE(SerializedFMUstateSize, state, &size);
    NO_INSTANCE(SerializeFMUstate, state, &byte, 1);
    NO_INSTANCE(DeSerializeFMUstate, &byte, 1, &state);
    NO_INSTANCE(GetDirectionalDerivative, &reference, 1, &reference, 1, &real, &real);
    NO_INSTANCE_PLAIN(EnterEventMode);
    NO_INSTANCE(NewDiscreteStates, &info);
    NO_INSTANCE_PLAIN(EnterContinuousTimeMode);
    NO_INSTANCE(CompletedIntegratorStep, fmi2True, &integer, &integer);
    NO_INSTANCE(SetTime, 0.0);
    NO_INSTANCE(SetContinuousStates, &real, 1);
    NO_INSTANCE(GetDerivatives, &real, 1);
    NO_INSTANCE(GetEventIndicators, &real, 1);
    NO_INSTANCE(GetContinuousStates, &real, 1);
    NO_INSTANCE(GetNominalsOfContinuousStates, &real, 1);
    NO_INSTANCE(SetRealInputDerivatives, &reference, 1, &one, &real);
    NO_INSTANCE(GetRealOutputDerivatives, &reference, 1, &one, &real);
    NO_INSTANCE(DoStep, 0.0, 0.1, fmi2True);
    NO_INSTANCE_PLAIN(CancelStep);
    NO_INSTANCE(GetStatus, fmi2DoStepStatus, &status);
    NO_INSTANCE(GetRealStatus, fmi2LastSuccessfulTime, &real);
    NO_INSTANCE(GetIntegerStatus, fmi2DoStepStatus, &integer);
    NO_INSTANCE(GetBooleanStatus, fmi2Terminated, &integer);
    NO_INSTANCE(GetStringStatus, fmi2PendingStatus, &string);
}

/* fmi2Instantiate with one argument null; the place of the resources is not used and may be. */
static void no_instance_made(void)
{
    struct journal journal = {0};
    const fmi2CallbackFunctions callbacks = {write_journal, NULL, NULL, NULL, &journal};
    const char *guid = attribute("fmiModelDescription.guid"), *place = "file:///nowhere";
    CHECK(fmi.Instantiate(NULL, fmi2CoSimulation, guid, place, &callbacks, fmi2False, fmi2False) == NULL, "no name");
    CHECK(fmi.Instantiate("rotor", fmi2CoSimulation, NULL, place, &callbacks, fmi2False, fmi2False) == NULL, "no GUID");
    CHECK(fmi.Instantiate("", fmi2CoSimulation, guid, place, &callbacks, fmi2False, fmi2False) == NULL,
          "an empty name");
    CHECK(fmi.Instantiate("rotor", fmi2CoSimulation, "{0}", place, &callbacks, fmi2False, fmi2False) == NULL,
          "a wrong GUID");
    CHECK(fmi.Instantiate("rotor", (fmi2Type)7, guid, place, &callbacks, fmi2False, fmi2False) == NULL, "a wrong type");
    CHECK(journal.count == 5 && journal.status == fmi2Error, "five refusals make %d lines", journal.count);
    CHECK(fmi.Instantiate("rotor", fmi2CoSimulation, guid, place, NULL, fmi2False, fmi2False) == NULL, "no callbacks");
    fmi2Component lives = fmi.Instantiate("rotor", fmi2CoSimulation, guid, NULL, &callbacks, fmi2False, fmi2False);
    CHECK(lives != NULL, "the place of the resources is not needed");
    fmi.FreeInstance(lives);
}

/* What co-simulation and model exchange have in common. */
static void in_both_kinds(struct rotor *rotor)
{
    const fmi2ValueReference reference = variable("rotor.m")->reference;
    const fmi2String no_name = NULL;
    fmi2Real real = 0.0;
    fmi2Integer integer = 0;
    fmi2String string = "text";
    fmi2FMUstate none = NULL;
    fmi2Byte byte = 0;
    size_t size = 0;
    REFUSED(rotor, SetDebugLogging, fmi2True, 1, NULL);
    REFUSED(rotor, SetDebugLogging, fmi2True, 1, &no_name);
    REFUSED(rotor, GetReal, NULL, 1, &real);
    REFUSED(rotor, GetReal, &reference, 1, NULL);
    REFUSED(rotor, GetInteger, NULL, 1, &integer);
    REFUSED(rotor, GetInteger, &variable("solver.method")->reference, 1, NULL);
    REFUSED(rotor, GetBoolean, NULL, 1, &integer);
    REFUSED(rotor, GetBoolean, &reference, 1, NULL);
    REFUSED(rotor, GetString, NULL, 1, &string);
    REFUSED(rotor, GetString, &reference, 1, NULL);
    REFUSED(rotor, SetReal, NULL, 1, &real);
    REFUSED(rotor, SetReal, &reference, 1, NULL);
    REFUSED(rotor, SetInteger, NULL, 1, &integer);
    REFUSED(rotor, SetInteger, &variable("solver.method")->reference, 1, NULL);
    REFUSED(rotor, SetBoolean, NULL, 1, &integer);
    REFUSED(rotor, SetBoolean, &reference, 1, NULL);
    REFUSED(rotor, SetString, NULL, 1, &string);
    REFUSED(rotor, SetString, &reference, 1, NULL);
    REFUSED(rotor, GetFMUstate, NULL);
    REFUSED(rotor, SetFMUstate, NULL);
    REFUSED(rotor, SerializedFMUstateSize, NULL, &size);
    REFUSED(rotor, SerializeFMUstate, NULL, &byte, 1);
    REFUSED(rotor, DeSerializeFMUstate, NULL, 1, &none);
    REFUSED(rotor, DeSerializeFMUstate, &byte, 1, NULL);
    DONE(rotor, FreeFMUstate, &none);
    if (claims("CoSimulation.canSerializeFMUstate")) {
        fmi2FMUstate state = NULL;
        DONE(rotor, GetFMUstate, &state);
        REFUSED(rotor, SerializedFMUstateSize, state, NULL);
        DONE(rotor, SerializedFMUstateSize, state, &size);
        REFUSED(rotor, SerializeFMUstate, state, NULL, size);
        DONE(rotor, FreeFMUstate, &state);
    }
    REFUSED(rotor, GetDirectionalDerivative, NULL, 1, &reference, 1, &real, &real);
    REFUSED(rotor, GetDirectionalDerivative, &reference, 1, NULL, 1, &real, &real);
    REFUSED(rotor, GetDirectionalDerivative, &reference, 1, &reference, 1, NULL, &real);
    REFUSED(rotor, GetDirectionalDerivative, &reference, 1, &reference, 1, &real, NULL);
}

static void in_co_simulation(void)
{
    enum { STEPS = 3 };
    const fmi2ValueReference output = variable("phi")->reference;
    const fmi2Integer one = 1;
    fmi2Real real = 0.0;
    fmi2Real *straight = new_trace(STEPS), *disturbed = new_trace(STEPS);
    struct rotor rotor = started_rotor();
    run(&rotor, 0, STEPS, straight);
    free_rotor(&rotor);
    rotor = started_rotor();
    for (int i = 0; i < STEPS; i++) {
        in_both_kinds(&rotor);
        REFUSED(&rotor, SetRealInputDerivatives, NULL, 1, &one, &real);
        REFUSED(&rotor, SetRealInputDerivatives, &output, 1, NULL, &real);
        REFUSED(&rotor, SetRealInputDerivatives, &output, 1, &one, NULL);
        REFUSED(&rotor, GetRealOutputDerivatives, NULL, 1, &one, &real);
        REFUSED(&rotor, GetRealOutputDerivatives, &output, 1, NULL, &real);
        REFUSED(&rotor, GetRealOutputDerivatives, &output, 1, &one, NULL);
        REFUSED(&rotor, GetStatus, fmi2DoStepStatus, NULL);
        REFUSED(&rotor, GetRealStatus, fmi2LastSuccessfulTime, NULL);
        REFUSED(&rotor, GetIntegerStatus, fmi2DoStepStatus, NULL);
        REFUSED(&rotor, GetBooleanStatus, fmi2Terminated, NULL);
        REFUSED(&rotor, GetStringStatus, fmi2PendingStatus, NULL);
        run(&rotor, i, 1, disturbed + (size_t)i * real_count);
    }
    CHECK(same_bits(straight, disturbed, STEPS * real_count), "null pointers change the run");
    free_rotor(&rotor);
    free(straight);
    free(disturbed);
}

static void in_model_exchange(void)
{
    size_t n = states.count;
    fmi2Boolean enter = fmi2False, terminate = fmi2False;
    struct rotor rotor = new_rotor(fmi2ModelExchange);
    initialize(&rotor);
    in_both_kinds(&rotor);
    REFUSED(&rotor, NewDiscreteStates, NULL);
    enter_continuous_time(&rotor);
    in_both_kinds(&rotor);
    REFUSED(&rotor, GetContinuousStates, NULL, n);
    REFUSED(&rotor, SetContinuousStates, NULL, n);
    REFUSED(&rotor, GetDerivatives, NULL, n);
    REFUSED(&rotor, GetNominalsOfContinuousStates, NULL, n);
    REFUSED(&rotor, CompletedIntegratorStep, fmi2True, NULL, &terminate);
    REFUSED(&rotor, CompletedIntegratorStep, fmi2True, &enter, NULL);
    size_t indicators = (size_t)number("fmiModelDescription.numberOfEventIndicators");
    if (indicators > 0) {
        REFUSED(&rotor, GetEventIndicators, NULL, indicators);
    }
    free_rotor(&rotor);
}

void nulls(void)
{
    without_an_instance();
    no_instance_made();
    in_co_simulation();
    if (has_model_exchange()) {
        in_model_exchange();
    }
}
