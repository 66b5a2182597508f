// SPDX-License-Identifier: Apache-2.0
/* A car of four numbers as an FMU for co-simulation (FMI 2.0), for tests: place, heading and speed of a point that
 * rolls on its wheels. dv/dt = 3 throttle (backward in reverse) - 0.05 v - 6 brake sign(v) + push along the car / 1000
 * kg, dheading/dt = v tan(steering wheel / 16) / 2.5 by explicit Euler steps. z is the mean of the ground's four
 * heights. Parameters make it fail, hang, crash, or say what is no number. Definitions: its state holds an address that
 * is of no use (ADDRESS_IN_STATE) or is used (POINTER_IN_STATE); its solver begins anew with a state
 * (STATE_WITHOUT_HISTORY); a process may have one instance only (ONLY_ONCE). */
#include <math.h>
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef struct {
  void (*logger)(void*, const char*, fmi2Status, const char*, const char*, ...);
  void* (*allocateMemory)(size_t, size_t);
  void (*freeMemory)(void*);
  void (*stepFinished)(void*, fmi2Status);
  void* componentEnvironment;
} fmi2CallbackFunctions;

enum {
  kX,
  kY,
  kZ,
  kRoll,
  kPitch,
  kHeading,
  kVx,
  kVy,
  kVz,
  kRollRate,
  kPitchRate,
  kYawRate,
  kSteering,
  kThrottle,
  kBrake,
  kGround0,
  kGround1,
  kGround2,
  kGround3,
  kStartX,
  kStartY,
  kStartZ,
  kStartHeading,
  kStartSpeed,
  kFailAt,
  kHangAt,
  kNonsenseAt,
  kPushX,
  kPushY,
  kPushZ,
  kMomentX,
  kMomentY,
  kMomentZ,
  kGearLever,
  kCrashAt,
  kExitAt,
  kSpeed,
  kQuaternionW,
  kQuaternionX,
  kQuaternionY,
  kQuaternionZ,
  kReals
};

typedef struct {
  double real[kReals];
  int gear;
#if defined(ADDRESS_IN_STATE) || defined(POINTER_IN_STATE)
  const fmi2CallbackFunctions* callbacks; /* an address of this process */
#endif
} Values;

typedef struct {
  Values values;
  const fmi2CallbackFunctions* callbacks;
  int restarts; /* of the solver, no part of the state */
} Car;

#define EXPORT __attribute__((visibility("default")))

static void publish(Values* v) {
  const double c = cos(v->real[kHeading]), s = sin(v->real[kHeading]);
  v->real[kVx] = v->real[kSpeed] * c;
  v->real[kVy] = v->real[kSpeed] * s;
  v->real[kYawRate] = v->real[kSpeed] * tan(v->real[kSteering] / 16.0) / 2.5;
  v->real[kZ] = 0.25 * (v->real[kGround0] + v->real[kGround1] + v->real[kGround2] + v->real[kGround3]);
  v->gear = v->real[kSpeed] < 0.0 ? -1 : 1;
  v->real[kQuaternionW] = cos(0.5 * v->real[kHeading]);
  v->real[kQuaternionZ] = sin(0.5 * v->real[kHeading]);
}

#ifdef CRASH_WHEN_LOADED
__attribute__((constructor)) static void crash(void) { raise(SIGSEGV); }
#endif

EXPORT const char* fmi2GetVersion(void) { return "2.0"; }
EXPORT const char* fmi2GetTypesPlatform(void) { return "default"; }

EXPORT void* fmi2Instantiate(const char* name, int type, const char* guid, const char* resources,
                             const fmi2CallbackFunctions* callbacks, int visible, int logging) {
  Car* car;
  volatile double never = 0.0;
  (void)name, (void)resources, (void)visible, (void)logging;
  if (strcmp(guid, "{crashes}") == 0) raise(SIGSEGV);
  if (strcmp(guid, "{exits}") == 0) exit(0);
  while (strcmp(guid, "{sleeps}") == 0) pause();
  while (strcmp(guid, "{computes}") == 0) never = never + 1.0;
  if (type != 1 || strcmp(guid, "{rodeira-test-car}") != 0) {
    callbacks->logger(callbacks->componentEnvironment, "car", fmi2Error, "guid",
                      "the guid is %s, which is another car's", guid);
    return NULL;
  }
#ifdef ONLY_ONCE
  static int made;
  if (made++ != 0) {
    callbacks->logger(callbacks->componentEnvironment, "car", fmi2Error, "once", "this process has had one before");
    return NULL;
  }
#endif
  car = callbacks->allocateMemory(1, sizeof(Car));
  if (car == NULL) return NULL;
  car->callbacks = callbacks;
#if defined(ADDRESS_IN_STATE) || defined(POINTER_IN_STATE)
  car->values.callbacks = callbacks;
#endif
  car->values.real[kFailAt] = car->values.real[kHangAt] = car->values.real[kNonsenseAt] = 1e9;
  car->values.real[kCrashAt] = car->values.real[kExitAt] = 1e9;
  return car;
}
EXPORT void fmi2FreeInstance(void* c) { ((Car*)c)->callbacks->freeMemory(c); }
EXPORT fmi2Status fmi2SetupExperiment(void* c, int has_tolerance, double tolerance, double start, int has_stop,
                                      double stop) {
  (void)c, (void)has_tolerance, (void)tolerance, (void)start, (void)has_stop, (void)stop;
  return fmi2OK;
}
EXPORT fmi2Status fmi2EnterInitializationMode(void* c) { return (void)c, fmi2OK; }
EXPORT fmi2Status fmi2ExitInitializationMode(void* c) {
  Values* v = &((Car*)c)->values;
  v->real[kX] = v->real[kStartX];
  v->real[kY] = v->real[kStartY];
  v->real[kHeading] = v->real[kStartHeading];
  v->real[kSpeed] = v->real[kStartSpeed];
  publish(v);
  return fmi2OK;
}
EXPORT fmi2Status fmi2Terminate(void* c) { return (void)c, fmi2OK; }
EXPORT fmi2Status fmi2Reset(void* c) {
  Values* v = &((Car*)c)->values;
  memset(v->real, 0, sizeof(v->real));
  v->real[kFailAt] = v->real[kHangAt] = v->real[kNonsenseAt] = v->real[kCrashAt] = v->real[kExitAt] = 1e9;
  return fmi2OK;
}

EXPORT fmi2Status fmi2GetReal(void* c, const unsigned* r, size_t n, double* value) {
  for (size_t i = 0; i < n; ++i) {
    if (r[i] >= kReals) return fmi2Error;
    value[i] = ((Car*)c)->values.real[r[i]];
  }
  return fmi2OK;
}
EXPORT fmi2Status fmi2SetReal(void* c, const unsigned* r, size_t n, const double* value) {
  for (size_t i = 0; i < n; ++i) {
    if (r[i] < kSteering || r[i] >= kSpeed) return fmi2Error;
    ((Car*)c)->values.real[r[i]] = value[i];
  }
  return fmi2OK;
}
EXPORT fmi2Status fmi2GetInteger(void* c, const unsigned* r, size_t n, int* value) {
  if (n != 1 || r[0] != 0) return fmi2Error;
  value[0] = ((Car*)c)->values.gear;
  return fmi2OK;
}
EXPORT fmi2Status fmi2SetInteger(void* c, const unsigned* r, size_t n, const int* value) {
  return (void)c, (void)r, (void)n, (void)value, fmi2Error;
}
EXPORT fmi2Status fmi2GetBoolean(void* c, const unsigned* r, size_t n, int* value) {
  return (void)c, (void)r, (void)n, (void)value, fmi2Error;
}
EXPORT fmi2Status fmi2SetBoolean(void* c, const unsigned* r, size_t n, const int* value) {
  return (void)c, (void)r, (void)n, (void)value, fmi2Error;
}

EXPORT fmi2Status fmi2DoStep(void* c, double time, double step, int no_return) {
  Car* car = c;
  Values* v = &car->values;
  double brake;
  volatile double never = 0.0;
  (void)no_return;
  if (time >= v->real[kFailAt] - 1e-9) {
    car->callbacks->logger(car->callbacks->componentEnvironment, "car", fmi2Error, "step",
                           "the tank is empty at %.1f s", time);
    return fmi2Error;
  }
  while (time >= v->real[kHangAt] - 1e-9) never = never + 1.0;
  if (time >= v->real[kCrashAt] - 1e-9) raise(SIGSEGV);
  if (time >= v->real[kExitAt] - 1e-9) exit(0);
  brake = 6.0 * v->real[kBrake] * step;
  v->real[kX] += step * v->real[kSpeed] * cos(v->real[kHeading]);
  v->real[kY] += step * v->real[kSpeed] * sin(v->real[kHeading]);
  v->real[kHeading] += step * v->real[kSpeed] * tan(v->real[kSteering] / 16.0) / 2.5;
  v->real[kSpeed] += step * ((v->real[kGearLever] < 0.0 ? -3.0 : 3.0) * v->real[kThrottle] - 0.05 * v->real[kSpeed]);
  v->real[kSpeed] +=
      step / 1000.0 * (v->real[kPushX] * cos(v->real[kHeading]) + v->real[kPushY] * sin(v->real[kHeading]));
  v->real[kSpeed] = fabs(v->real[kSpeed]) <= brake ? 0.0 : v->real[kSpeed] - copysign(brake, v->real[kSpeed]);
  publish(v);
#ifdef STATE_WITHOUT_HISTORY
  v->real[kRoll] += 1e-9 * car->restarts;
#endif
  if (time >= v->real[kNonsenseAt] - 1e-9) v->real[kY] = NAN;
  return fmi2OK;
}

EXPORT fmi2Status fmi2GetFMUstate(void* c, void** state) {
  if (*state == NULL) *state = malloc(sizeof(Values));
  if (*state == NULL) return fmi2Error;
  memcpy(*state, &((Car*)c)->values, sizeof(Values));
  return fmi2OK;
}
EXPORT fmi2Status fmi2SetFMUstate(void* c, void* state) {
  Car* car = c;
#ifdef ADDRESS_IN_STATE
  ((Values*)state)->callbacks = car->callbacks; /* as a careful maker does */
#endif
  memcpy(&car->values, state, sizeof(Values));
  ++car->restarts;
#ifdef POINTER_IN_STATE
  car->callbacks = car->values.callbacks; /* of the process that saved it */
#endif
  return fmi2OK;
}
EXPORT fmi2Status fmi2FreeFMUstate(void* c, void** state) {
  (void)c;
  free(*state);
  *state = NULL;
  return fmi2OK;
}
EXPORT fmi2Status fmi2SerializedFMUstateSize(void* c, void* state, size_t* size) {
  return (void)c, (void)state, *size = sizeof(Values), fmi2OK;
}
EXPORT fmi2Status fmi2SerializeFMUstate(void* c, void* state, char* bytes, size_t size) {
  (void)c;
  if (size != sizeof(Values)) return fmi2Error;
  memcpy(bytes, state, size);
  return fmi2OK;
}
EXPORT fmi2Status fmi2DeSerializeFMUstate(void* c, const char* bytes, size_t size, void** state) {
  (void)c;
  if (size != sizeof(Values)) return fmi2Error;
  *state = malloc(size);
  if (*state == NULL) return fmi2Error;
  memcpy(*state, bytes, size);
  return fmi2OK;
}
