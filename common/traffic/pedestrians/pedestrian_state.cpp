// SPDX-License-Identifier: Apache-2.0
// What is saved of people on foot.
#include <algorithm>

#include "common/traffic/pedestrians/pedestrians.hpp"

namespace rodeira::traffic {

void Pedestrians::Person::Save(base::StateWriter& writer) const {
  writer.Put("present", present);
  writer.Put("walks", walks);
  writer.Put("is_hit", is_hit);
  writer.Put("crossing", crossing);
  writer.Put("side", side);
  writer.Put("number", number);
  writer.Put("trip", trip);
  writer.Put("u_m", u_m);
  writer.Put("speed_mps", speed_mps);
  writer.Put("gone_m", gone_m);
  writer.Put("waited_s", waited_s);
}

void Pedestrians::Person::Restore(base::StateReader& reader) {
  reader.Get("present", present);
  reader.Get("walks", walks);
  reader.Get("is_hit", is_hit);
  reader.Get("crossing", crossing);
  reader.Get("side", side);
  reader.Get("number", number);
  reader.Get("trip", trip);
  reader.Get("u_m", u_m);
  reader.Get("speed_mps", speed_mps);
  reader.Get("gone_m", gone_m);
  reader.Get("waited_s", waited_s);
}

void Pedestrians::Count::Save(base::StateWriter& writer) const {
  writer.Put("arrived", arrived);
  writer.Put("left", left);
  writer.Put("flowed", flowed);
  writer.Put("next_ns", next_ns);
  writer.Put("waited_s", waited_s);
  writer.Put("let_go", let_go);
}

void Pedestrians::Count::Restore(base::StateReader& reader) {
  reader.Get("arrived", arrived);
  reader.Get("left", left);
  reader.Get("flowed", flowed);
  reader.Get("next_ns", next_ns);
  reader.Get("waited_s", waited_s);
  reader.Get("let_go", let_go);
}

void Pedestrians::Save(base::StateWriter& writer) const {
  for (const Count& count : counts_) writer.Put("crossing", count);
  writer.Put("people", static_cast<std::uint32_t>(people_.size()));
  for (const Person& person : people_) writer.Put("person", person);
}

void Pedestrians::Restore(base::StateReader& reader) {
  constexpr std::uint32_t kMost = 1'000'000;
  for (Count& count : counts_) reader.Get("crossing", count);
  std::uint32_t people = 0;
  reader.Get("people", people);
  people_.assign(std::min(people, kMost), {});
  for (Person& person : people_) {
    reader.Get("person", person);
    if (person.crossing >= crossings().size() || person.side > 1) person = Person();
  }
  OrderAll();
}

}  // namespace rodeira::traffic
