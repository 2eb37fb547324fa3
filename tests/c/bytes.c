/* FMU states as bytes: brought back in the same instance, in a new one and in another process, what follows has the
   same bits. */
#include "parts.h"
#include "rotor.h"
#include "saved.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { BEFORE = 7, AFTER = 12 };

static void same_process(struct rotor *rotor, struct saved saved, const fmi2Real *straight)
{
    fmi2Real *again = new_trace(AFTER);
    restore(rotor, saved);
    struct saved twice = save(rotor);
    CHECK(twice.size == saved.size && memcmp(twice.bytes, saved.bytes, saved.size) == 0,
          "a state that was bytes has other bytes");
    free(twice.bytes);
    run(rotor, BEFORE, AFTER, again);
    CHECK(same_bits(straight, again, AFTER * real_count), "what follows the bytes has other bits");
    struct rotor other = new_rotor(fmi2CoSimulation);
    restore(&other, saved);
    memset(again, 0, AFTER * real_count * sizeof *again);
    run(&other, BEFORE, AFTER, again);
    CHECK(same_bits(straight, again, AFTER * real_count), "what follows the bytes in a new instance has other bits");
    free_rotor(&other);
    free(again);
}

static void write_all(FILE *stream, const void *data, size_t size)
{
    CHECK(fwrite(data, 1, size, stream) == size, "a file cannot be written");
}

static void read_all(FILE *stream, void *data, size_t size)
{
    CHECK(fread(data, 1, size, stream) == size, "a file is too short");
}

/* The file: size of the state, the state, what follows it. */
static void other_process(struct saved saved, const fmi2Real *straight)
{
    char file[1024];
    snprintf(file, sizeof file, "%s/state-%ld.bin", options.folder, (long)getpid());
    FILE *stream = fopen(file, "wb");
    if (!CHECK(stream != NULL, "%s cannot be written", file)) {
        return;
    }
    write_all(stream, &saved.size, sizeof saved.size);
    write_all(stream, saved.bytes, saved.size);
    write_all(stream, straight, AFTER * real_count * sizeof *straight);
    fclose(stream);
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        execl(options.program, options.program, options.sheet, options.library, options.folder, "--resume", file,
              (char *)NULL);
        _exit(127);
    }
    int status = -1;
    CHECK(child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0,
          "the other process ended with %d", status);
    remove(file);
}

void resume(const char *file)
{
    struct saved saved = {NULL, 0};
    fmi2Real *straight = new_trace(AFTER), *again = new_trace(AFTER);
    FILE *stream = fopen(file, "rb");
    if (!CHECK(stream != NULL, "%s cannot be read", file)) {
        return;
    }
    read_all(stream, &saved.size, sizeof saved.size);
    saved.bytes = allocated(saved.size, 1);
    read_all(stream, saved.bytes, saved.size);
    read_all(stream, straight, AFTER * real_count * sizeof *straight);
    fclose(stream);
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    restore(&rotor, saved);
    run(&rotor, BEFORE, AFTER, again);
    CHECK(same_bits(straight, again, AFTER * real_count), "in another process the run has other bits");
    free_rotor(&rotor);
    free(saved.bytes);
    free(straight);
    free(again);
}

void bytes(void)
{
    if (!claims("CoSimulation.canSerializeFMUstate")) {
        return;
    }
    fmi2Real *straight = new_trace(AFTER);
    struct rotor rotor = started_rotor();
    run(&rotor, 0, BEFORE, NULL);
    struct saved saved = save(&rotor);
    run(&rotor, BEFORE, AFTER, straight);
    same_process(&rotor, saved, straight);
    other_process(saved, straight);
    free_rotor(&rotor);
    free(saved.bytes);
    free(straight);
}
