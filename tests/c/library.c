#include "library.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>

enum { RTLD_NOW, RTLD_LOCAL = 0 };

static void *dlopen(const char *file, int mode)
{
    (void)mode;
    return LoadLibraryA(file);
}

static void *dlsym(void *library, const char *name)
{
    void *function;
    FARPROC found = GetProcAddress(library, name);
    memcpy(&function, &found, sizeof function);
    return function;
}

static const char *dlerror(void)
{
    static char message[64];
    snprintf(message, sizeof message, "the library cannot be loaded: error %lu", GetLastError());
    return message;
}
#else
#include <dlfcn.h>
#endif

struct fmi2 fmi;

static void *library;

/* Writes to `function`, because C has no cast from a data pointer to a function pointer. */
static void look_up(const char *name, void **function)
{
    *function = dlsym(library, name);
    if (*function == NULL) {
        fprintf(stderr, "the library has no %s\n", name);
        exit(2);
    }
}

void load_library(const char *file)
{
    /* It is never closed: leak checkers could no longer name the functions of a library that is gone. */
    library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
        fprintf(stderr, "%s\n", dlerror());
        exit(2);
    }
#define LOOK_UP(result, name, arguments) look_up("fmi2" #name, (void **)&fmi.name);
    FMI2_FUNCTIONS(LOOK_UP)
#undef LOOK_UP
}
