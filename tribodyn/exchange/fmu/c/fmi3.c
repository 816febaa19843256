/* FMI 3.0 for co-simulation: the functions of the standard over an instance.
 *
 * Names, types and values are those of "Functional Mock-up Interface Specification", version 3.0.
 */
#include <stdbool.h>

#define STANDARD fmi3
#define BOOLEAN bool
#define STATE(verb) JOIN(verb, FMUState)
#define DESERIALIZE Deserialize
#if defined(FMI3_OVERRIDE_FUNCTION_PREFIX) && defined(FMI3_ACTUAL_FUNCTION_PREFIX)
#define PREFIX FMI3_ACTUAL_FUNCTION_PREFIX
#elif !defined(FMI3_OVERRIDE_FUNCTION_PREFIX) && defined(FMI3_FUNCTION_PREFIX)
#define PREFIX FMI3_FUNCTION_PREFIX
#endif
#include "functions.c"

typedef void *fmi3Instance;
typedef void *fmi3InstanceEnvironment;
typedef void *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef float fmi3Float32;
typedef double fmi3Float64;
typedef int8_t fmi3Int8;
typedef uint8_t fmi3UInt8;
typedef int16_t fmi3Int16;
typedef uint16_t fmi3UInt16;
typedef int32_t fmi3Int32;
typedef uint32_t fmi3UInt32;
typedef int64_t fmi3Int64;
typedef uint64_t fmi3UInt64;
typedef bool fmi3Boolean;
typedef char fmi3Char;
typedef const fmi3Char *fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte *fmi3Binary;
typedef bool fmi3Clock;
typedef int fmi3Status; /* the first values are those of `enum status` */
typedef int fmi3DependencyKind;
typedef int fmi3IntervalQualifier;

typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String, fmi3String);
typedef void (*fmi3IntermediateUpdateCallback)(
    fmi3InstanceEnvironment, fmi3Float64, fmi3Boolean, fmi3Boolean, fmi3Boolean, fmi3Boolean, fmi3Boolean *,
    fmi3Float64 *);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment);
typedef void (*fmi3LockPreemptionCallback)(void);

static void report(const struct instance *one, enum status status, const char *category, const char *message)
{
    if (one->logger != NULL)
        ((fmi3LogMessageCallback)one->logger)(one->environment, (fmi3Status)status, category, message);
}

DECLARED(const char *, fmi3GetVersion)(void)
{
    return "3.0";
}

/* A new instance; NULL, and the reason is logged, where something is `wrong`. */
static struct instance *made(
    fmi3String name, fmi3String given, const char *wrong, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger)
{
    struct instance *one = instantiated(name);
    if (one == NULL)
        return NULL;
    one->report = report;
    one->logger = (void (*)(void))logger;
    one->environment = environment;
    one->logs_steps = logging;
    if (wrong == NULL && (given == NULL || strcmp(given, token) != 0))
        wrong = "the instantiation token is not that of this FMU";
    if (wrong == NULL)
        return one;
    failed(one, "%s", wrong);
    release(one);
    return NULL;
}

DECLARED(fmi3Instance, fmi3InstantiateCoSimulation)(
    fmi3String name, fmi3String given, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3Boolean events, fmi3Boolean early, const fmi3ValueReference required[], size_t count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger, fmi3IntermediateUpdateCallback update)
{
    const char *wrong = NULL;
    if (events)
        wrong = "fmi3InstantiateCoSimulation: this FMU has no event mode";
    else if (count > 0)
        wrong = "fmi3InstantiateCoSimulation: this FMU has no intermediate updates";
    return made(name, given, wrong, logging, environment, logger);
}

DECLARED(fmi3Instance, fmi3InstantiateModelExchange)(
    fmi3String name, fmi3String given, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger)
{
    return made(
        name, given, "fmi3InstantiateModelExchange: this FMU is for co-simulation alone", logging,
        environment, logger);
}

DECLARED(fmi3Instance, fmi3InstantiateScheduledExecution)(
    fmi3String name, fmi3String given, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger, fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock, fmi3LockPreemptionCallback unlock)
{
    return made(
        name, given, "fmi3InstantiateScheduledExecution: this FMU is for co-simulation alone", logging,
        environment, logger);
}

DECLARED(fmi3Status, fmi3EnterInitializationMode)(
    fmi3Instance one, fmi3Boolean given, fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean ends,
    fmi3Float64 stop)
{
    if (refused(one, "fmi3EnterInitializationMode", INSTANTIATED, INSTANTIATED)
        || set_experiment(one, start, given, tolerance) != OK)
        return ERROR;
    enter(one, INITIALIZING);
    return OK;
}

DECLARED(fmi3Status, fmi3GetFloat64)(
    fmi3Instance one, const fmi3ValueReference references[], size_t count, fmi3Float64 values[],
    size_t value_count)
{
    if (value_count != count)
        return (fmi3Status)failed(one, "fmi3GetFloat64: all variables are scalars");
    return (fmi3Status)get_values(one, references, count, values);
}

DECLARED(fmi3Status, fmi3SetFloat64)(
    fmi3Instance one, const fmi3ValueReference references[], size_t count, const fmi3Float64 values[],
    size_t value_count)
{
    if (value_count != count)
        return (fmi3Status)failed(one, "fmi3SetFloat64: all variables are scalars");
    return (fmi3Status)set_values(one, references, count, values);
}

/* Variables of other types: there are none. */
#define WITHOUT(name, type)                                                                              \
    DECLARED(fmi3Status, name)(                                                                          \
        fmi3Instance one, const fmi3ValueReference references[], size_t count, type values[],            \
        size_t value_count)                                                                              \
    {                                                                                                    \
        return count == 0 ? OK : failed(one, #name ": all variables are of type Float64");               \
    }
#define WITHOUT_BOTH(type)                      \
    WITHOUT(fmi3Get##type, fmi3##type)          \
    WITHOUT(fmi3Set##type, const fmi3##type)

WITHOUT_BOTH(Float32)
WITHOUT_BOTH(Int8)
WITHOUT_BOTH(UInt8)
WITHOUT_BOTH(Int16)
WITHOUT_BOTH(UInt16)
WITHOUT_BOTH(Int32)
WITHOUT_BOTH(UInt32)
WITHOUT_BOTH(Int64)
WITHOUT_BOTH(UInt64)
WITHOUT_BOTH(Boolean)
WITHOUT_BOTH(String)

DECLARED(fmi3Status, fmi3DoStep)(
    fmi3Instance one, fmi3Float64 from, fmi3Float64 size, fmi3Boolean no_return, fmi3Boolean *events,
    fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *reached)
{
    enum status status;
    if (events != NULL)
        *events = false;
    if (terminate != NULL)
        *terminate = false;
    if (early != NULL)
        *early = false;
    status = refused(one, "fmi3DoStep", STEPPING, STEPPING) ? ERROR : step(one, from, size);
    if (reached != NULL)
        *reached = values_of(one)[0];
    return (fmi3Status)status;
}

/* What this FMU does not have. */
#define STANDARD_3 fmi3Instance one
#define OF_VARIABLES fmi3Instance one, const fmi3ValueReference references[], size_t count

UNSUPPORTED(fmi3GetBinary, (OF_VARIABLES, size_t sizes[], fmi3Binary values[], size_t value_count))
UNSUPPORTED(
    fmi3SetBinary, (OF_VARIABLES, const size_t sizes[], const fmi3Binary values[], size_t value_count))
UNSUPPORTED(fmi3GetClock, (OF_VARIABLES, fmi3Clock values[]))
UNSUPPORTED(fmi3SetClock, (OF_VARIABLES, const fmi3Clock values[]))
UNSUPPORTED(
    fmi3GetNumberOfVariableDependencies, (STANDARD_3, fmi3ValueReference reference, size_t *dependencies))
UNSUPPORTED(
    fmi3GetVariableDependencies,
    (STANDARD_3, fmi3ValueReference dependent, size_t elements[], fmi3ValueReference independents[],
     size_t of_independents[], fmi3DependencyKind kinds[], size_t dependencies))
#define DERIVATIVE                                                                                       \
    (STANDARD_3, const fmi3ValueReference unknown[], size_t unknowns, const fmi3ValueReference known[],  \
     size_t knowns, const fmi3Float64 seed[], size_t seeds, fmi3Float64 sensitivity[],                   \
     size_t sensitivities)
UNSUPPORTED(fmi3GetDirectionalDerivative, DERIVATIVE)
UNSUPPORTED(fmi3GetAdjointDerivative, DERIVATIVE)
UNSUPPORTED(
    fmi3GetOutputDerivatives, (OF_VARIABLES, const fmi3Int32 orders[], fmi3Float64 values[], size_t value_count))
UNSUPPORTED(fmi3EnterConfigurationMode, (STANDARD_3))
UNSUPPORTED(fmi3ExitConfigurationMode, (STANDARD_3))
UNSUPPORTED(fmi3EnterStepMode, (STANDARD_3))

/* Events and clocks. */
UNSUPPORTED(fmi3EnterEventMode, (STANDARD_3))
UNSUPPORTED(
    fmi3GetIntervalDecimal, (OF_VARIABLES, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[]))
UNSUPPORTED(
    fmi3GetIntervalFraction,
    (OF_VARIABLES, fmi3UInt64 counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[]))
UNSUPPORTED(fmi3GetShiftDecimal, (OF_VARIABLES, fmi3Float64 shifts[]))
UNSUPPORTED(fmi3GetShiftFraction, (OF_VARIABLES, fmi3UInt64 counters[], fmi3UInt64 resolutions[]))
UNSUPPORTED(fmi3SetIntervalDecimal, (OF_VARIABLES, const fmi3Float64 intervals[]))
UNSUPPORTED(
    fmi3SetIntervalFraction, (OF_VARIABLES, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]))
UNSUPPORTED(fmi3SetShiftDecimal, (OF_VARIABLES, const fmi3Float64 shifts[]))
UNSUPPORTED(fmi3SetShiftFraction, (OF_VARIABLES, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]))
UNSUPPORTED(fmi3EvaluateDiscreteStates, (STANDARD_3))
UNSUPPORTED(
    fmi3UpdateDiscreteStates,
    (STANDARD_3, fmi3Boolean *needed, fmi3Boolean *terminate, fmi3Boolean *nominals, fmi3Boolean *values,
     fmi3Boolean *defined, fmi3Float64 *next))
UNSUPPORTED(
    fmi3ActivateModelPartition, (STANDARD_3, fmi3ValueReference reference, fmi3Float64 activation))

/* Model exchange. */
UNSUPPORTED(fmi3EnterContinuousTimeMode, (STANDARD_3))
UNSUPPORTED(
    fmi3CompletedIntegratorStep,
    (STANDARD_3, fmi3Boolean unset, fmi3Boolean *enter_event_mode, fmi3Boolean *terminate))
UNSUPPORTED(fmi3SetTime, (STANDARD_3, fmi3Float64 time))
UNSUPPORTED(fmi3SetContinuousStates, (STANDARD_3, const fmi3Float64 states[], size_t count))
UNSUPPORTED(fmi3GetContinuousStateDerivatives, (STANDARD_3, fmi3Float64 derivatives[], size_t count))
UNSUPPORTED(fmi3GetEventIndicators, (STANDARD_3, fmi3Float64 indicators[], size_t count))
UNSUPPORTED(fmi3GetContinuousStates, (STANDARD_3, fmi3Float64 states[], size_t count))
UNSUPPORTED(fmi3GetNominalsOfContinuousStates, (STANDARD_3, fmi3Float64 nominals[], size_t count))
UNSUPPORTED(fmi3GetNumberOfEventIndicators, (STANDARD_3, size_t *count))
UNSUPPORTED(fmi3GetNumberOfContinuousStates, (STANDARD_3, size_t *count))
