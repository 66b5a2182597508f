// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/trip_infos.hpp"

#include <algorithm>

#include "common/core/base/append_format.hpp"
#include "common/traffic/results/lane_statistics.hpp"
#include "common/traffic/results/names.hpp"
#include "common/world/lanes/floating_car.hpp"

namespace rodeira::traffic {

std::string TripInfos::Begin() {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<tripinfos "
         "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
         "xsi:noNamespaceSchemaLocation=\"http://sumo.dlr.de/xsd/tripinfo_file.xsd\">\n";
}

std::string TripInfos::End() { return "</tripinfos>\n"; }

void TripInfos::Write(std::string& text, double time_s, const TrafficModel& model, std::uint32_t id) const {
  const Trip& trip = trips_[id];
  base::AppendFormat(text,
                     "    <tripinfo id=\"{}.{}\" depart=\"{:.2f}\" departLane=\"{}\" departPos=\"{:.2f}\" "
                     "departSpeed=\"{:.2f}\" departDelay=\"-1\" arrival=\"{:.2f}\" arrivalLane=\"{}\" "
                     "arrivalPos=\"{:.2f}\" arrivalSpeed=\"{:.2f}\" duration=\"{:.2f}\" routeLength=\"{:.2f}\" "
                     "waitingTime=\"{:.2f}\" waitingCount=\"{}\" stopTime=\"0.00\" timeLoss=\"{:.2f}\" "
                     "rerouteNo=\"0\" devices=\"\" vType=\"{}\" speedFactor=\"{:.2f}\" vaporized=\"\"/>\n",
                     id, trip.number, trip.depart.time_s, lanes::SumoLaneOf(model.graph(), trip.depart.track),
                     trip.depart.front_m, trip.depart.speed_mps, time_s,
                     lanes::SumoLaneOf(model.graph(), trip.last.track), trip.last.front_m, trip.last.speed_mps,
                     time_s - trip.depart.time_s, trip.last.odometer_m - trip.depart.odometer_m, trip.waiting_s,
                     trip.waits, trip.loss_s, NameOf(model.traits(id).kind), model.traits(id).speed_factor);
}

std::string TripInfos::At(double time_s, const TrafficModel& model) {
  std::string text;
  trips_.resize(model.vehicles());
  for (std::uint32_t id = 0; id < trips_.size(); ++id) {
    Trip& trip = trips_[id];
    const Agent& agent = model.agent(id);
    const bool same = agent.on_road && trip.is_there && agent.trip == trip.number;
    if (trip.is_there && !same && !agent.is_crashed) {
      if (trip.is_whole) Write(text, time_s, model, id);
      trip.is_there = false;
    }
    if (!agent.on_road) continue;
    const Piece& piece = PieceAt(agent.path, agent.o_m);
    const double d_m = agent.o_m - piece.zero_m;
    const Place now{time_s, agent.o_m, d_m + 0.5 * model.traits(id).length_m, agent.speed_mps, piece.track};
    if (!trip.is_there) {
      trip = Trip();
      trip.is_there = true, trip.is_whole = began_, trip.number = agent.trip, trip.depart = now;
    } else {
      const double passed_s = time_s - trip.last.time_s,
                   free_mps = model.FreeSpeed_mps(piece.track, d_m) * model.traits(id).speed_factor;
      const bool waits = agent.speed_mps < kWaiting_mps;
      if (waits) trip.waiting_s += passed_s;
      if (waits && !(trip.last.speed_mps < kWaiting_mps)) ++trip.waits;
      if (free_mps > 0.0) trip.loss_s += std::max(0.0, passed_s - (agent.o_m - trip.last.odometer_m) / free_mps);
    }
    trip.last = now;
  }
  began_ = true;
  return text;
}

}  // namespace rodeira::traffic
