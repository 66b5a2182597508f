// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/visual_world/level_bytes.hpp"

#include <cstring>
#include <type_traits>

namespace rodeira::scene {
namespace {

// One description of each type serves both directions: Writer and Reader have the same functions.
class Writer {
 public:
  template <class T>
  void One(const T& value) {
    out_.Put(value);
  }
  void One(const std::string& text) { out_.PutString(text); }
  // Elements without pointers and padding, as they lie in memory.
  template <class T>
  void Packed(const std::vector<T>& all) {
    out_.Put(static_cast<std::uint64_t>(all.size()));
    out_.PutRaw({reinterpret_cast<const std::byte*>(all.data()), all.size() * sizeof(T)});
  }
  template <class T, class Each>
  void All(const std::vector<T>& all, const Each& each) {
    out_.Put(static_cast<std::uint64_t>(all.size()));
    for (const T& one : all) each(*this, one);
  }
  base::Bytes Take() { return std::move(out_.bytes()); }

 private:
  base::ByteWriter out_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : in_(bytes) {}
  template <class T>
  void One(T& value) {
    value = in_.Get<T>();
  }
  void One(std::string& text) { text = in_.GetString(); }
  template <class T>
  void Packed(std::vector<T>& all) {
    const auto count = in_.Get<std::uint64_t>();
    if (count > in_.remaining() / sizeof(T)) return Fail();
    all.resize(static_cast<std::size_t>(count));
    const auto raw = in_.GetRaw(all.size() * sizeof(T));
    if (!raw.empty()) std::memcpy(static_cast<void*>(all.data()), raw.data(), raw.size());
  }
  template <class T, class Each>
  void All(std::vector<T>& all, const Each& each) {
    const auto count = in_.Get<std::uint64_t>();
    if (count > in_.remaining()) return Fail();
    all.resize(static_cast<std::size_t>(count));
    for (T& one : all) {
      each(*this, one);
      if (!in_.ok()) return;
    }
  }
  bool AtEnd() const { return in_.ok() && in_.remaining() == 0; }

 private:
  void Fail() { (void)in_.GetRaw(in_.remaining() + 1); }

  base::ByteReader in_;
};

template <class Stream, class Vector>
void PassPoint(Stream& stream, Vector& p) {
  for (Eigen::Index i = 0; i < p.size(); ++i) stream.One(p[i]);
}

static_assert(sizeof(Colour) == 3 && sizeof(Eigen::Vector3f) == 12 && sizeof(Eigen::Vector2f) == 8);

const auto kPassMesh = [](auto& stream, auto& mesh) {
  stream.One(mesh.material);
  PassPoint(stream, mesh.origin_W);
  stream.Packed(mesh.positions);
  stream.Packed(mesh.normals);
  stream.Packed(mesh.colours);
  stream.Packed(mesh.triangles);
  stream.One(mesh.face);
  stream.Packed(mesh.on_face);
  stream.One(mesh.repeats);
};

template <class Stream, class StandOf>
void PassStand(Stream& stream, StandOf& stand) {
  PassPoint(stream, stand.foot_W);
  PassPoint(stream, stand.x_W);
}

const auto kPassRepeated = [](auto& stream, auto& repeated) {
  kPassMesh(stream, repeated.model);
  stream.Packed(repeated.light);
  PassPoint(stream, repeated.origin_W);
  stream.All(repeated.places, [](auto& each, auto& place) {
    PassStand(each, place.stand);
    each.One(place.across), each.One(place.up);
    each.One(place.leaves.red), each.One(place.leaves.green), each.One(place.leaves.blue);
  });
};

template <class Stream, class Level>
void PassLevel(Stream& stream, Level& level) {
  stream.All(level.ground, kPassMesh);
  kPassMesh(stream, level.marks);
  stream.All(level.things, kPassMesh);
  stream.All(level.repeated, kPassRepeated);
  stream.All(level.models, [](auto& each, auto& model) {
    each.One(model.file);
    PassStand(each, model.stand);
  });
}

}  // namespace

base::Bytes BytesOf(const GroundLevel& level) {
  Writer writer;
  PassLevel(writer, level);
  return writer.Take();
}

std::optional<GroundLevel> LevelFrom(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  GroundLevel level;
  PassLevel(reader, level);
  if (!reader.AtEnd()) return std::nullopt;
  return level;
}

}  // namespace rodeira::scene
