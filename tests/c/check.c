#include "check.h"

#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static int failed;
static long all;

bool check_that(bool holds, const char *file, int line, const char *format, ...)
{
    pthread_mutex_lock(&lock);
    all++;
    if (!holds) {
        va_list arguments;
        failed++;
        printf("%s:%d: ", file, line);
        va_start(arguments, format);
        vprintf(format, arguments);
        va_end(arguments);
        printf("\n");
        fflush(stdout);
    }
    pthread_mutex_unlock(&lock);
    return holds;
}

int failed_checks(void)
{
    return failed;
}

long all_checks(void)
{
    return all;
}

void *allocated(size_t count, size_t size)
{
    void *memory = calloc(count == 0 ? 1 : count, size);
    if (memory == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(2);
    }
    return memory;
}
