/* Runs an FMU 3.0 outside Python: harness LIBRARY TOKEN STEP STEPS INSTANCES TORQUE VARIABLES
 *
 * Every instance has its own constant torque at the input, variable 1. Prints the shortest time of a step, µs;
 * whether instances in threads give what they give one after the other, bit by bit; and the libraries that the
 * process has loaded.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST = 64, REPEATS = 5 };

static void *(*instantiate)(
    const char *, const char *, const char *, bool, bool, bool, bool, const uint32_t *, size_t, void *,
    void (*)(void *, int, const char *, const char *), void *);
static int (*enter)(void *, bool, double, double, bool, double);
static int (*leave)(void *);
static int (*set)(void *, const uint32_t *, size_t, const double *, size_t);
static int (*get)(void *, const uint32_t *, size_t, double *, size_t);
static int (*step)(void *, double, double, bool, bool *, bool *, bool *, double *);
static void (*release)(void *);

static const char *token;
static double size, torque;
static long steps;
static size_t variables;

struct run {
    double torque, seconds;
    double values[MOST];
};

static void complain(void *environment, int status, const char *category, const char *message)
{
    (void)environment;
    fprintf(stderr, "%d %s: %s\n", status, category, message);
}

static void check(int status)
{
    if (status != 0)
        exit(1);
}

static void *simulate(void *given)
{
    struct run *run = given;
    uint32_t input = 1, references[MOST];
    struct timespec begun, ended;
    size_t i;
    long k;
    void *one = instantiate(
        "harness", token, NULL, false, false, false, false, NULL, 0, NULL, complain, NULL);
    if (one == NULL)
        exit(1);
    for (i = 0; i < variables; i++)
        references[i] = (uint32_t)i;
    check(enter(one, false, 0.0, 0.0, false, 0.0));
    check(set(one, &input, 1, &run->torque, 1));
    check(leave(one));
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begun);
    for (k = 0; k < steps; k++) {
        bool events, terminate, early;
        double reached;
        check(set(one, &input, 1, &run->torque, 1));
        check(step(one, k * size, size, true, &events, &terminate, &early, &reached));
        check(get(one, references, variables, run->values, variables));
    }
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &ended);
    run->seconds = (double)(ended.tv_sec - begun.tv_sec) + 1e-9 * (double)(ended.tv_nsec - begun.tv_nsec);
    release(one);
    return NULL;
}

int main(int count, char **words)
{
    void *library;
    static struct run alone[MOST], together[MOST];
    pthread_t threads[MOST];
    int instances, i, equal = 1;
    double shortest = 1e9;
    char line[4096];
    FILE *maps;
    if (count != 8 || (library = dlopen(words[1], RTLD_NOW | RTLD_LOCAL)) == NULL) {
        fprintf(stderr, "%s\n", count == 8 ? dlerror() : "wrong arguments");
        return 1;
    }
    *(void **)&instantiate = dlsym(library, "fmi3InstantiateCoSimulation");
    *(void **)&enter = dlsym(library, "fmi3EnterInitializationMode");
    *(void **)&leave = dlsym(library, "fmi3ExitInitializationMode");
    *(void **)&set = dlsym(library, "fmi3SetFloat64");
    *(void **)&get = dlsym(library, "fmi3GetFloat64");
    *(void **)&step = dlsym(library, "fmi3DoStep");
    *(void **)&release = dlsym(library, "fmi3FreeInstance");
    token = words[2];
    size = atof(words[3]);
    steps = atol(words[4]);
    instances = atoi(words[5]);
    torque = atof(words[6]);
    variables = (size_t)atol(words[7]);
    if (instances > MOST || variables > MOST)
        return 1;
    for (i = 0; i < instances; i++) {
        alone[i].torque = together[i].torque = torque * (1.0 + 0.01 * i);
        simulate(&alone[i]);
    }
    for (i = 0; i < instances; i++)
        pthread_create(&threads[i], NULL, simulate, &together[i]);
    for (i = 0; i < instances; i++) {
        pthread_join(threads[i], NULL);
        equal = equal && memcmp(alone[i].values, together[i].values, variables * sizeof(double)) == 0;
    }
    for (i = 0; i < REPEATS; i++) {
        struct run run = { .torque = torque };
        simulate(&run);
        shortest = run.seconds < shortest ? run.seconds : shortest;
    }
    printf("{\"step_us\": %.6f, \"equal\": %s, \"values\": [", 1e6 * shortest / (double)steps,
           equal ? "true" : "false");
    for (i = 0; i < (int)variables; i++)
        printf("%s%.17g", i > 0 ? ", " : "", alone[0].values[i]);
    printf("], \"different\": %s, \"loaded\": [",
           instances > 1 && memcmp(alone[0].values, alone[1].values, variables * sizeof(double)) ? "true" : "false");
    maps = fopen("/proc/self/maps", "r");
    for (i = 0; maps != NULL && fgets(line, sizeof line, maps) != NULL;) {
        char *name = strchr(line, '/');
        if (name == NULL)
            continue;
        name[strcspn(name, "\n")] = '\0';
        printf("%s\"%s\"", i++ > 0 ? ", " : "", name);
    }
    printf("]}\n");
    return 0;
}
