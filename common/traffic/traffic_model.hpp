// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/core/base/thread_pool.hpp"
#include "common/driving/driver/footprint.hpp"
#include "common/traffic/demand/demand.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/motors/motors_driver.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/pedestrians/pedestrians.hpp"
#include "common/traffic/pedestrians/yielding.hpp"
#include "common/traffic/perception/occupancy.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/results/agent_detail.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/right_of_way/zone_book.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "common/world/lanes/zones.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::traffic {

// Cars on the lanes of a network: each draws its way at every branch, follows whoever is ahead on it with the IDM, at
// the speed that limits, bends and crests allow, and enters a stretch that other ways cross only when all of it up to
// the next place to stand is its own (docs/explanation/traffic.md). A car that reaches the end of its last lane leaves
// and enters again, by lot, where traffic enters the network, as soon as there is a safe gap: their number never
// changes, and none is moved or removed elsewhere. With flows (DemandSettings) they come as those say, with a route
// or without, and are gone at the end of their way. They see other vehicles (the driver's car) by their rectangles,
// wherever they are. On roads of several lanes they change lanes where that brings them on (MOBIL). Nothing here
// depends on order of arrival, threads or the clock: the state is Save's, and each step is a function of it and of
// `others`.
class TrafficModel {
 public:
  // Places the agents on all lanes, clear of `others`; who finds no room waits to enter. Wrong input where there should
  // be vehicles and the world has no lane.
  static base::Result<TrafficModel> Make(const TrafficSettings& settings, std::shared_ptr<const road::World> world,
                                         std::span<const driver::Footprint> others);
  static base::Result<TrafficModel> Make(const TrafficSettings& settings,
                                         std::shared_ptr<const network::Network> network,
                                         std::span<const driver::Footprint> others);

  void Step(double dt_s, std::span<const driver::Footprint> others);

  // A scenario's commands, from the next step on until the agent leaves the road or is released. An agent that waits to
  // enter obeys when it has entered.
  void Brake(std::uint32_t id,
             double deceleration_mps2);  // at exactly this rate down to rest, and stay; harder where it must
  void CapSpeed(std::uint32_t id, double speed_mps);  // never faster
  // Once, as soon as the plan of overtaking allows it, without being held up first, or, on a road of several lanes, as
  // soon as the lane beside is free.
  void TellToPass(std::uint32_t id);
  // Once, to the lane on its left (+1) or right (-1), as soon as marks, road and safety allow it, whatever it brings.
  void TellToChange(std::uint32_t id, int side);
  void Release(std::uint32_t id);  // forgets all that
  // One of the settings' `scripted` comes onto a lane (ROAD:LANE), with its middle at a station of the road, no faster
  // than asked and than lets it stop before what is ahead: in this step's end, or the first one in which there is room
  // for it. Wrong input with a sentence where there can never be room; false where it is on the road already, or waits
  // to be.
  base::Result<bool> LetAppear(std::uint32_t id, const std::string& lane, double s_m, double speed_mps);
  // Whether it ever could; Wrong input as LetAppear's.
  base::Status CheckAppear(std::uint32_t id, const std::string& lane, double s_m) const;
  bool IsAppearing(std::uint32_t id) const;
  // An impulse on an agent's body, N s, at a point, both in W: from then on it drives no more, but slides on locked
  // wheels and stays where it comes to rest, an obstacle to all others. A push that would change its speed by less than
  // 1 mm/s is nothing to it as long as it drives; nothing happens to who is not there.
  void Strike(std::uint32_t id, const Eigen::Vector2d& impulse_Ns, const Eigen::Vector2d& point_W);
  // The next agent in front of this rectangle, in the lane on which its middle stands and whose way it faces, or
  // further on the way, and within sight; nothing where none is. One of the agents itself (by its id) is not in front
  // of itself.
  std::optional<std::uint32_t> AheadOf(const driver::Footprint& other) const;

  // Those on the road, driving or struck, by ascending id.
  const std::vector<AgentPose>& poses() const { return poses_; }
  const AgentTraits& traits(std::uint32_t id) const { return traits_[id]; }
  const Agent& agent(std::uint32_t id) const { return agents_[id]; }
  // MOTORS' driver of an agent; null where others drive.
  const MotorsDriver* motors(std::uint32_t id) const { return motors_.empty() ? nullptr : &motors_[id]; }
  // The cars with full physics, one a place by id; null in planar mode.
  const FullCars* full() const { return full_ ? &*full_ : nullptr; }
  std::size_t on_road() const { return poses_.size(); }
  std::size_t vehicles() const { return agents_.size(); }
  std::size_t waiting() const { return waiting_.size(); }
  // Of each flow: how many have arrived, and how many of those have been given a vehicle (fewer only where all
  // `vehicles` are in use). Given = waiting to enter + on the road + ended, always (without those whom a scenario lets
  // appear).
  struct FlowCount {
    std::uint32_t arrived = 0, given = 0;
    std::int64_t next_ns = -1;  // when the next one arrives; below 0: none does
  };
  const std::vector<FlowCount>& flows() const { return flows_; }
  std::uint64_t ended() const { return ended_; }
  // How often somebody did not get over to the lane that his route goes on from.
  std::uint64_t missed() const { return missed_; }
  // Those on foot; null where the settings have no `pedestrians`. All other numbers here count vehicles alone.
  const Pedestrians* people() const { return people_ ? &*people_ : nullptr; }
  // One more comes to the crossing of a road nearest to a station, from the road's left or right, at once. Wrong input
  // where there is none, or the settings have no `pedestrians`.
  base::Status CallPedestrian(std::string_view road, double s_m, bool from_left);
  base::Status CheckCall(std::string_view road, double s_m) const;  // whether somebody can be called there
  // Who has been hit, by his number, stays where he is.
  void HitPedestrian(std::uint32_t id);
  // From its front bumper to who is ahead, as it was seen in the last step; 1e9 where nobody is in sight.
  double GapAhead(std::uint32_t id) const { return ahead_[id].gap_m; }
  // Whether who stands has where to go, as it was seen in the last step: nobody within 5 m before it or, where it
  // stands at a line before conflict zones, none up to where it would stand behind them.
  bool RoomAhead(std::uint32_t id) const;
  // Whether its driver braked in an emergency in the last step (docs/explanation/traffic.md).
  bool Hurries(std::uint32_t id) const { return hurries_[id] != 0; }
  // Which lights it shows, bits as in vehicle.idl: brake 1, left 2, right 4. Who changes lanes, or is to turn within 30
  // m or three seconds, indicates; in a roundabout only who leaves it.
  std::uint32_t LightsOf(const AgentPose& pose) const;
  // Of those on the road, in the order of poses().
  std::vector<AgentDetail> Details();
  // By the network's controllers: what their lights show. Those without times are dark, and show red here.
  const std::vector<network::LightColour>& colours() const { return colours_; }
  // What limit, bends, crests and descents of this track let somebody drive there whom nobody is in the way of.
  double FreeSpeed_mps(std::uint32_t track, double d_m) const { return map_->plans[track].plan.At(d_m).speed_mps; }
  const lanes::Graph& graph() const { return map_->graph; }
  const lanes::Zones& zones() const { return map_->zones; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  static constexpr double kNoBarrier_m = 1e18, kFree_mps2 = 1e3;
  static constexpr double kYieldingShare =
      0.75;  // of the comfortable braking, for people on foot: who follows brakes harder

  static base::Result<TrafficModel> Make(const TrafficSettings& settings,
                                         std::shared_ptr<const network::Network> network,
                                         std::span<const driver::Footprint> others,
                                         std::shared_ptr<const road::World> world);

  TrafficModel(const TrafficSettings& settings, std::shared_ptr<const TrafficMap> map);

  // tell(id) for all that drive, by several threads: it may write what is that agent's alone, and read what nobody
  // writes meanwhile (each_driving.hpp).
  template <class Tell>
  void EachDriving(const Tell& tell);

  // Sight: who is where.
  void See(std::span<const driver::Footprint> others);
  void BeSeen(std::uint32_t id);
  void Part(std::uint32_t track);
  std::span<const lanes::Parting> PartingsOf(std::uint32_t track) const;
  void LookAhead();
  void FindStretches(std::uint32_t id, double range_m);
  Stretch StretchOn(std::uint32_t track, double zero_m, double begin_m, double end_m, bool changes) const;
  bool KeepStretches(std::uint32_t id, double far_m);
  bool SeesTo(std::uint32_t id, double odometer_m) const;
  void LookBelow(std::uint32_t id);
  PathFrame FrameOf(std::uint32_t id, double odometer_m) const;  // of its path
  double LengthOf(std::uint32_t id, std::uint32_t track) const {
    return below_[id].track == track ? below_[id].length_m : graph()[track].length_m();
  }
  bool GoesOn(std::uint32_t id, std::uint32_t track) const {
    return below_[id].track == track ? below_[id].goes_on : !graph()[track].next.empty();
  }
  bool HasBeside(std::uint32_t id, std::uint32_t track) const;
  void SeeOthers(std::span<const driver::Footprint> others);
  std::span<const Block> BlocksOn(std::uint32_t track) const {
    return any_block_ ? std::span<const Block>(blocks_[track]) : std::span<const Block>();
  }
  // The leader, with the gap to it: the next vehicle on the agent's way.
  Ahead FindAhead(std::uint32_t id) const;
  const lanes::Link& NextLink(std::uint32_t id, std::uint32_t track, Choice& choice) const;
  const Route* RouteOf(const Agent& agent) const;
  double SightOf(const Agent& agent) const;

  // Changes to the lane beside.
  void ChangeLanes(std::int64_t step_ns);
  std::optional<Sideways> Weigh(std::uint32_t id, int side, bool told = false);
  bool MayLeaveLane(std::uint32_t id) const;
  int ToldSide(std::uint32_t id) const;
  void ChangeAsTold(std::uint32_t id, int side);
  std::optional<Piece> PieceBeside(std::uint32_t id, int side) const;
  bool IsPlain(std::uint32_t id, double from_m, double to_m) const;
  bool MayCross(std::uint32_t id, int side, double from_m, double to_m) const;
  double LaneEnds(std::uint32_t id) const;
  double RouteEnds(std::uint32_t id) const;
  int FewerChanges(std::uint32_t id, std::uint32_t track) const;
  Behind FindBehind(std::uint32_t id, std::uint32_t track, double middle_m, double rear_m) const;
  double FollowerDoes(const Behind& behind, bool any, double gap_m, double leader_mps) const;
  double Following(std::uint32_t id, double limit_mps, bool any, double gap_m, double leader_mps) const;
  double Limit_mps(std::uint32_t id, std::uint32_t track, double d_m) const;
  void BeginChange(std::uint32_t id, Sideways&& way);
  bool IsItsTurn(std::uint32_t id, std::int64_t step_ns) const;
  bool ThinksOfLanes(std::uint32_t id, std::int64_t step_ns) const;
  void AppearOnLaneLeft(std::uint32_t id);
  std::optional<std::uint32_t> LaneLeft(std::uint32_t id, const Stretch& stretch, double odometer_m) const;

  // Overtaking on the lane of oncoming traffic.
  void Overtake(std::int64_t step_ns);
  void FaceOncoming(std::uint32_t id);
  bool IsHeldUp(std::uint32_t id) const;
  std::optional<Piece> PieceOut(std::uint32_t id, double top_mps) const;
  void ThinkOfOvertaking(std::uint32_t id);
  std::optional<Piece> WeighOvertaking(std::uint32_t id, Overtaking& way);
  bool MayOvertake(std::uint32_t id, double to_m, double aside_m) const;
  bool HasRoomBefore(std::uint32_t id, const Overtaking& way, const PassPlan& plan, double top_mps);
  PassCase CaseOf(std::uint32_t id, const Ahead& passed, double top_mps, double aside_m, double to_m) const;
  double TopSpeed(std::uint32_t id, double from_m, double to_m) const;
  Oncoming FindOncoming(std::uint32_t id) const;
  std::optional<Ahead> FindPassed(std::uint32_t id) const;
  void DriveOvertaking(std::uint32_t id);
  bool MayGoBack(std::uint32_t id, bool behind) const;
  void GoBack(std::uint32_t id);
  bool IsPassed(const Overtaking& overtaking, double front_m, std::int64_t id, std::int64_t body, double gap_m) const;
  double WantedBeside(std::uint32_t id, double wanted_mps2) const;
  driver::IdmSettings IdmOf(std::uint32_t id) const;
  double WantedFacing(std::uint32_t id, double limit_mps) const;
  double WantedCourteous(std::uint32_t id, double limit_mps) const;

  // Right of way.
  void Arbitrate(double dt_s);
  void ComeToLine(std::uint32_t id, double dt_s);
  void FindPassage(std::uint32_t id);
  bool KeepPassage(std::uint32_t id);
  void FindCrossings(std::uint32_t id);
  void FetchZones(std::size_t id) const;
  void HoldZones(std::uint32_t id);
  template <class Tell>
  void EachAhead(std::uint32_t id, double to_m, int depth, const Tell& tell);
  double ReachOf(std::uint32_t id, int depth);
  double ReachBehindThose(std::uint32_t id, double to_m, int depth);
  void FindRoom(std::uint32_t id);
  bool LeavesInTime(std::uint32_t id, std::uint32_t other, double way_m) const;
  void TellComing(std::uint32_t id);
  void AskForZones();
  void ComeToZones(std::uint32_t id);
  double ArrivesAt(const Comer& comer) const;
  double ClearsAt(const Comer& comer) const;
  double ComesWithin(const Comer& comer, double way_m) const;
  void ComeLater(std::uint32_t id);
  void OthersAtZones();
  bool RoomBehind(std::uint32_t id, const Crossing& crossing, const Holder& holder);
  bool TakesRoom(const Crossing& crossing) const;
  bool Held(std::uint32_t id, const Crossing& crossing, bool heeded);
  bool IsHeld(std::uint32_t id, bool heeded = false);
  bool Yields(std::uint32_t id, const Crossing& crossing);
  bool Grant(std::uint32_t id, bool yields);
  template <class Tell>
  void EachBefore(std::uint32_t id, const Tell& tell) const;
  template <class Tell>
  void EachLeaves(std::uint32_t id, const Tell& tell) const;
  void YieldInZones(std::uint32_t id);
  std::int64_t KeptInZonesBy(std::uint32_t id) const;
  double MergingGap(std::uint32_t id, double out_m, const Holder& before) const;
  double FollowComing(std::uint32_t id, std::uint32_t leader, double gap_m) const;
  bool MayFollow(std::uint32_t id, const Crossing& crossing, const Holder& holder) const;
  bool IsFarEnough(std::uint32_t id, const Crossing& crossing, const Comer& comer, double comes_s,
                   double clears_s) const;
  void ResolveDeadlocks();
  std::int64_t WaitsFor(std::uint32_t id) const;
  std::vector<std::uint32_t> CircleOf(std::uint32_t start, std::vector<std::uint8_t>& seen) const;
  bool IsAtLine(std::uint32_t id) const;
  bool AreInOneAnothersWay(std::span<const std::uint32_t> some) const;
  bool LetIn(const std::vector<std::uint32_t>& circle);
  void OpenCircle(std::vector<std::uint32_t> circle);
  bool GiveBack(std::uint32_t id);
  bool IsGreen(std::int64_t light) const {
    return colours_[static_cast<std::size_t>(light)] == network::LightColour::kGreen;
  }
  double RedAhead(std::uint32_t track, double from_m, double speed_mps) const;
  bool AllGreen(std::uint32_t id, double from_m, double to_m) const;
  void ObeyLights(std::uint32_t id);
  bool Urgent(std::uint32_t id) const;
  double AllowedAt(std::uint32_t id, double odometer_m) const;
  double KnowAllowedAt(std::uint32_t id, double odometer_m, std::size_t place);

  // People on foot.
  void LookAtPeople(double dt_s);
  void CarsAtCrossings();
  void OthersAtCrossings();
  bool LightsLetGo(const lanes::FootCrossing& crossing) const;
  void Yield(double dt_s);
  double AtMostForPeople(std::uint32_t id) const;
  bool NearCrossing(std::uint32_t track, double low_m, double high_m) const;
  double StoppingWay(std::uint32_t id) const;

  // MOTORS' driver.
  void StartMotors();
  Eigen::Vector2d MotorsPoint(const MotorsDriver& driver, std::uint32_t index) const;
  std::uint32_t MotorsPoints(const MotorsDriver& driver) const;
  void TakeLane(std::uint32_t id, const Piece& piece);
  void FollowTrajectory(std::uint32_t id);
  // The point that he looks to, two seconds of way on and not beyond the lane's end, and its angle from where his car
  // points.
  Eigen::Vector2d MotorsLooksAt(std::uint32_t id) const;
  double MotorsTurn_rad(std::uint32_t id, const Eigen::Vector2d& look_W) const;
  void GiveWay();
  void DriveMotors(std::uint32_t id, double dt_s);

  // Driving.
  void Decide(double dt_s);
  double Wanted(std::uint32_t id) const;
  double LimitOn(std::uint32_t track, double d_m) const;
  double Desired_mps(std::uint32_t id) const;
  driver::SpeedPlan::Allowed Allowed(std::uint32_t id, double odometer_m) const;
  double WantedByPlan(std::uint32_t id, const driver::SpeedPlan::Allowed& here) const;
  double Cap_mps(std::uint32_t id) const { return std::min(agents_[id].cap_mps, traits_[id].top_mps); }
  double StopAt(std::uint32_t id, double odometer_m, double share = 1.0) const;
  double Smoothed(std::uint32_t id, double wanted_mps2, double dt_s);
  void StartFull(std::shared_ptr<ground::Ground> ground);
  base::Status PlaceFull(std::uint32_t id);
  void MovePlanar(std::uint32_t id, double wanted_mps2, double dt_s);
  void DriveFull(std::uint32_t id, double wanted_mps2, double dt_s);
  void FollowFull(std::uint32_t id, double dt_s);
  void FetchBend(std::size_t id) const;
  double Advance(std::uint32_t id, double odometer_m) const;
  double Moved(std::uint32_t id, double travel_m) const;
  double FrontOf(std::uint32_t id) const { return agents_[id].o_m + 0.5 * traits_[id].length_m; }  // odometer
  double HalfBase(std::uint32_t id) const { return 0.5 * traits_[id].wheelbase_m; }                // of the odometer
  std::uint32_t Follow(std::uint32_t id);
  bool AtTheEnd(std::uint32_t id) const;
  void SlideStruck(double dt_s);

  // Coming and going.
  void PlaceAll(std::span<const driver::Footprint> others);
  void Leave(std::uint32_t id);
  bool has_flows() const { return !flows_.empty(); }
  void BeginFlows();
  void Arrive(std::int64_t until_ns);
  void Begin(std::uint32_t id, std::uint32_t flow, std::uint32_t arrival);
  AgentTraits TraitsFor(std::uint32_t id) const;
  std::uint32_t DrawEntry(std::uint32_t id, std::uint32_t trip) const;
  double AtMostForLine(std::uint32_t id);
  // A vehicle that waits for room in the middle of a lane.
  struct Appearing {
    std::uint32_t id = 0, track = 0;
    double d_m = 0.0, speed_mps = 0.0;
  };
  base::Status CheckPlace(std::uint32_t id, std::uint32_t track, double d_m) const;
  base::Result<std::pair<std::uint32_t, double>> PlaceToAppear(std::uint32_t id, const std::string& lane,
                                                               double s_m) const;
  bool IsClearFor(const Appearing& next) const;
  bool IsTakenUp(std::uint32_t id) const;
  bool TryAppear(const Appearing& next);
  void AppearAll();
  void Enter();
  bool TryEnter(std::uint32_t id);
  bool IsAmongOthers(std::uint32_t track) const;
  bool IsExpected(std::uint32_t track, double gap_m) const;
  bool TakeFirstZones(std::uint32_t id);
  void FindColours();
  void FindPoses();
  const lanes::Curve::Straight* StraightBelow(std::uint32_t id) const;
  AgentPose PoseOf(std::uint32_t id) const;
  AgentPose PoseOfStruck(std::uint32_t id) const;
  double HeightAt(const Struck& struck, double near_z_m) const;

  TrafficSettings settings_;
  std::shared_ptr<const TrafficMap> map_;
  std::shared_ptr<base::ThreadPool> pool_;  // null: one thread
  std::vector<AgentTraits> traits_;
  std::vector<Agent> agents_;
  std::optional<FullCars> full_;      // none: planar
  std::vector<MotorsDriver> motors_;  // by agent; empty where others drive
  std::optional<Pedestrians> people_;
  std::vector<Yielding> yielding_;      // by agent; empty without people
  double longest_half_m_ = 0.0;         // of all agents
  std::vector<std::uint32_t> waiting_;  // to enter, first come first
  std::vector<Appearing> appearing_;    // first told first
  std::uint64_t next_grant_ = 1;
  std::vector<FlowCount> flows_;
  std::uint64_t ended_ = 0, missed_ = 0;  // trips; lanes for routes
  std::int64_t time_ns_ = 0;              // since the beginning
  std::vector<AgentPose> poses_;
  std::vector<driver::Footprint>
      bodies_;  // what agents see that does not drive as they do: other vehicles, and who has been struck

  // Found anew each step.
  std::vector<network::LightColour> colours_;  // by controller
  std::vector<Stretches> stretches_;           // by agent
  std::vector<WayKey> way_keys_;               // by agent
  std::vector<std::uint32_t> ways_;            // by agent: of the way in stretches_, another one whenever that changes
  std::vector<Below> below_;                   // by agent; the map alone says it, so that it is never wrong
  Occupancy occupants_;                        // of agents
  std::vector<std::uint8_t> parts_;            // by track: somebody is on one that parts from it
  std::vector<std::vector<Block>> blocks_;     // by track
  std::vector<std::vector<Facing>> facing_;    // by track
  bool any_block_ = false, any_facing_ = false;  // on whatever track
  bool any_overtaking_ = false;                  // is somebody
  std::vector<std::uint8_t> is_overtaken_;       // by agent
  std::vector<std::uint8_t> beside_, passes_;    // by agent: it may think of another lane, of overtaking
  std::vector<Ahead> ahead_;                     // by agent
  std::vector<Passage> passages_;                // by agent
  std::vector<std::array<PlannedAt, 2>> known_;  // by agent: at the beginning and the end of its passage; the map alone
                                                 // says it, so that it is never wrong
  std::vector<double> reaches_;        // by agent: how far its front comes whatever others decide; below 0 not yet told
  std::vector<double> wanted_;         // by agent: acceleration
  std::vector<std::uint8_t> hurries_;  // by agent: brakes in an emergency
  std::vector<std::uint32_t> missed_now_;  // by agent
  std::vector<std::uint8_t> ends_;         // by agent: has come to the end of its last lane
  std::vector<AgentPose> moved_;           // by agent: where the step has brought it …
  std::vector<std::uint8_t> is_moved_;     // … if that is known, and it has not left or been struck since
  std::vector<double> leaves_;             // by agent: acceleration that who holds its zones before it leaves it
  std::vector<double> bars_;               // by agent: odometer at which it waits for people on foot
  std::vector<Eigen::Vector2d> segments_;  // by agent: where MOTORS' driver looks to
  std::vector<AtCrossing> at_crossings_;   // by crossing for people on foot
  std::vector<ToCrossing> to_crossings_;
  ZoneBook book_;                           // who has or wants each zone
  std::vector<std::uint8_t> is_asked_;      // by 2 zone + side: somebody asks who comes there
  std::vector<std::uint32_t> asked_sides_;  // … of which he does
  std::vector<std::uint32_t> coming_;       // agents with zones before them, ascending
  std::vector<std::uint32_t> heads_;  // of them who must know now, and nobody before them at their line does, ascending
  std::vector<std::uint32_t> held_up_;  // agents who hold zones and stand, ascending
  std::vector<std::uint32_t> order_;    // of them who may ask to be let in, in the order in which they are looked at
  Lists<std::uint32_t> present_;        // by track: agents on it while others enter
  std::vector<std::uint8_t> at_entry_;  // by agent: is on a track where somebody may begin his way
  std::vector<std::uint8_t> expected_;  // by track: somebody is on the way to its beginning while others enter
};

}  // namespace rodeira::traffic
