#include "instance.h"

#include "sheet.h"

#include <stdio.h>
#include <stdlib.h>

void must(fmi2Status status, const char *what)
{
    if (status != fmi2OK) {
        fprintf(stderr, "%s\n", what);
        exit(2);
    }
}

static void print_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                          fmi2String category, fmi2String message, ...)
{
    (void)environment;
    (void)instance;
    (void)category;
    fprintf(stderr, "%d %s\n", status, message);
}

fmi2Component instantiate(fmi2Type type)
{
    static const fmi2CallbackFunctions callbacks = {print_message, NULL, NULL, NULL, NULL};
    fmi2Component made =
        fmi.Instantiate("rotor", type, attribute("fmiModelDescription.guid"), NULL, &callbacks, fmi2False, fmi2False);
    must(made == NULL ? fmi2Error : fmi2OK, "fmi2Instantiate");
    return made;
}

void initialize(fmi2Component component)
{
    MUST(SetupExperiment, component, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    MUST(EnterInitializationMode, component);
    MUST(ExitInitializationMode, component);
}
