// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/data/decode/walk.hpp"
#include "idl/messages.hpp"

// The members of every message type, said by hand: an oracle for what the IDL texts say.
namespace rodeira::decode {

template <class V>
void Fields(V& v, msg::SampleHeader& m) {
  v("step", m.step()), v("time_ns", m.time_ns()), v("source", m.source()), v("incarnation", m.incarnation());
  v("state_digest", m.state_digest());
}
template <class V>
void Fields(V& v, msg::Grant& m) {
  v("grant_hash", m.grant_hash());
  v("clock_id", m.clock_id()), v("roster_hash", m.roster_hash()), v("through_step", m.through_step()),
      v("serial", m.serial());
  v("final_step", m.final_step()), v("abort", m.abort()), v("finished", m.finished()),
      v("recorded_step", m.recorded_step());
  v("resume_step", m.resume_step()), v("incarnations", m.incarnations()), v("reason", m.reason()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::Nack& m) {
  v("roster_hash", m.roster_hash()), v("from_step", m.from_step()), v("source", m.source()),
      v("requester", m.requester());
}
template <class V>
void Fields(V& v, msg::NodeHello& m) {
  v("protocol_hash", m.protocol_hash()), v("roster_hash", m.roster_hash()), v("world_hash", m.world_hash());
  v("math_library_hash", m.math_library_hash()), v("topics", m.topics());
}
template <class V>
void Fields(V& v, msg::NodeIdentity& m) {
  v("report_hash", m.report_hash()), v("node", m.node()), v("host", m.host()), v("pid", m.pid());
}
template <class V>
void Fields(V& v, msg::TopicType& m) {
  v("topic", m.topic()), v("type", m.type()), v("idl", m.idl());
}
template <class V>
void Fields(V& v, msg::Report& m) {
  v("identity", m.identity()), v("hello", m.hello()), v("clock_id", m.clock_id()), v("incarnation", m.incarnation()),
      v("phase", m.phase());
  v("progress_step", m.progress_step()), v("waiting", m.waiting()), v("waiting_source", m.waiting_source());
  v("since_ms", m.since_ms()), v("digest", m.digest()), v("steps", m.steps()), v("busy_ns", m.busy_ns()),
      v("worst_ns", m.worst_ns());
  v("server_calls", m.server_calls()), v("median_interval_ns", m.median_interval_ns()),
      v("p99_interval_ns", m.p99_interval_ns()), v("recorded_step", m.recorded_step()),
      v("granted_step", m.granted_step());
  v("granted_final", m.granted_final()), v("cannot_save", m.cannot_save()), v("message", m.message()),
      v("end", m.end());
}
template <class V>
void Fields(V& v, msg::Controls& m) {
  v("header", m.header()), v("steering_wheel_rad", m.steering_wheel_rad()), v("throttle", m.throttle()),
      v("brake", m.brake());
  v("clutch", m.clutch()), v("handbrake", m.handbrake()), v("gear", m.gear()), v("gearbox_mode", m.gearbox_mode());
  v("starter", m.starter()), v("indicators", m.indicators()), v("headlights", m.headlights()), v("horn", m.horn()),
      v("end", m.end());
}
template <class V>
void Fields(V& v, msg::GroundPointQuery& m) {
  v("x_m", m.x_m()), v("y_m", m.y_m()), v("z_hint_m", m.z_hint_m());
}
template <class V>
void Fields(V& v, msg::GroundPointAnswer& m) {
  v("z_m", m.z_m()), v("normal_x", m.normal_x()), v("normal_y", m.normal_y()), v("normal_z", m.normal_z());
  v("friction", m.friction()), v("surface", m.surface()), v("inside_world", m.inside_world());
}
template <class V>
void Fields(V& v, msg::GroundRequest& m) {
  v("requester", m.requester()), v("incarnation", m.incarnation()), v("step", m.step()),
      v("request_number", m.request_number()), v("points", m.points());
  v("end", m.end());
}
template <class V>
void Fields(V& v, msg::GroundReply& m) {
  v("requester", m.requester()), v("incarnation", m.incarnation()), v("request_number", m.request_number()),
      v("points", m.points()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::KeyState& m) {
  v("key", m.key()), v("pressed", m.pressed()), v("press_count", m.press_count());
}
template <class V>
void Fields(V& v, msg::OperatorRequest& m) {
  v("number", m.number()), v("x_m", m.x_m()), v("y_m", m.y_m()), v("value", m.value()), v("name", m.name()),
      v("argument", m.argument());
  v("end", m.end());
}
template <class V>
void Fields(V& v, msg::OperatorRequests& m) {
  v("client_id", m.client_id()), v("requests", m.requests()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::WindowKeys& m) {
  v("window_id", m.window_id()), v("number", m.number()), v("keys", m.keys()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::WallTime& m) {
  v("after_step", m.after_step()), v("through_step", m.through_step()), v("utc_ns", m.utc_ns()),
      v("monotonic_ns", m.monotonic_ns());
  v("late_ns", m.late_ns()), v("pace", m.pace()), v("paused", m.paused()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::Remark& m) {
  v("step", m.step()), v("time_ns", m.time_ns()), v("utc_ns", m.utc_ns()), v("monotonic_ns", m.monotonic_ns()),
      v("pace", m.pace());
  v("kind", m.kind()), v("text", m.text()), v("number", m.number()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::RunLog& m) {
  v("clock_id", m.clock_id()), v("number", m.number()), v("wall_times", m.wall_times()), v("remarks", m.remarks()),
      v("last", m.last()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::Trigger& m) {
  v("number", m.number()), v("step", m.step()), v("time_ns", m.time_ns()), v("utc_ns", m.utc_ns()), v("code", m.code());
  v("run", m.run()), v("text", m.text()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::Pulse& m) {
  v("header", m.header()), v("value", m.value());
}
template <class V>
void Fields(V& v, msg::ScenarioEvent& m) {
  v("name", m.name()), v("argument", m.argument()), v("value", m.value()), v("index", m.index()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::ScenarioEvents& m) {
  v("header", m.header()), v("events", m.events()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::SampleBatch& m) {
  v("consumer", m.consumer()), v("samples", m.samples()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::Snapshot& m) {
  v("header", m.header()), v("content", m.content()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::TrafficAgent& m) {
  v("id", m.id()), v("trip", m.trip()), v("position_x_m", m.position_x_m()), v("position_y_m", m.position_y_m());
  v("position_z_m", m.position_z_m()), v("speed_mps", m.speed_mps()), v("acceleration_mps2", m.acceleration_mps2());
  v("heading_rad", m.heading_rad()), v("pitch_rad", m.pitch_rad()), v("roll_rad", m.roll_rad()),
      v("length_m", m.length_m());
  v("width_m", m.width_m()), v("height_m", m.height_m()), v("wheelbase_m", m.wheelbase_m()),
      v("wheel_radius_m", m.wheel_radius_m());
  v("steer_rad", m.steer_rad()), v("wheel_spin_rad", m.wheel_spin_rad()), v("colour_rgb", m.colour_rgb());
  v("kind", m.kind()), v("lights", m.lights());
}
template <class V>
void Fields(V& v, msg::TrafficDetail& m) {
  v("id", m.id()), v("throttle", m.throttle()), v("brake", m.brake()), v("clutch", m.clutch()),
      v("engine_speed_radps", m.engine_speed_radps());
  v("fuel_rate_kgps", m.fuel_rate_kgps()), v("fuel_used_kg", m.fuel_used_kg()),
      v("target_speed_mps", m.target_speed_mps());
  v("target_x_m", m.target_x_m()), v("target_y_m", m.target_y_m()), v("path_heading_rad", m.path_heading_rad());
  v("look_ahead_x_m", m.look_ahead_x_m()), v("look_ahead_y_m", m.look_ahead_y_m()), v("gear", m.gear());
}
template <class V>
void Fields(V& v, msg::TrafficDetails& m) {
  v("header", m.header()), v("agents", m.agents()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::TrafficState& m) {
  v("header", m.header()), v("agents", m.agents()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::Contact& m) {
  v("position_x_m", m.position_x_m()), v("position_y_m", m.position_y_m()), v("position_z_m", m.position_z_m());
  v("impulse_x_newton_s", m.impulse_x_newton_s()), v("impulse_y_newton_s", m.impulse_y_newton_s()),
      v("impulse_z_newton_s", m.impulse_z_newton_s());
  v("normal_x", m.normal_x()), v("normal_y", m.normal_y()), v("normal_z", m.normal_z());
  v("penetration_m", m.penetration_m()), v("closing_speed_mps", m.closing_speed_mps()),
      v("partner_kind", m.partner_kind()), v("partner_source", m.partner_source());
  v("partner_id", m.partner_id()), v("partner_name", m.partner_name()), v("begins", m.begins()), v("index", m.index()),
      v("end", m.end());
}
template <class V>
void Fields(V& v, msg::Collisions& m) {
  v("header", m.header()), v("contacts", m.contacts()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::JointForce& m) {
  v("body", m.body()), v("point", m.point()), v("force_b_x_n", m.force_b_x_n()), v("force_b_y_n", m.force_b_y_n()),
      v("force_b_z_n", m.force_b_z_n());
}
template <class V>
void Fields(V& v, msg::SpringForce& m) {
  v("element", m.element()), v("force_n", m.force_n()), v("damper_n", m.damper_n());
}
template <class V>
void Fields(V& v, msg::JointForces& m) {
  v("header", m.header()), v("joints", m.joints()), v("springs", m.springs()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::TrafficRequest& m) {
  v("number", m.number()), v("name", m.name()), v("agent", m.agent()), v("speed_mps", m.speed_mps()),
      v("lane", m.lane()), v("station_m", m.station_m()), v("choice", m.choice()), v("roads", m.roads()),
      v("light", m.light()), v("duration_s", m.duration_s());
}
template <class V>
void Fields(V& v, msg::TrafficRequests& m) {
  v("header", m.header()), v("requests", m.requests()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::TrafficAnswer& m) {
  v("source", m.source()), v("number", m.number()), v("refused", m.refused()), v("error_id", m.error_id()),
      v("sentence", m.sentence()), v("agent", m.agent()), v("lane", m.lane()), v("station_m", m.station_m()),
      v("roads", m.roads());
}
template <class V>
void Fields(V& v, msg::TrafficAnswers& m) {
  v("header", m.header()), v("answers", m.answers()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::SignalGroup& m) {
  v("controller", m.controller()), v("colour", m.colour());
}
template <class V>
void Fields(V& v, msg::SignalsState& m) {
  v("header", m.header()), v("groups", m.groups()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::WeatherState& m) {
  v("header", m.header()), v("wetness", m.wetness()), v("rain_mmph", m.rain_mmph()),
      v("visibility_m", m.visibility_m()), v("clouds", m.clouds()), v("hour", m.hour()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::Measures& m) {
  v("header", m.header()), v("state_step", m.state_step()), v("s_m", m.s_m()), v("t_m", m.t_m()),
      v("lane_position_m", m.lane_position_m()), v("lane_width_m", m.lane_width_m()),
      v("heading_error_rad", m.heading_error_rad()), v("left_line_m", m.left_line_m()),
      v("right_line_m", m.right_line_m()), v("speed_mps", m.speed_mps()), v("speed_limit_mps", m.speed_limit_mps()),
      v("leader_gap_m", m.leader_gap_m()), v("leader_speed_mps", m.leader_speed_mps()), v("time_gap_s", m.time_gap_s()),
      v("ttc_s", m.ttc_s()), v("tlc_s", m.tlc_s()), v("leader_id", m.leader_id()), v("road", m.road()),
      v("lane", m.lane()), v("junction", m.junction()), v("valid", m.valid()), v("vehicle", m.vehicle()),
      v("end", m.end());
}
template <class V>
void Fields(V& v, msg::Vector3& m) {
  v("x", m.x()), v("y", m.y()), v("z", m.z());
}
template <class V>
void Fields(V& v, msg::Vector3f& m) {
  v("x", m.x()), v("y", m.y()), v("z", m.z());
}
template <class V>
void Fields(V& v, msg::Quaternion& m) {
  v("w", m.w()), v("x", m.x()), v("y", m.y()), v("z", m.z());
}
template <class V>
void Fields(V& v, msg::WheelState& m) {
  v("contact_b_m", m.contact_b_m()), v("contact_normal_w", m.contact_normal_w()), v("hub_b_m", m.hub_b_m()),
      v("steer_rad", m.steer_rad());
  v("spin_rad", m.spin_rad()), v("spin_radps", m.spin_radps()), v("longitudinal_n", m.longitudinal_n()),
      v("lateral_n", m.lateral_n());
  v("load_n", m.load_n()), v("slip", m.slip()), v("slip_angle_tan", m.slip_angle_tan()),
      v("brake_torque_nm", m.brake_torque_nm());
  v("drive_torque_nm", m.drive_torque_nm()), v("suspension_n", m.suspension_n()), v("damper_n", m.damper_n()),
      v("travel_m", m.travel_m());
  v("friction", m.friction()), v("surface", m.surface()), v("in_contact", m.in_contact());
}
template <class V>
void Fields(V& v, msg::VehicleState& m) {
  v("header", m.header()), v("position_w_m", m.position_w_m()), v("attitude_wb", m.attitude_wb());
  v("velocity_w_mps", m.velocity_w_mps()), v("angular_velocity_b_radps", m.angular_velocity_b_radps());
  v("steering_wheel_rad", m.steering_wheel_rad()), v("engine_speed_radps", m.engine_speed_radps()),
      v("fuel_used_kg", m.fuel_used_kg());
  v("odometer_m", m.odometer_m()), v("wheels", m.wheels()), v("acceleration_w_mps2", m.acceleration_w_mps2());
  v("angular_acceleration_b_radps2", m.angular_acceleration_b_radps2()), v("engine_torque_nm", m.engine_torque_nm());
  v("clutch", m.clutch()), v("clutch_torque_nm", m.clutch_torque_nm()), v("throttle", m.throttle()),
      v("brake", m.brake());
  v("steering_torque_nm", m.steering_torque_nm()), v("fuel_rate_kgps", m.fuel_rate_kgps()), v("drag_n", m.drag_n());
  v("length_m", m.length_m()), v("front_m", m.front_m()), v("width_m", m.width_m()), v("height_m", m.height_m());
  v("wheelbase_m", m.wheelbase_m()), v("track_front_m", m.track_front_m()), v("track_rear_m", m.track_rear_m());
  v("wheel_radius_m", m.wheel_radius_m()), v("gear", m.gear());
  v("engine_running", m.engine_running()), v("lights", m.lights()), v("horn", m.horn()),
      v("inside_world", m.inside_world()), v("end", m.end());
}
template <class V>
void Fields(V& v, msg::WorldInfo& m) {
  v("content_hash", m.content_hash()), v("name", m.name()), v("start_x_m", m.start_x_m()),
      v("start_y_m", m.start_y_m());
  v("start_heading_rad", m.start_heading_rad()), v("roads", m.roads()), v("end", m.end());
}

// Gives every member a value of its own: any bits, texts and sequences of 0 to 4 elements.
class Filler {
 public:
  explicit Filler(std::uint64_t seed) : seed_(seed) {}
  template <class T>
  void operator()(const char*, T& value) {
    Fill(value);
  }

 private:
  std::uint64_t Bits() { return base::RandomBits({seed_, count_++}); }
  void Fill(bool& value) { value = Bits() % 2 == 0; }
  void Fill(std::string& value) { value.assign(Bits() % 5, static_cast<char>('a' + Bits() % 26)); }
  template <class T>
  void Fill(T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      const std::uint64_t bits = Bits();
      std::memcpy(&value, &bits, sizeof value);
    } else {
      Fields(*this, value);
    }
  }
  template <class T>
  void Fill(std::vector<T>& values) {
    values.resize(Bits() % 5);
    for (T& value : values) Fill(value);
  }
  template <class T, std::size_t N>
  void Fill(std::array<T, N>& values) {
    for (T& value : values) Fill(value);
  }

  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

// The flat list of a message as the typed code sees it.
class Lister {
 public:
  template <class T>
  void operator()(const char* name, T& value) {
    const std::string outer = prefix_;
    prefix_ += (prefix_.empty() ? "" : ".") + std::string(name);
    List(value);
    prefix_ = outer;
  }
  std::vector<Entry> entries;

 private:
  void List(std::string& value) { entries.push_back({prefix_, value}); }
  void List(bool& value) { entries.push_back({prefix_, value}); }
  void List(std::vector<std::uint8_t>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    entries.push_back({prefix_, base::Bytes(bytes.begin(), bytes.end())});
  }
  template <class T>
  void List(T& value) {
    if constexpr (std::is_floating_point_v<T>) {
      entries.push_back({prefix_, value});
    } else if constexpr (std::is_signed_v<T>) {
      entries.push_back({prefix_, static_cast<std::int64_t>(value)});
    } else if constexpr (std::is_unsigned_v<T>) {
      entries.push_back({prefix_, static_cast<std::uint64_t>(value)});
    } else {
      Fields(*this, value);
    }
  }
  template <class T>
  void List(std::vector<T>& values) {
    Elements(values);
  }
  template <class T, std::size_t N>
  void List(std::array<T, N>& values) {
    Elements(values);
  }
  template <class Values>
  void Elements(Values& values) {
    const std::string outer = prefix_;
    for (std::size_t i = 0; i < values.size(); ++i) {
      prefix_ = outer + "[" + std::to_string(i) + "]";
      List(values[i]);
    }
    prefix_ = outer;
  }

  std::string prefix_;
};

template <class Message>
Message Filled(std::uint64_t seed) {
  Message message;
  Filler filler(seed);
  Fields(filler, message);
  return message;
}

template <class Message>
std::vector<Entry> Listed(Message& message) {
  Lister lister;
  Fields(lister, message);
  return std::move(lister.entries);
}

// Calls use(Type<Message>(), "rodeira::msg::Name") for the type of every topic.
template <class Message>
struct TypeTag {
  using type = Message;
};
template <class Use>
void ForEveryTopicType(const Use& use) {
  use(TypeTag<msg::Controls>(), "rodeira::msg::Controls");
  use(TypeTag<msg::VehicleState>(), "rodeira::msg::VehicleState");
  use(TypeTag<msg::Collisions>(), "rodeira::msg::Collisions");
  use(TypeTag<msg::JointForces>(), "rodeira::msg::JointForces");
  use(TypeTag<msg::TrafficState>(), "rodeira::msg::TrafficState");
  use(TypeTag<msg::TrafficDetails>(), "rodeira::msg::TrafficDetails");
  use(TypeTag<msg::TrafficRequests>(), "rodeira::msg::TrafficRequests");
  use(TypeTag<msg::TrafficAnswers>(), "rodeira::msg::TrafficAnswers");
  use(TypeTag<msg::SignalsState>(), "rodeira::msg::SignalsState");
  use(TypeTag<msg::WeatherState>(), "rodeira::msg::WeatherState");
  use(TypeTag<msg::Measures>(), "rodeira::msg::Measures");
  use(TypeTag<msg::ScenarioEvents>(), "rodeira::msg::ScenarioEvents");
  use(TypeTag<msg::Snapshot>(), "rodeira::msg::Snapshot");
  use(TypeTag<msg::SampleBatch>(), "rodeira::msg::SampleBatch");
  use(TypeTag<msg::Pulse>(), "rodeira::msg::Pulse");
  use(TypeTag<msg::Grant>(), "rodeira::msg::Grant");
  use(TypeTag<msg::Nack>(), "rodeira::msg::Nack");
  use(TypeTag<msg::Report>(), "rodeira::msg::Report");
  use(TypeTag<msg::GroundRequest>(), "rodeira::msg::GroundRequest");
  use(TypeTag<msg::GroundReply>(), "rodeira::msg::GroundReply");
  use(TypeTag<msg::WorldInfo>(), "rodeira::msg::WorldInfo");
  use(TypeTag<msg::WindowKeys>(), "rodeira::msg::WindowKeys");
  use(TypeTag<msg::OperatorRequests>(), "rodeira::msg::OperatorRequests");
  use(TypeTag<msg::RunLog>(), "rodeira::msg::RunLog");
  use(TypeTag<msg::WallTime>(), "rodeira::msg::WallTime");
  use(TypeTag<msg::Remark>(), "rodeira::msg::Remark");
  use(TypeTag<msg::Trigger>(), "rodeira::msg::Trigger");
}

}  // namespace rodeira::decode
