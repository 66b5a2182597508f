// SPDX-License-Identifier: Apache-2.0
#pragma once

// All message types of the IDL (namespace rodeira::msg), as fastddsgen makes them.
#include "clock.h"
#include "collision.h"
#include "driving.h"
#include "ground.h"
#include "live.h"
#include "log.h"
#include "parcel.h"
#include "pulse.h"
#include "scenario.h"
#include "signals.h"
#include "snapshot.h"
#include "traffic.h"
#include "trigger.h"
#include "vehicle.h"
#include "weather.h"
#include "world.h"
