/* An instance of the FMU, whatever the version of the standard: its phases, variables, steps and states.
 *
 * There is nothing static that changes: instances know nothing of each other.
 */
#include "simulation.c"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum status { OK, WARNING, DISCARDED, ERROR };

enum phase { INSTANTIATED, INITIALIZING, STEPPING, TERMINATED, FAILED };

/* Places in `held`; behind them are the values of the variables, then the numbers of the simulation. */
enum { PHASE, BEGIN, TOLERANCE, STARTED, CURRENT, VALUES };

/* Share of a step, and of the time, by which the importer's time may be off. */
#define TIME_ERROR 1e-6
#define TIME_ROUNDING 1e-12
#define LONGEST_MESSAGE 512

struct instance {
    char *name;
    void *environment;
    void (*report)(const struct instance *, enum status, const char *category, const char *message);
    void (*logger)(void); /* the importer's function, which `report` knows */
    int logs_steps;
    void *model;
    double *held; /* all that changes: a state is its bytes */
};

static const char *const categories[] = { "logStatusError", "logStep" };

static size_t held_count(void)
{
    return (size_t)(VALUES + variable_count + number_count);
}

static double *values_of(const struct instance *one)
{
    return one->held + VALUES;
}

static double *numbers_of(const struct instance *one)
{
    return one->held + VALUES + variable_count;
}

static enum phase phase_of(const struct instance *one)
{
    return (enum phase)one->held[PHASE];
}

static enum status failed(const struct instance *one, const char *format, ...)
{
    char message[LONGEST_MESSAGE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    one->report(one, ERROR, categories[0], message);
    return ERROR;
}

/* Put everything where it is after instantiation. */
static void reset(struct instance *one)
{
    int32_t i;
    memset(one->held, 0, held_count() * sizeof *one->held);
    one->held[PHASE] = INSTANTIATED;
    one->held[TOLERANCE] = usual_tolerance;
    for (i = 0; i < variable_count; i++)
        values_of(one)[i] = variables[i].start;
    simulation_prepare(one->model);
}

static void release(struct instance *one)
{
    if (one == NULL)
        return;
    free(one->name);
    free(one->model);
    free(one->held);
    free(one);
}

/* A new instance; NULL where there is no memory. */
static struct instance *instantiated(const char *name)
{
    struct instance *one = calloc(1, sizeof *one);
    size_t length = name == NULL ? 0 : strlen(name);
    if (one == NULL)
        return NULL;
    one->name = calloc(length + 1, 1);
    one->model = calloc(1, model_size);
    one->held = calloc(held_count(), sizeof *one->held);
    if (one->name == NULL || one->model == NULL || one->held == NULL) {
        release(one);
        return NULL;
    }
    if (length > 0)
        memcpy(one->name, name, length);
    reset(one);
    return one;
}

/* Whether a function may be called in this phase; says so where not. */
static int refused(const struct instance *one, const char *function, enum phase first, enum phase last)
{
    static const char *const words[] = {
        "before initialization", "in initialization mode", "in step mode", "after termination",
        "after an error; reset the instance, set a state, or free it"
    };
    if (phase_of(one) >= first && phase_of(one) <= last)
        return 0;
    failed(one, "%s: not allowed %s", function, words[phase_of(one)]);
    return 1;
}

static void start_if_due(struct instance *one)
{
    if (one->held[STARTED] == 0.0) {
        simulation_start(one->model, values_of(one), numbers_of(one));
        one->held[STARTED] = 1.0;
    }
}

static enum status get_value(struct instance *one, uint32_t reference, double *value)
{
    if (reference >= (uint32_t)variable_count)
        return failed(one, "there is no variable with value reference %lu", (unsigned long)reference);
    if (variables[reference].role == OUTPUT && one->held[CURRENT] == 0.0
        && phase_of(one) != INSTANTIATED && phase_of(one) != FAILED) {
        start_if_due(one);
        find_outputs(one->model, values_of(one), numbers_of(one));
        one->held[CURRENT] = 1.0;
    }
    *value = values_of(one)[reference];
    return OK;
}

static enum status set_value(struct instance *one, uint32_t reference, double value)
{
    const struct variable *variable;
    if (reference >= (uint32_t)variable_count)
        return failed(one, "there is no variable with value reference %lu", (unsigned long)reference);
    variable = &variables[reference];
    if (phase_of(one) > STEPPING)
        return failed(one, "%s cannot be set: the instance has stopped", variable->name);
    if (variable->role == OUTPUT)
        return failed(one, "%s is an output, and cannot be set", variable->name);
    if (variable->role == TIME_OF_MODEL)
        return failed(one, "%s follows from the steps, and cannot be set", variable->name);
    if (variable->role == FIXED_PARAMETER && phase_of(one) > INITIALIZING)
        return failed(one, "%s is fixed, and cannot be set after initialization", variable->name);
    if (!(value >= variable->minimum && value <= variable->maximum))
        return failed(
            one, "%s = %.9g: must be from %.9g to %.9g", variable->name, value, variable->minimum,
            variable->maximum);
    if (values_of(one)[reference] != value) {
        values_of(one)[reference] = value;
        one->held[CURRENT] = 0.0;
        if (phase_of(one) <= INITIALIZING)
            one->held[STARTED] = 0.0;
    }
    return OK;
}

static enum status set_experiment(struct instance *one, double start, int given, double tolerance)
{
    if (given && !(tolerance > 0.0 && tolerance < 1.0))
        return failed(one, "tolerance %.9g: must be above 0 and below 1", tolerance);
    one->held[BEGIN] = start;
    values_of(one)[0] = start;
    if (given)
        one->held[TOLERANCE] = tolerance;
    return OK;
}

static void enter(struct instance *one, enum phase phase)
{
    one->held[PHASE] = phase;
}

/* One communication step; the instance is of no more use where it fails, but for a state set or a reset. */
static enum status step(struct instance *one, double from, double size)
{
    double now = values_of(one)[0];
    double scale = from < 0.0 ? -from : from;
    double allowed = TIME_ERROR * size + TIME_ROUNDING * scale;
    int result;
    if (!(size > 0.0) || size > 1e300)
        return failed(one, "step size %.9g s: must be above 0", size);
    if (!(from - now <= allowed && now - from <= allowed))
        return failed(one, "communication point %.17g s: the instance is at %.17g s", from, now);
    result = advance_simulation(
        one->model, values_of(one), numbers_of(one), now + size - one->held[BEGIN], one->held[TOLERANCE]);
    one->held[CURRENT] = 0.0;
    if (result != 0) {
        one->held[PHASE] = FAILED;
        values_of(one)[0] = one->held[BEGIN] + simulation_time(numbers_of(one));
        return failed(
            one, "simulation stopped at %.9g s: %s", values_of(one)[0], simulation_reason(result));
    }
    values_of(one)[0] = now + size;
    if (one->logs_steps) {
        char message[LONGEST_MESSAGE];
        snprintf(message, sizeof message, "step from %.9g s to %.9g s", now, now + size);
        one->report(one, OK, categories[1], message);
    }
    return OK;
}

static size_t state_size(void)
{
    return held_count() * sizeof(double);
}

/* Copy numbers, all that changes, to a state, which is made where there is none. */
static enum status keep_state(const struct instance *one, void **state, const void *numbers)
{
    if (*state == NULL)
        *state = malloc(state_size());
    if (*state == NULL)
        return failed(one, "no memory for a state");
    memcpy(*state, numbers, state_size());
    return OK;
}

static enum status get_state(const struct instance *one, void **state)
{
    return keep_state(one, state, one->held);
}

static enum status free_state(void **state)
{
    if (state != NULL) {
        free(*state);
        *state = NULL;
    }
    return OK;
}

static enum status set_state(struct instance *one, const void *state)
{
    if (state == NULL)
        return failed(one, "there is no state to set");
    memcpy(one->held, state, state_size());
    return OK;
}

/* A serialized state: the token of the FMU, so that no other one takes it, a checksum, the numbers. */
enum { CHECKSUM = sizeof token - 1, NUMBERS = CHECKSUM + sizeof(uint64_t) };

static size_t serialized_size(void)
{
    return NUMBERS + state_size();
}

/* Checksum of the numbers of a state, Fowler-Noll-Vo 1a: bytes that changed on their way are no state. */
static uint64_t checksum(const unsigned char *bytes)
{
    uint64_t sum = UINT64_C(14695981039346656037);
    size_t i;
    for (i = 0; i < state_size(); i++)
        sum = (sum ^ bytes[i]) * UINT64_C(1099511628211);
    return sum;
}

static enum status serialize(const struct instance *one, const void *state, unsigned char *bytes, size_t size)
{
    uint64_t sum;
    if (state == NULL || size < serialized_size())
        return failed(one, "a state takes %lu bytes", (unsigned long)serialized_size());
    sum = checksum(state);
    memcpy(bytes, token, CHECKSUM);
    memcpy(bytes + CHECKSUM, &sum, sizeof sum);
    memcpy(bytes + NUMBERS, state, state_size());
    return OK;
}

static enum status deserialize(
    const struct instance *one, const unsigned char *bytes, size_t size, void **state)
{
    uint64_t sum = 0;
    int ours = size == serialized_size() && memcmp(bytes, token, CHECKSUM) == 0;
    if (ours)
        memcpy(&sum, bytes + CHECKSUM, sizeof sum);
    if (!ours || sum != checksum(bytes + NUMBERS))
        return failed(one, "these bytes are no state of this FMU");
    return keep_state(one, state, bytes + NUMBERS);
}

/* Choose what is logged; an unknown category is an error. */
static enum status set_logging(struct instance *one, int on, size_t count, const char *const *names)
{
    size_t i;
    if (count == 0) {
        one->logs_steps = on;
        return OK;
    }
    for (i = 0; i < count; i++) {
        if (strcmp(names[i], categories[1]) == 0)
            one->logs_steps = on;
        else if (strcmp(names[i], categories[0]) != 0)
            return failed(one, "there is no log category %.100s", names[i]);
    }
    return OK;
}
