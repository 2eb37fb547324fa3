/* A run of an FMU, for a tool that counts instructions within fmi2DoStep:

       spend SHEET LIBRARY STEPS STEP [NAME=VALUE ...]

   sets what is named, takes so many communication steps of STEP seconds, and tells what the solver evaluated. */
#include "library.h"
#include "sheet.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static fmi2Component rotor;

static void must(fmi2Status status, const char *what)
{
    if (status != fmi2OK) {
        fprintf(stderr, "spend: %s\n", what);
        exit(2);
    }
}

static void quiet(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                  fmi2String message, ...)
{
    (void)environment;
    (void)instance;
    (void)category;
    fprintf(stderr, "%d %s\n", status, message);
}

/* NAME=VALUE, whatever its type. */
static void set(char *given)
{
    char *value = strchr(given, '=');
    if (value == NULL) {
        must(fmi2Error, "NAME=VALUE is needed");
    }
    *value++ = '\0';
    const struct variable *it = variable(given);
    if (it == NULL) {
        must(fmi2Error, given);
    }
    fmi2Real real = strtod(value, NULL);
    fmi2Integer integer = (fmi2Integer)real;
    if (it->type == 'R') {
        must(fmi.SetReal(rotor, &it->reference, 1, &real), given);
    } else if (it->type == 'B') {
        must(fmi.SetBoolean(rotor, &it->reference, 1, &integer), given);
    } else {
        must(fmi.SetInteger(rotor, &it->reference, 1, &integer), given);
    }
}

int main(int count, char **arguments)
{
    static const fmi2CallbackFunctions callbacks = {quiet, NULL, NULL, NULL, NULL};
    if (count < 5) {
        must(fmi2Error, "usage: spend SHEET LIBRARY STEPS STEP [NAME=VALUE ...]");
    }
    read_sheet(arguments[1]);
    load_library(arguments[2]);
    int steps = atoi(arguments[3]);
    double step = strtod(arguments[4], NULL);
    rotor = fmi.Instantiate("rotor", fmi2CoSimulation, attribute("fmiModelDescription.guid"), NULL, &callbacks,
                            fmi2False, fmi2False);
    must(rotor == NULL ? fmi2Error : fmi2OK, "fmi2Instantiate");
    for (int i = 5; i < count; i++) {
        set(arguments[i]);
    }
    must(fmi.SetupExperiment(rotor, fmi2False, 0.0, 0.0, fmi2False, 0.0), "fmi2SetupExperiment");
    must(fmi.EnterInitializationMode(rotor), "fmi2EnterInitializationMode");
    must(fmi.ExitInitializationMode(rotor), "fmi2ExitInitializationMode");
    for (int i = 0; i < steps; i++) {
        must(fmi.DoStep(rotor, i * step, step, fmi2True), "fmi2DoStep");
    }
    fmi2Real evaluations;
    must(fmi.GetReal(rotor, &variable("solver.evaluations")->reference, 1, &evaluations), "fmi2GetReal");
    printf("%.0f\n", evaluations);
    fmi.FreeInstance(rotor);
    return 0;
}
