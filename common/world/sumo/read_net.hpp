// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"

// A network of SUMO (.net.xml; https://sumo.dlr.de/docs/Networks/SUMO_Road_Networks.html).
namespace rodeira::sumo {

// A <lane>.
struct NetLane {
  bool for_cars = true;  // vehicles of the class "passenger" may use it
};

// An <edge>: the lanes of one direction of a road from junction `from` to junction `to`.
struct NetEdge {
  std::string id, from, to, street;
  bool internal = false;       // inside a junction
  std::vector<NetLane> lanes;  // from right to left
  double end_heading_rad = 0.0;
};

// A way over a junction, from a lane to a lane.
struct NetConnection {
  std::string from, to;
  int from_lane = 0, to_lane = 0;  // from right to left
  std::string via;                 // the first lane inside the junction; empty: none
  std::string light;               // the traffic light; empty: none
  int light_index = -1;            // which letter of its states
  char state = 'M';                // right of way, without light: M major, m minor, = equal, s stop, w all-way stop …
  bool turns_round = false;
  std::string junction;
  int request = -1;  // its number in the junction's requests; -1: none
};

// The right of way of one way over a junction against all of its ways.
struct NetRequest {
  std::string response, foes;  // by request, the last letter is the first request: '1' where it has to yield, meets
};

// A <junction> with its <request>s, by their index.
struct NetJunction {
  std::string id, type;
  std::vector<NetRequest> requests;
};

// A <phase> of a traffic light.
struct LightPhase {
  double duration_s = 0.0;
  std::string state;  // a letter a light: G g y r u s o O
};

// A <tlLogic>; the offset shifts the phases in time.
struct LightProgram {
  std::string id;    // of the light
  std::string type;  // "static", "actuated" …
  double offset_s = 0.0;
  std::vector<LightPhase> phases;
};

// What is read of the file.
struct Net {
  std::vector<NetEdge> edges;
  std::vector<NetConnection> connections;  // without those inside a junction
  std::map<std::string, NetJunction> junctions;
  std::map<std::string, LightProgram> programs;  // by light; of several programs SUMO runs the last one

  // Null where no edge has this id.
  const NetEdge* Edge(const std::string& id) const;

 private:
  friend base::Result<Net> ReadNet(const std::filesystem::path& file);
  std::map<std::string, std::size_t> index_;
};

// Wrong input where the file is no such network.
base::Result<Net> ReadNet(const std::filesystem::path& file);

// Whether request `of` has to yield to `to`, or meets it.
bool IsSet(const std::string& letters, int to);

}  // namespace rodeira::sumo
