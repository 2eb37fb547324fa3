/* A linear model as an FMU for co-simulation and model exchange (FMI 2.0.4), in C99 and without libraries beyond C's
   own.

   matrices.h holds the numbers of the model, equations.h its motion. Nothing is global, and nothing is allocated but
   instances and saved states. */
#include "instance.h"

#include <stdlib.h>

#define JOINED(prefix, name) prefix##fmi2##name
#define NAMED(prefix, name) JOINED(prefix, name)
#define FMI2(name) NAMED(PREFIX, name)

#if defined _WIN32
#define EXPORTED __declspec(dllexport)
#elif defined __GNUC__
#define EXPORTED __attribute__((visibility("default")))
#else
#define EXPORTED
#endif

#define DECLARE(result, name, arguments) EXPORTED result FMI2(name) arguments;
FMI2_FUNCTIONS(DECLARE)
#undef DECLARE

/* How most functions begin: fmi2Error where the call is not legal or its arguments are not right. */
#define ENTER(legal, right) \
    struct instance *of = entered(component, legal, __func__); \
    if (of == NULL || !(right)) { \
        return fmi2Error; \
    }

const char *FMI2(GetTypesPlatform)(void)
{
    return "default";
}

const char *FMI2(GetVersion)(void)
{
    return "2.0";
}

fmi2Component FMI2(Instantiate)(fmi2String name, fmi2Type kind, fmi2String guid, fmi2String resources,
                                const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    size_t length = name == NULL ? 0 : strlen(name);
    struct instance *of = callbacks == NULL ? NULL : calloc(1, sizeof *of + length + 1);
    const char *wrong = NULL;
    (void)resources, (void)visible, (void)logging;
    if (of == NULL) {
        return NULL;
    }
    of->callbacks = *callbacks;
    of->call = __func__;
    memcpy(of->name, length > 0 ? name : "", length);
    if (length == 0) {
        wrong = "the instance has no name";
    } else if (guid == NULL || strcmp(guid, GUID) != 0) {
        wrong = "the GUID must be " GUID;
    } else if (kind != fmi2ModelExchange && kind != fmi2CoSimulation) {
        wrong = "the type must be fmi2ModelExchange or fmi2CoSimulation";
    }
    if (wrong != NULL) {
        tell(of, fmi2Error, "%s", wrong);
        free(of);
        return NULL;
    }
    begin(&of->now, (int32_t)kind);
    return of;
}

void FMI2(FreeInstance)(fmi2Component component)
{
    free(component);
}

/* All messages tell of errors, which are always told. */
fmi2Status FMI2(SetDebugLogging)(fmi2Component component, fmi2Boolean on, size_t n, const fmi2String categories[])
{
    ENTER(ANY, is_there(of, categories, n))
    (void)on;
    return fmi2OK;
}

fmi2Status FMI2(SetupExperiment)(fmi2Component component, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                                 fmi2Boolean has_stop, fmi2Real stop)
{
    ENTER(INSTANTIATED, 1)
    (void)has_tolerance, (void)tolerance;
    if (!isfinite(start) || (has_stop && !(stop >= start))) {
        return tell(of, fmi2Error, "from %g to %g s is no span of time", start, has_stop ? stop : HUGE_VAL);
    }
    of->now.time = start;
    of->now.stop = has_stop ? stop : HUGE_VAL;
    return fmi2OK;
}

/* From one state of the instance to another. */
#define GO(call, from, to) \
    fmi2Status FMI2(call)(fmi2Component component) \
    { \
        ENTER(from, 1) \
        of->now.phase = to; \
        return fmi2OK; \
    }
GO(EnterInitializationMode, INSTANTIATED, INITIALIZATION)
GO(ExitInitializationMode, INITIALIZATION, of->now.kind == fmi2ModelExchange ? EVENT : COMPLETE)
GO(EnterEventMode, CONTINUOUS, EVENT)
GO(EnterContinuousTimeMode, EVENT, CONTINUOUS)
GO(Terminate, RUNNING, TERMINATED)

fmi2Status FMI2(Reset)(fmi2Component component)
{
    ENTER(ANY, 1)
    begin(&of->now, of->now.kind);
    return fmi2OK;
}

fmi2Status FMI2(GetReal)(fmi2Component component, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    double deviation[COLUMNS];
    ENTER(ANY, are(of, vr, n, 0, COLUMNS + ROWS) && is_there(of, value, n))
    deviate(of->now.known, deviation);
    for (size_t i = 0; i < n; i++) {
        value[i] = vr[i] < COLUMNS ? of->now.known[vr[i]] : STEADY[vr[i]] + product(vr[i] - COLUMNS, deviation);
    }
    return are_finite(of, fmi2Discard, value, n) ? fmi2OK : fmi2Discard;
}

/* Inputs are set at any time, states before the start. */
fmi2Status FMI2(SetReal)(fmi2Component component, const fmi2ValueReference vr[], size_t n, const fmi2Real value[])
{
    ENTER(SETTABLE,
          are(of, vr, n, of->now.phase & RUNNING ? STATES : 0, COLUMNS) && are_finite(of, fmi2Error, value, n))
    for (size_t i = 0; i < n; i++) {
        set_now(&of->now, vr[i]);
        of->now.known[vr[i]] = value[i];
    }
    return fmi2OK;
}

#define NONE_OF_TYPE(call, type) \
    fmi2Status FMI2(call)(fmi2Component component, const fmi2ValueReference vr[], size_t n, type value[]) \
    { \
        ENTER(ANY, are(of, vr, n, 0, 0)) \
        (void)value; \
        return fmi2OK; \
    }
NONE_OF_TYPE(GetInteger, fmi2Integer)
NONE_OF_TYPE(GetBoolean, fmi2Boolean)
NONE_OF_TYPE(GetString, fmi2String)
NONE_OF_TYPE(SetInteger, const fmi2Integer)
NONE_OF_TYPE(SetBoolean, const fmi2Boolean)
NONE_OF_TYPE(SetString, const fmi2String)

fmi2Status FMI2(GetDirectionalDerivative)(fmi2Component component, const fmi2ValueReference unknown[], size_t unknowns,
                                          const fmi2ValueReference known[], size_t knowns, const fmi2Real along[],
                                          fmi2Real change[])
{
    ENTER(READABLE, are(of, unknown, unknowns, COLUMNS, COLUMNS + ROWS) && are(of, known, knowns, 0, COLUMNS) &&
                        are_finite(of, fmi2Error, along, knowns) && is_there(of, change, unknowns))
    for (size_t i = 0; i < unknowns; i++) {
        change[i] = 0.0;
        for (size_t j = 0; j < knowns; j++) {
            change[i] += MATRIX[unknown[i] - COLUMNS][known[j]] * along[j];
        }
    }
    return are_finite(of, fmi2Discard, change, unknowns) ? fmi2OK : fmi2Discard;
}

/* Keeps a memory behind a pointer of the host's, which is NULL or holds an earlier one. */
static fmi2Status keep(const struct instance *of, const struct memory *memory, fmi2FMUstate *state)
{
    if (*state == NULL && (*state = malloc(sizeof *memory)) == NULL) {
        return tell(of, fmi2Error, "there is no memory left");
    }
    memcpy(*state, memory, sizeof *memory);
    return fmi2OK;
}

fmi2Status FMI2(GetFMUstate)(fmi2Component component, fmi2FMUstate *state)
{
    ENTER(ANY, is_there(of, state, 1))
    return keep(of, &of->now, state);
}

fmi2Status FMI2(SetFMUstate)(fmi2Component component, fmi2FMUstate state)
{
    ENTER(ANY, is_there(of, state, 1))
    const struct memory *saved = state;
    if (saved->kind != of->now.kind) {
        return tell(of, fmi2Error, "the state is that of an instance of the other type");
    }
    of->now = *saved;
    return fmi2OK;
}

fmi2Status FMI2(FreeFMUstate)(fmi2Component component, fmi2FMUstate *state)
{
    ENTER(ANY, 1)
    if (state != NULL) {
        free(*state);
        *state = NULL;
    }
    return fmi2OK;
}

/* A state as bytes, those of this kind of machine: the GUID, the memory, and a sum that sees each byte that was
 * changed. */
enum { SUMMED = sizeof GUID + sizeof(struct memory), SERIALIZED = SUMMED + sizeof(uint32_t) };

/* The hash FNV-1a. */
static uint32_t sum_of(const fmi2Byte bytes[SUMMED])
{
    uint32_t sum = 2166136261u;
    for (size_t i = 0; i < SUMMED; i++) {
        sum = (sum ^ (unsigned char)bytes[i]) * 16777619u;
    }
    return sum;
}

fmi2Status FMI2(SerializedFMUstateSize)(fmi2Component component, fmi2FMUstate state, size_t *size)
{
    ENTER(ANY, is_there(of, state, 1) && is_there(of, size, 1))
    *size = SERIALIZED;
    return fmi2OK;
}

fmi2Status FMI2(SerializeFMUstate)(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    uint32_t sum;
    ENTER(ANY, is_there(of, state, 1) && is_there(of, bytes, 1))
    if (size != SERIALIZED) {
        return tell(of, fmi2Error, "a state takes %d bytes", (int)SERIALIZED);
    }
    memcpy(bytes, GUID, sizeof GUID);
    memcpy(bytes + sizeof GUID, state, sizeof(struct memory));
    sum = sum_of(bytes);
    memcpy(bytes + SUMMED, &sum, sizeof sum);
    return fmi2OK;
}

fmi2Status FMI2(DeSerializeFMUstate)(fmi2Component component, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    struct memory read;
    uint32_t sum = 0;
    ENTER(ANY, is_there(of, bytes, 1) && is_there(of, state, 1))
    if (size == SERIALIZED) {
        memcpy(&sum, bytes + SUMMED, sizeof sum);
    }
    if (size != SERIALIZED || memcmp(bytes, GUID, sizeof GUID) != 0 || sum != sum_of(bytes)) {
        return tell(of, fmi2Error, "the bytes are damaged, or the state of another model");
    }
    memcpy(&read, bytes + sizeof GUID, sizeof read);
    *state = NULL; /* What the pointer was is not looked at. */
    return keep(of, &read, state);
}

/* There are no events of its own. */
fmi2Status FMI2(NewDiscreteStates)(fmi2Component component, fmi2EventInfo *info)
{
    ENTER(EVENT, is_there(of, info, 1))
    memset(info, 0, sizeof *info);
    return fmi2OK;
}

fmi2Status FMI2(CompletedIntegratorStep)(fmi2Component component, fmi2Boolean no_return, fmi2Boolean *event,
                                         fmi2Boolean *end)
{
    ENTER(CONTINUOUS, is_there(of, event, 1) && is_there(of, end, 1))
    (void)no_return;
    *event = *end = fmi2False;
    return fmi2OK;
}

fmi2Status FMI2(SetTime)(fmi2Component component, fmi2Real time)
{
    ENTER(EXCHANGING, are_finite(of, fmi2Error, &time, 1))
    of->now.time = time;
    return fmi2OK;
}

fmi2Status FMI2(SetContinuousStates)(fmi2Component component, const fmi2Real x[], size_t n)
{
    ENTER(CONTINUOUS, is_whole(of, x, n) && are_finite(of, fmi2Error, x, n))
    memcpy(of->now.known, x, n * sizeof *x);
    return fmi2OK;
}

fmi2Status FMI2(GetContinuousStates)(fmi2Component component, fmi2Real x[], size_t n)
{
    ENTER(READABLE, is_whole(of, x, n))
    memcpy(x, of->now.known, n * sizeof *x);
    return fmi2OK;
}

fmi2Status FMI2(GetNominalsOfContinuousStates)(fmi2Component component, fmi2Real nominals[], size_t n)
{
    ENTER(ANY, is_whole(of, nominals, n))
    memcpy(nominals, NOMINAL, sizeof NOMINAL);
    return fmi2OK;
}

fmi2Status FMI2(GetDerivatives)(fmi2Component component, fmi2Real rates[], size_t n)
{
    double deviation[COLUMNS];
    ENTER(READABLE, is_whole(of, rates, n))
    deviate(of->now.known, deviation);
    for (size_t i = 0; i < n; i++) {
        rates[i] = product(i, deviation);
    }
    return are_finite(of, fmi2Discard, rates, n) ? fmi2OK : fmi2Discard;
}

fmi2Status FMI2(GetEventIndicators)(fmi2Component component, fmi2Real indicators[], size_t n)
{
    ENTER(READABLE, 1)
    (void)indicators;
    return n == 0 ? fmi2OK : tell(of, fmi2Error, "there are no event indicators");
}

/* Whether each derivative that is asked for or sent has order 1. */
static int are_rates(const struct instance *of, const fmi2Integer order[], size_t n)
{
    if (!is_there(of, order, n)) {
        return 0;
    }
    for (size_t i = 0; i < n; i++) {
        if (order[i] != 1) {
            tell(of, fmi2Error, "order %d must be 1", order[i]);
            return 0;
        }
    }
    return 1;
}

fmi2Status FMI2(SetRealInputDerivatives)(fmi2Component component, const fmi2ValueReference vr[], size_t n,
                                         const fmi2Integer order[], const fmi2Real value[])
{
    ENTER(INSTANTIATED | INITIALIZATION | STEPPING,
          are(of, vr, n, STATES, COLUMNS) && are_rates(of, order, n) && are_finite(of, fmi2Error, value, n))
    for (size_t i = 0; i < n; i++) {
        set_now(&of->now, vr[i]);
        of->now.rates[vr[i]] = value[i];
    }
    return fmi2OK;
}

fmi2Status FMI2(GetRealOutputDerivatives)(fmi2Component component, const fmi2ValueReference vr[], size_t n,
                                          const fmi2Integer order[], fmi2Real value[])
{
    double deviation[COLUMNS], rates[COLUMNS];
    ENTER(READABLE,
          are(of, vr, n, COLUMNS + STATES, COLUMNS + ROWS) && are_rates(of, order, n) && is_there(of, value, n))
    /* dy/dt = C dx/dt + D du/dt */
    deviate(of->now.known, deviation);
    memcpy(rates, of->now.rates, sizeof rates);
    for (size_t i = 0; i < STATES; i++) {
        rates[i] = product(i, deviation);
    }
    for (size_t i = 0; i < n; i++) {
        value[i] = product(vr[i] - COLUMNS, rates);
    }
    return are_finite(of, fmi2Discard, value, n) ? fmi2OK : fmi2Discard;
}

fmi2Status FMI2(DoStep)(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_set_state)
{
    ENTER(STEPPING, 1)
    struct memory next = of->now;
    /* Times are equal within a part of the step and some units in the last place. */
    double near = 1e-9 * step + 4.0 * DBL_EPSILON * fabs(next.time);
    (void)no_set_state;
    if (!(step > 0.0) || !isfinite(step)) {
        return tell(of, fmi2Error, "the step %g s must be a finite number > 0", step);
    }
    if (!(fabs(time - next.time) <= near)) {
        return tell(of, fmi2Error, "the step begins at %.17g s, where the last one ended, not at %.17g s", next.time,
                    time);
    }
    next.time = time + step;
    if (!(next.time > of->now.time)) {
        return tell(of, fmi2Error, "the step %g s is too small to advance the time %.17g s", step, time);
    }
    if (next.time > next.stop + near) {
        return tell(of, fmi2Error, "the step to %.17g s goes past the stop time %.17g s", next.time, next.stop);
    }
    if (step != of->flow.step) {
        of->flow = flow_over(step);
    }
    advance(&of->flow, next.known, next.rates);
    if (!are_finite(of, fmi2Discard, next.known, COLUMNS)) {
        of->now.phase = FAILED;
        return fmi2Discard;
    }
    next.phase = COMPLETE;
    of->now = next;
    return fmi2OK;
}

fmi2Status FMI2(CancelStep)(fmi2Component component)
{
    ENTER(ANY, 1)
    return tell(of, fmi2Error, "no step is asynchronous");
}

#define STATUS(call, type, right, answer) \
    fmi2Status FMI2(call)(fmi2Component component, fmi2StatusKind kind, type * value) \
    { \
        ENTER(STEPPING | TERMINATED, is_there(of, value, 1)) \
        if (kind != right) { \
            return tell(of, fmi2Error, "this status has no answer of this type"); \
        } \
        *value = answer; \
        return fmi2OK; \
    }
STATUS(GetStatus, fmi2Status, fmi2DoStepStatus, of->now.phase == FAILED ? fmi2Discard : fmi2OK)
STATUS(GetRealStatus, fmi2Real, fmi2LastSuccessfulTime, of->now.time)
STATUS(GetBooleanStatus, fmi2Boolean, fmi2Terminated, of->now.phase == FAILED)

fmi2Status FMI2(GetIntegerStatus)(fmi2Component component, fmi2StatusKind kind, fmi2Integer *value)
{
    ENTER(ANY, 1)
    (void)kind, (void)value;
    return tell(of, fmi2Error, "no status is an integer");
}

fmi2Status FMI2(GetStringStatus)(fmi2Component component, fmi2StatusKind kind, fmi2String *value)
{
    ENTER(ANY, 1)
    (void)kind, (void)value;
    return tell(of, fmi2Error, "no step is pending");
}
