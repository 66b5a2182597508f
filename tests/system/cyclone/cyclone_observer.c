// SPDX-License-Identifier: Apache-2.0
// A program that is not Rodeira's: it uses CycloneDDS and what its compiler makes of Rodeira's IDL files. It reads
// every topic of a run, best effort, and asks the ground server for a height.
//
//   cyclone_observer DOMAIN RUN X_M Y_M
//
// It prints "read TOPIC" at the first sample of each topic, "height Z_M" at the server's answer, and "all" when it has
// both. It runs until a signal ends it.
#include <dds/dds.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

enum { kRequester = 4000000000u };  // no node of any run

struct Subject {
  const char* topic;
  const dds_topic_descriptor_t* type;
  dds_entity_t reader;
  bool is_read;
};

static struct Subject g_subjects[] = {
    {"rodeira/controls", &rodeira_msg_Controls_desc, 0, false},
    {"rodeira/vehicle_state", &rodeira_msg_VehicleState_desc, 0, false},
    {"rodeira/collisions", &rodeira_msg_Collisions_desc, 0, false},
    {"rodeira/joint_forces", &rodeira_msg_JointForces_desc, 0, false},
    {"rodeira/traffic_state", &rodeira_msg_TrafficState_desc, 0, false},
    {"rodeira/traffic_details", &rodeira_msg_TrafficDetails_desc, 0, false},
    {"rodeira/traffic_requests", &rodeira_msg_TrafficRequests_desc, 0, false},
    {"rodeira/traffic_answers", &rodeira_msg_TrafficAnswers_desc, 0, false},
    {"rodeira/signals_state", &rodeira_msg_SignalsState_desc, 0, false},
    {"rodeira/scenario_events", &rodeira_msg_ScenarioEvents_desc, 0, false},
    {"rodeira/weather_state", &rodeira_msg_WeatherState_desc, 0, false},
    {"rodeira/measures", &rodeira_msg_Measures_desc, 0, false},
    {"rodeira/snapshot", &rodeira_msg_Snapshot_desc, 0, false},
    {"rodeira/pulse", &rodeira_msg_Pulse_desc, 0, false},
    {"rodeira/sample_batches/recorder", &rodeira_msg_SampleBatch_desc, 0, false},
    {"rodeira/grant", &rodeira_msg_Grant_desc, 0, false},
    {"rodeira/nack", &rodeira_msg_Nack_desc, 0, false},
    {"rodeira/retransmissions", &rodeira_msg_SampleBatch_desc, 0, false},
    {"rodeira/report", &rodeira_msg_Report_desc, 0, false},
    {"rodeira/ground_request", &rodeira_msg_GroundRequest_desc, 0, false},
    {"rodeira/ground_reply", &rodeira_msg_GroundReply_desc, 0, false},
    {"rodeira/world_info", &rodeira_msg_WorldInfo_desc, 0, false},
    {"rodeira/window_keys", &rodeira_msg_WindowKeys_desc, 0, false},
    {"rodeira/operator_requests", &rodeira_msg_OperatorRequests_desc, 0, false},
    {"rodeira/run_log", &rodeira_msg_RunLog_desc, 0, false},
    {"rodeira/trigger", &rodeira_msg_Trigger_desc, 0, false},
};
enum { kSubjects = sizeof(g_subjects) / sizeof(g_subjects[0]) };

static dds_entity_t Checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  printf("cyclone_observer: %s: %s\n", what, dds_strretcode(entity));
  exit(1);
}

// Asks for the height at a point.
static void RequestPlace(dds_entity_t writer, double x_m, double y_m) {
  rodeira_msg_GroundPointQuery point = {.x_m = x_m, .y_m = y_m, .z_hint_m = NAN};
  rodeira_msg_GroundRequest request;
  memset(&request, 0, sizeof(request));
  request.requester = kRequester;
  request.request_number = 1;
  request.points._buffer = &point;
  request.points._length = request.points._maximum = 1;
  dds_write(writer, &request);
}

// Takes what has come; true if there was a sample. Prints the answer to Ask once.
static bool Take(struct Subject* subject, bool* is_answered) {
  bool has_sample = false;
  void* samples[16] = {NULL};
  dds_sample_info_t infos[16];
  const int count = dds_take(subject->reader, samples, infos, 16, 16);
  for (int i = 0; i < count; ++i) {
    if (!infos[i].valid_data) continue;
    has_sample = true;
    if (*is_answered || subject->type != &rodeira_msg_GroundReply_desc) continue;
    const rodeira_msg_GroundReply* reply = samples[i];
    if (reply->requester != kRequester || reply->points._length != 1) continue;
    printf("height %.17g\n", reply->points._buffer[0].z_m);
    *is_answered = true;
  }
  if (count > 0) dds_return_loan(subject->reader, samples, count);
  return has_sample;
}

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  setvbuf(stdout, NULL, _IOLBF, 0);
  char partition[256];
  snprintf(partition, sizeof(partition), "rodeira/%s", argv[2]);
  const char* partitions[] = {partition};
  const dds_entity_t participant =
      Checked(dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL), "participant");
  dds_qos_t* qos = dds_create_qos();
  dds_qset_partition(qos, 1, partitions);
  const dds_entity_t subscriber = Checked(dds_create_subscriber(participant, qos, NULL), "subscriber");
  const dds_entity_t publisher = Checked(dds_create_publisher(participant, qos, NULL), "publisher");
  dds_qos_t* best_effort = dds_create_qos();
  dds_qset_reliability(best_effort, DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_history(best_effort, DDS_HISTORY_KEEP_LAST, 256);
  // World and triggers are kept for readers that come later.
  dds_qos_t* kept = dds_create_qos();
  dds_qset_reliability(kept, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(kept, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(kept, DDS_HISTORY_KEEP_LAST, 256);
  dds_entity_t requests = 0;
  for (int i = 0; i < kSubjects; ++i) {
    struct Subject* subject = &g_subjects[i];
    const bool is_kept = subject->type == &rodeira_msg_WorldInfo_desc || subject->type == &rodeira_msg_Trigger_desc;
    const dds_entity_t topic =
        Checked(dds_create_topic(participant, subject->type, subject->topic, NULL, NULL), subject->topic);
    subject->reader = Checked(dds_create_reader(subscriber, topic, is_kept ? kept : best_effort, NULL), subject->topic);
    if (subject->type == &rodeira_msg_GroundRequest_desc) {
      // Its own requests are not what it is to read.
      dds_qset_ignorelocal(best_effort, DDS_IGNORELOCAL_PARTICIPANT);
      dds_delete(subject->reader);
      subject->reader = Checked(dds_create_reader(subscriber, topic, best_effort, NULL), subject->topic);
      requests = Checked(dds_create_writer(publisher, topic, best_effort, NULL), "ground requests");
      dds_qset_ignorelocal(best_effort, DDS_IGNORELOCAL_NONE);
    }
  }
  bool is_answered = false;
  int left = kSubjects;
  for (;;) {
    if (!is_answered) RequestPlace(requests, atof(argv[3]), atof(argv[4]));
    for (int i = 0; i < kSubjects; ++i) {
      if (!Take(&g_subjects[i], &is_answered) || g_subjects[i].is_read) continue;
      g_subjects[i].is_read = true;
      printf("read %s\n", g_subjects[i].topic);
      --left;
    }
    if (left == 0 && is_answered) {
      printf("all\n");
      left = -1;
    }
    dds_sleepfor(DDS_MSECS(20));
  }
}
