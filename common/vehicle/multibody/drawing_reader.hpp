// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "common/core/config/config.hpp"
#include "common/vehicle/multibody/drawing.hpp"

namespace rodeira::multibody {

struct SpringLaw;

// Reads the parts of a mechanism from a mapping: points, vectors, angles, distances, bodies, markers, constraints,
// forces (docs/reference/mechanism-files.md). Problems stay in the file's collection; the drawing is good only where
// there are none. Afterwards it answers what a name means, for what else a file says about the mechanism.
class DrawingReader {
 public:
  explicit DrawingReader(const config::Map& root);

  const Drawing& drawing() const { return drawing_; }
  // Each adds a problem at the key where the name is not known, and gives nothing.
  std::optional<int> Entity(const config::Map& map, std::string_view key, const std::string& name, bool scalar) const;
  std::optional<Form> Point(const config::Map& map, std::string_view key, const std::string& name) const;
  std::optional<int> Body(const config::Map& map, std::string_view key) const;
  std::optional<int> LoadNamed(const config::Map& map, std::string_view key) const;
  // [u] or [P, Q] under the key.
  std::optional<Form> Direction(const config::Map& map, std::string_view key) const;
  Vector3d Drawn(const Form& form) const { return Evaluate(form, at_.data()); }

 private:
  struct Coordinate {
    int entity = 0;
    int component = 0;
  };
  static Vector3d ThreeNumbers(const config::Map& map, std::string_view key, double most);

  void ReadPoints(const config::Map& root);
  void ReadVectors(const config::Map& root);
  void ReadBodies(const config::Map& root);
  void ReadBody(const config::Map& bodies, const std::string& name);
  void ReadMarkers(const config::Map& root);
  void ReadAngles(const config::Map& root);
  void ReadDistances(const config::Map& root);
  void ReadConstraints(const config::Map& root);
  void ReadConstraint(const config::Map& constraints, const std::string& name);
  void ReadForces(const config::Map& root);
  std::shared_ptr<Load> ReadForce(const config::Map& map, const std::string& kind);
  std::shared_ptr<Load> ReadSpring(const config::Map& map, bool torsion);
  std::shared_ptr<Load> ReadAntiRollBar(const config::Map& map);
  std::shared_ptr<Load> ReadBushing(const config::Map& map);

  int AddEntity(const config::Map& map, const std::string& name, EntityKind kind, const Vector3d& at);
  bool IsNew(const config::Map& map, const std::string& name);
  std::optional<Coordinate> CoordinateNamed(const config::Map& map, std::string_view key,
                                            const std::string& name) const;
  std::optional<std::array<Form, 2>> TwoPoints(const config::Map& map, std::string_view key) const;
  Law ReadLaw(const config::Map& map, std::string_view value_key) const;
  std::vector<std::string> NamesOf(bool points, bool vectors, bool scalars) const;

  bool planar_ = false;
  Drawing drawing_;
  std::vector<double> at_;          // drawn coordinates
  std::vector<std::string> names_;  // of entities
  std::map<std::string, int, std::less<>> entities_;
  std::map<std::string, Form, std::less<>> markers_;
  int world_x_ = 0, world_y_ = 0;  // fixed vectors
};

}  // namespace rodeira::multibody
