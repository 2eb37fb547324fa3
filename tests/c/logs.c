/* What is logged can be printed by a logger that formats it, as the journal's does: a % in a message is doubled. */
#include "parts.h"
#include "rotor.h"

#include <string.h>

void logs(void)
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

    /* Loud from the start, by a host that gives neither memory functions nor the place of the resources. */
    struct journal journal = {0};
    const fmi2CallbackFunctions callbacks = {write_journal, NULL, NULL, NULL, &journal};
    const char *guid = attribute("fmiModelDescription.guid");
    fmi2Component loud = fmi.Instantiate("100% loud", fmi2CoSimulation, guid, NULL, &callbacks, fmi2True, fmi2True);
    CHECK(loud != NULL && journal.count == 1 && strcmp(journal.instance, "100% loud") == 0,
          "with loggingOn fmi2Instantiate writes %d lines for %s", journal.count, journal.instance);
    fmi.FreeInstance(loud);
}
