/* What is logged: by category, to the right environment, printable by a logger that formats (the journal's does). */
#include "parts.h"
#include "rotor.h"

#include <stdlib.h>
#include <string.h>

static void percent_signs(void)
{
    const fmi2String names[] = {"100%", "%s%n%d", "50 %% off"};
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        REFUSED(&rotor, SetDebugLogging, fmi2True, 1, &names[i]);
        /* Formatted, the name stands there as it was given: each doubled sign comes out as one. */
        CHECK(strstr(rotor.journal->message, names[i]) != NULL, "%s is not in: %s", names[i], rotor.journal->message);
        CHECK(strcmp(rotor.journal->instance, "rotor") == 0, "the instance is called %s", rotor.journal->instance);
    }
    free_rotor(&rotor);
}

/* How many lines a short life writes. */
static int lines(struct rotor *rotor)
{
    int before = rotor->journal->count = 0;
    fmi.SetupExperiment(rotor->component, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    fmi.EnterInitializationMode(rotor->component);
    fmi.ExitInitializationMode(rotor->component);
    fmi.DoStep(rotor->component, 0.0, 0.01, fmi2True);
    fmi.Terminate(rotor->component);
    fmi.Terminate(rotor->component);
    fmi.Reset(rotor->component);
    return rotor->journal->count - before;
}

static void categories(void)
{
    const fmi2String all = "logAll", errors = "logStatusError";
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    int unasked = lines(&rotor);
    /* An unstable rotor is warned of besides. */
    CHECK(unasked == 1 || unasked == 2, "unasked, one error makes %d lines", unasked);
    DONE(&rotor, SetDebugLogging, fmi2True, 1, &all);
    CHECK(lines(&rotor) > unasked, "all categories say no more than an error");
    DONE(&rotor, SetDebugLogging, fmi2False, 0, NULL);
    CHECK(lines(&rotor) == 0, "switched off, it says something");
    DONE(&rotor, SetDebugLogging, fmi2True, 1, &errors);
    CHECK(lines(&rotor) == 1, "errors alone are one line");
    free_rotor(&rotor);
}

/* Two instances, two environments. */
static void environments(void)
{
    struct rotor one = new_rotor(fmi2CoSimulation), other = new_rotor(fmi2CoSimulation);
    other.journal->count = 0;
    REFUSED_PLAIN(&one, Terminate);
    CHECK(other.journal->count == 0, "one instance writes into the journal of another");
    free_rotor(&one);
    REFUSED_PLAIN(&other, Terminate);
    free_rotor(&other);
}

/* A host without a logger, and one that is loud from the start. */
static void other_callbacks(void)
{
    struct journal journal;
    fmi2CallbackFunctions callbacks = {NULL, NULL, NULL, NULL, NULL};
    const char *guid = attribute("fmiModelDescription.guid");
    fmi2Component silent = fmi.Instantiate("silent", fmi2CoSimulation, guid, NULL, &callbacks, fmi2False, fmi2True);
    if (CHECK(silent != NULL, "a logger is not needed")) {
        CHECK(fmi.Terminate(silent) == fmi2Error, "an error is one without a logger too");
        fmi.FreeInstance(silent);
    }
    memset(&journal, 0, sizeof journal);
    callbacks.logger = write_journal;
    callbacks.componentEnvironment = &journal;
    fmi2Component loud = fmi.Instantiate("100% loud", fmi2CoSimulation, guid, NULL, &callbacks, fmi2True, fmi2True);
    CHECK(loud != NULL && journal.count == 1 && strcmp(journal.instance, "100% loud") == 0,
          "with loggingOn fmi2Instantiate writes %d lines for %s", journal.count, journal.instance);
    fmi.FreeInstance(loud);
}

void logs(void)
{
    percent_signs();
    categories();
    environments();
    other_callbacks();
}
