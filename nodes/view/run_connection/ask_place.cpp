// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/run_connection/ask_place.hpp"

#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/view/scene/camera/placing.hpp"

namespace rodeira::nodes {
namespace {

constexpr const char* kNoGround = "there is no ground of this world: the car stays where it is";

// Under all of the car's corners.
bool HasGround(ground::Ground& ground, const scene::CarPlace& place, const scene::CarPose& car) {
  const Eigen::Vector2d along(std::cos(place.heading_rad), std::sin(place.heading_rad)), left(-along.y(), along.x());
  for (const double forward_m : {car.front_m, car.front_m - car.length_m}) {
    for (const double aside_m : {0.5 * car.width_m, -0.5 * car.width_m}) {
      const Eigen::Vector2d at = Eigen::Vector2d(place.x_m, place.y_m) + forward_m * along + aside_m * left;
      if (!ground.At(at.x(), at.y(), place.z_m).inside) return false;
    }
  }
  return true;
}

double HeadingOf(const scene::CarPose& car) {
  const Eigen::Vector3d forward = car.q_WB * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

// The vehicle that a person's request is about.
base::Result<const scene::CarPose*> CarOf(const scene::SceneSnapshot& moment, std::size_t followed,
                                          const CarNames& names) {
  if (moment.cars.empty())
    return base::WrongInput("view.cannot_place", "there is no car to place: no node of this run drives one");
  const scene::CarPose& car = moment.cars[followed < moment.cars.size() ? followed : 0];
  if (!names.contains(car.id))
    return base::WrongInput("replay.cannot_change", "a recording cannot be changed: the car stays where it was");
  return &car;
}

}  // namespace

base::Result<scenario::Request> AskPlace(const road::World& world, const scene::SceneSnapshot& moment,
                                         std::size_t followed, const scene::Ray& ray, const CarNames& names) {
  const auto found = CarOf(moment, followed, names);
  if (!found) return found.error();
  const scene::CarPose& car = *found.value();
  const auto ground = world.MakeGround();
  const auto met = scene::GroundOn(*ground, ray);
  if (!met) return base::WrongInput("view.cannot_place", kNoGround);
  const scene::CarPlace place = scene::PlaceAt(world, *met, HeadingOf(car));
  if (!HasGround(*ground, place, car)) return base::WrongInput("view.cannot_place", kNoGround);
  return scenario::PlaceRequest({names.at(car.id), place.x_m, place.y_m, place.z_m},
                                place.heading_rad * 180.0 / base::kPi);
}

StartPlace PlaceOfStart(const road::World& world, const CarStart& own) {
  const road::StartPose& of_world = world.start();
  const bool own_place = own.x_m && own.y_m;
  const double heading_deg = own.heading_deg.value_or(own_place ? 0.0 : of_world.heading_rad * 180.0 / base::kPi);
  return {own_place ? *own.x_m : of_world.x_m, own_place ? *own.y_m : of_world.y_m, heading_deg};
}

base::Result<scenario::Request> AskStart(const road::World& world, const scene::SceneSnapshot& moment,
                                         std::size_t followed, const CarNames& names, const CarStarts& starts) {
  const auto found = CarOf(moment, followed, names);
  if (!found) return found.error();
  const auto said = starts.find(found.value()->id);
  const StartPlace start = PlaceOfStart(world, said != starts.end() ? said->second : CarStart{});
  // No height: as its own INI.
  return scenario::PlaceRequest({names.at(found.value()->id), start.x_m, start.y_m, std::nullopt}, start.heading_deg);
}

}  // namespace rodeira::nodes
