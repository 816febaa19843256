/* The functions that FMI 2.0 and 3.0 share but for their names: NAMED(name) is that of the version.
 *
 * Statuses of both are integers whose first values are those of `enum status`; value references have 32 bits.
 */
#include "instance.c"

#define JOIN_TEXTS(first, second) first##second
#define JOIN(first, second) JOIN_TEXTS(first, second)
#define QUOTED_TEXT(name) #name
#define QUOTED(name) QUOTED_TEXT(name)
#define NAMED(name) JOIN(STANDARD, name)

#if defined(PREFIX)
#define FUNCTION(name) JOIN(PREFIX, name)
#else
#define FUNCTION(name) name
#endif

#if defined(_WIN32)
#define EXPORTED __declspec(dllexport)
#elif defined(__GNUC__)
#define EXPORTED __attribute__((visibility("default")))
#else
#define EXPORTED
#endif

#define DECLARED(type, name) EXPORTED type FUNCTION(name)

/* What this FMU does not have: its flags in modelDescription.xml say so. */
#define UNSUPPORTED(name, parameters)                            \
    DECLARED(int, name) parameters                               \
    {                                                            \
        return failed(one, #name ": this FMU does not have it"); \
    }

#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

DECLARED(int, NAMED(SetDebugLogging))(void *one, BOOLEAN on, size_t count, const char *const names[])
{
    return set_logging(one, on, count, names);
}

DECLARED(void, NAMED(FreeInstance))(void *one)
{
    release(one);
}

DECLARED(int, NAMED(ExitInitializationMode))(void *one)
{
    if (refused(one, QUOTED(NAMED(ExitInitializationMode)), INITIALIZING, INITIALIZING))
        return ERROR;
    start_if_due(one);
    enter(one, STEPPING);
    return OK;
}

DECLARED(int, NAMED(Terminate))(void *one)
{
    if (refused(one, QUOTED(NAMED(Terminate)), STEPPING, STEPPING))
        return ERROR;
    enter(one, TERMINATED);
    return OK;
}

DECLARED(int, NAMED(Reset))(void *one)
{
    reset(one);
    return OK;
}

static int get_values(void *one, const uint32_t references[], size_t count, double values[])
{
    size_t i;
    for (i = 0; i < count; i++)
        if (get_value(one, references[i], &values[i]) != OK)
            return ERROR;
    return OK;
}

static int set_values(void *one, const uint32_t references[], size_t count, const double values[])
{
    size_t i;
    for (i = 0; i < count; i++)
        if (set_value(one, references[i], values[i]) != OK)
            return ERROR;
    return OK;
}

DECLARED(int, NAMED(STATE(Get)))(void *one, void **state)
{
    return get_state(one, state);
}

DECLARED(int, NAMED(STATE(Set)))(void *one, void *state)
{
    return set_state(one, state);
}

DECLARED(int, NAMED(STATE(Free)))(void *one, void **state)
{
    return free_state(state);
}

DECLARED(int, NAMED(JOIN(STATE(Serialized), Size)))(void *one, void *state, size_t *size)
{
    *size = serialized_size();
    return OK;
}

DECLARED(int, NAMED(STATE(Serialize)))(void *one, void *state, unsigned char bytes[], size_t size)
{
    return serialize(one, state, bytes, size);
}

DECLARED(int, NAMED(STATE(DESERIALIZE)))(void *one, const unsigned char bytes[], size_t size, void **state)
{
    return deserialize(one, bytes, size, state);
}
