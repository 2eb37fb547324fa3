// Stands in an FMU where its library was, forwards every call of FMI 2.0 to that library, now its neighbour
// <name>.real.so, and appends the call to the text file that the environment variable SPLIT_ROTOR_RECORD names.
//
// A line is the call itself: the function, its arguments in C's order, "->", what it returned, with one space between.
//
//     fmi2GetReal #1 [768,769] 2 =[0x1.8p-1,-0x1p-4] -> 0
//
//     0x1.8p-1, 17      a floating-point number as "%a" has it, a whole number
//     "a%20name"        text, escaped as in an address; bytes stand between '' instead
//     #1                an instance or a saved state, numbered from 1 in the order of appearance
//     [...] {...}       an array, a struct
//     =after            what the callee wrote where a pointer leads; before=after where it reads it too
//     callbacks         the struct of callbacks
//     null, void        any null pointer; returned by what returns nothing
//
// Calls run side by side as the host makes them; lines are written one at a time.

#define _GNU_SOURCE // dladdr
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef const char *text;
typedef unsigned reference;
typedef struct {
    int new_discrete_states_needed, terminate_simulation, nominals_changed, values_changed, next_event_time_defined;
    double next_event_time;
} event_info;

// The file. Its own lock, flockfile, guards the table of objects too.
static FILE *record;
static void *library;

static void need(const void *thing, text what)
{
    if (!thing) {
        fprintf(stderr, "recorder: cannot do without %s\n", what);
        abort();
    }
}

__attribute__((constructor)) static void start(void)
{
    Dl_info self = {0};
    dladdr(&record, &self);
    text suffix = self.dli_fname ? strrchr(self.dli_fname, '.') : NULL;
    need(suffix, "its own name, which ends with .so");
    char neighbour[4096];
    snprintf(neighbour, sizeof neighbour, "%.*s.real%s", (int)(suffix - self.dli_fname), self.dli_fname, suffix);
    library = dlopen(neighbour, RTLD_NOW | RTLD_LOCAL);
    need(library, neighbour);
    text file = getenv("SPLIT_ROTOR_RECORD");
    need(file, "the name of a file in SPLIT_ROTOR_RECORD");
    record = fopen(file, "a");
    need(record, file);
    // Each line is handed over as it ends: a host that crashes takes none along.
    setvbuf(record, NULL, _IOLBF, 1 << 16);
}

static void *symbol(text name)
{
    void *function = dlsym(library, name);
    need(function, name);
    return function;
}

// The function of this name in the FMU's own library.
#define REAL(name) ((__typeof__(&name))symbol(#name))

// ---- objects ----

static void **objects;
static size_t known;

static size_t number(void *object)
{
    for (size_t i = 0; i < known; i++) {
        if (objects[i] == object)
            return i + 1;
    }
    objects = realloc(objects, (known + 1) * sizeof *objects);
    need(objects, "memory");
    objects[known] = object;
    return ++known;
}

// The object was freed: what the same address holds later is another one.
static void forget(void *object)
{
    if (object)
        objects[number(object) - 1] = NULL;
}

// ---- values ----

static void put_real(double value) { fprintf(record, "%a", value); }
static void put_integer(int value) { fprintf(record, "%d", value); }
static void put_reference(reference value) { fprintf(record, "%u", value); }
static void put_size(size_t value) { fprintf(record, "%zu", value); }
static void put_null(void) { fputs("null", record); }

static void put_quoted(char quote, text first, size_t n)
{
    text plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._:/{}";
    putc(quote, record);
    for (size_t i = 0; i < n; i++) {
        if (first[i] && strchr(plain, first[i]))
            putc(first[i], record);
        else
            fprintf(record, "%%%02X", (unsigned char)first[i]);
    }
    putc(quote, record);
}

static void put_text(text value)
{
    if (value)
        put_quoted('"', value, strlen(value));
    else
        put_null();
}

static void put_object(void *object)
{
    if (object)
        fprintf(record, "#%zu", number(object));
    else
        put_null();
}

static void put_event_info(event_info it)
{
    fprintf(record, "{%d,%d,%d,%d,%d,%a}", it.new_discrete_states_needed, it.terminate_simulation, it.nominals_changed,
            it.values_changed, it.next_event_time_defined, it.next_event_time);
}

#define put(value)                \
    _Generic((value),             \
        double: put_real,         \
        int: put_integer,         \
        reference: put_reference, \
        size_t: put_size,         \
        text: put_text,           \
        void *: put_object,       \
        event_info: put_event_info)(value)

// ---- arguments ----

// Writes ` <before>` and `what`, or ` null` where the pointer is.
#define argument(pointer, before, what)      \
    do {                                     \
        putc(' ', record);                   \
        if (pointer) {                       \
            fputs(before, record);           \
            what;                            \
        } else                               \
            put_null();                      \
    } while (0)

#define elements(first, n)                   \
    putc('[', record);                       \
    for (size_t i = 0; i < (n); i++) {       \
        if (i)                               \
            putc(',', record);               \
        put((first)[i]);                     \
    }                                        \
    putc(']', record)

#define in(value) (putc(' ', record), put(value))
#define ins(first, n) argument(first, "", elements(first, n))
#define in_bytes(first, n) argument(first, "", put_quoted('\'', first, n))
#define out(place) argument(place, "=", put(*(place)))
#define outs(first, n) argument(first, "=", elements(first, n))
#define out_bytes(first, n) argument(first, "=", put_quoted('\'', first, n))
#define in_out(before, place) argument(place, "", put(before); putc('=', record); put(*(place)))

static void begin(text function)
{
    flockfile(record);
    fputs(function, record);
}

static void end(void)
{
    putc('\n', record);
    funlockfile(record);
}

#define returned(value) (fputs(" -> ", record), put(value), end())

// A function that returns a status; last come its arguments as they are written.
#define STATUS(name, parameters, arguments, ...) \
    int name parameters                          \
    {                                            \
        int status = REAL(name) arguments;       \
        begin(#name);                            \
        __VA_ARGS__;                             \
        returned(status);                        \
        return status;                           \
    }

// ---- the 44 functions: families first ----

#define PLAIN(name) STATUS(name, (void *c), (c), in(c))

PLAIN(fmi2EnterInitializationMode)
PLAIN(fmi2ExitInitializationMode)
PLAIN(fmi2Terminate)
PLAIN(fmi2Reset)
PLAIN(fmi2EnterEventMode)
PLAIN(fmi2EnterContinuousTimeMode)
PLAIN(fmi2CancelStep)

#define VARIABLES(type, c_type)                                                                                      \
    STATUS(fmi2Get##type, (void *c, const reference *vr, size_t n, c_type *value), (c, vr, n, value), in(c);         \
           ins(vr, n); in(n); outs(value, n))                                                                        \
    STATUS(fmi2Set##type, (void *c, const reference *vr, size_t n, const c_type *value), (c, vr, n, value), in(c);   \
           ins(vr, n); in(n); ins(value, n))                                                                         \
    STATUS(fmi2Get##type##Status, (void *c, int kind, c_type *value), (c, kind, value), in(c); in(kind); out(value))

VARIABLES(Real, double)
VARIABLES(Integer, int)
VARIABLES(Boolean, int)
VARIABLES(String, text)
STATUS(fmi2GetStatus, (void *c, int kind, int *value), (c, kind, value), in(c); in(kind); out(value))

#define GET_VECTOR(name) STATUS(name, (void *c, double *x, size_t n), (c, x, n), in(c); outs(x, n); in(n))

GET_VECTOR(fmi2GetDerivatives)
GET_VECTOR(fmi2GetEventIndicators)
GET_VECTOR(fmi2GetContinuousStates)
GET_VECTOR(fmi2GetNominalsOfContinuousStates)
STATUS(fmi2SetContinuousStates, (void *c, const double *x, size_t n), (c, x, n), in(c); ins(x, n); in(n))

STATUS(fmi2SetRealInputDerivatives, (void *c, const reference *vr, size_t n, const int *order, const double *value),
       (c, vr, n, order, value), in(c); ins(vr, n); in(n); ins(order, n); ins(value, n))
STATUS(fmi2GetRealOutputDerivatives, (void *c, const reference *vr, size_t n, const int *order, double *value),
       (c, vr, n, order, value), in(c); ins(vr, n); in(n); ins(order, n); outs(value, n))
STATUS(fmi2GetDirectionalDerivative,
       (void *c, const reference *z, size_t m, const reference *v, size_t n, const double *dv, double *dz),
       (c, z, m, v, n, dv, dz), in(c); ins(z, m); in(m); ins(v, n); in(n); ins(dv, n); outs(dz, m))

STATUS(fmi2SetDebugLogging, (void *c, int on, size_t n, const text *categories), (c, on, n, categories), in(c); in(on);
       in(n); ins(categories, n))
STATUS(fmi2SetupExperiment,
       (void *c, int tolerance_defined, double tolerance, double start, int stop_defined, double stop),
       (c, tolerance_defined, tolerance, start, stop_defined, stop), in(c); in(tolerance_defined); in(tolerance);
       in(start); in(stop_defined); in(stop))
STATUS(fmi2DoStep, (void *c, double from, double step, int no_set_state_before), (c, from, step, no_set_state_before),
       in(c); in(from); in(step); in(no_set_state_before))
STATUS(fmi2SetTime, (void *c, double time), (c, time), in(c); in(time))
STATUS(fmi2NewDiscreteStates, (void *c, event_info *info), (c, info), in(c); out(info))
STATUS(fmi2CompletedIntegratorStep, (void *c, int no_set_state_before, int *enter_event_mode, int *terminate),
       (c, no_set_state_before, enter_event_mode, terminate), in(c); in(no_set_state_before); out(enter_event_mode);
       out(terminate))

STATUS(fmi2SetFMUstate, (void *c, void *state), (c, state), in(c); in(state))
STATUS(fmi2SerializedFMUstateSize, (void *c, void *state, size_t *size), (c, state, size), in(c); in(state); out(size))
STATUS(fmi2SerializeFMUstate, (void *c, void *state, char *bytes, size_t n), (c, state, bytes, n), in(c); in(state);
       out_bytes(bytes, n); in(n))

// ---- those that make and free objects ----

text fmi2GetTypesPlatform(void)
{
    text platform = REAL(fmi2GetTypesPlatform)();
    begin("fmi2GetTypesPlatform");
    returned(platform);
    return platform;
}

text fmi2GetVersion(void)
{
    text version = REAL(fmi2GetVersion)();
    begin("fmi2GetVersion");
    returned(version);
    return version;
}

void *fmi2Instantiate(text name, int type, text guid, text location, const void *callbacks, int visible, int logging)
{
    void *c = REAL(fmi2Instantiate)(name, type, guid, location, callbacks, visible, logging);
    begin("fmi2Instantiate");
    in(name);
    in(type);
    in(guid);
    in(location);
    argument(callbacks, "callbacks", );
    in(visible);
    in(logging);
    returned(c);
    return c;
}

// The lock is held while an object is freed: until it is forgotten, nobody is given one at the same address.
void fmi2FreeInstance(void *c)
{
    begin("fmi2FreeInstance");
    in(c);
    REAL(fmi2FreeInstance)(c);
    forget(c);
    fputs(" -> void", record);
    end();
}

int fmi2FreeFMUstate(void *c, void **state)
{
    begin("fmi2FreeFMUstate");
    in(c);
    void *before = state ? *state : NULL;
    int status = REAL(fmi2FreeFMUstate)(c, state);
    in_out(before, state);
    if (state && !*state)
        forget(before);
    returned(status);
    return status;
}

int fmi2GetFMUstate(void *c, void **state)
{
    void *before = state ? *state : NULL;
    int status = REAL(fmi2GetFMUstate)(c, state);
    begin("fmi2GetFMUstate");
    in(c);
    in_out(before, state);
    returned(status);
    return status;
}

int fmi2DeSerializeFMUstate(void *c, text bytes, size_t n, void **state)
{
    void *before = state ? *state : NULL;
    int status = REAL(fmi2DeSerializeFMUstate)(c, bytes, n, state);
    begin("fmi2DeSerializeFMUstate");
    in(c);
    in_bytes(bytes, n);
    in(n);
    in_out(before, state);
    returned(status);
    return status;
}
