// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// All message types of Rodeira's IDL (namespace rodeira::msg), as fastddsgen makes them. docs/reference/wire.md lists
/// the types, the comments of the IDL files describe their members.

#include "clock.h"
#include "collisions.h"
#include "controls.h"
#include "ground.h"
#include "joint_forces.h"
#include "measures.h"
#include "operator_input.h"
#include "pulse.h"
#include "run_log.h"
#include "sample_batch.h"
#include "scenario.h"
#include "signals.h"
#include "snapshot.h"
#include "traffic.h"
#include "traffic_requests.h"
#include "trigger.h"
#include "vehicle.h"
#include "weather.h"
#include "world.h"
