// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "common/core/config/declared.hpp"
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
  // A point or a marker.
  std::optional<Form> Point(const config::Map& map, std::string_view key, const std::string& name) const;
  // The index in Drawing::bodies, or in Drawing::loads.
  std::optional<int> Body(const config::DeclaredMap& map, std::string_view key) const;
  std::optional<int> LoadNamed(const config::DeclaredMap& map, std::string_view key) const;
  // [u] or [P, Q] under the key.
  std::optional<Form> Direction(const config::DeclaredMap& map, std::string_view key) const;
  // The form's value at the drawn position.
  Vector3d Drawn(const Form& form) const { return Evaluate(form, at_.data()); }

 private:
  struct Coordinate {
    int entity = 0;
    int component = 0;
  };
  // Zero, and a problem, if there are not three.
  static Vector3d ThreeNumbers(const config::DeclaredMap& map, std::string_view key);

  void ReadPoints(const config::DeclaredMap& root);
  void ReadVectors(const config::DeclaredMap& root);
  void ReadBodies(const config::DeclaredMap& root);
  void ReadBody(const config::Map& bodies, const std::string& name, const config::DeclaredMap& found);
  void ReadMarkers(const config::DeclaredMap& root);
  void ReadAngles(const config::DeclaredMap& root);
  void ReadDistances(const config::DeclaredMap& root);
  void ReadConstraints(const config::DeclaredMap& root);
  void ReadConstraint(const config::DeclaredMap& found, const std::string& name);
  void ReadForces(const config::DeclaredMap& root);
  std::shared_ptr<Load> ReadForce(const config::DeclaredMap& map, const std::string& kind);
  std::shared_ptr<Load> ReadSpring(const config::DeclaredMap& map, bool torsion);
  std::shared_ptr<Load> ReadAntiRollBar(const config::DeclaredMap& map);
  std::shared_ptr<Load> ReadBushing(const config::DeclaredMap& map);

  int AddEntity(const config::Map& map, const std::string& name, EntityKind kind, const Vector3d& at);
  bool IsNew(const config::Map& map, const std::string& name);
  std::optional<Coordinate> CoordinateNamed(const config::Map& map, std::string_view key,
                                            const std::string& name) const;
  std::optional<std::array<Form, 2>> TwoPoints(const config::DeclaredMap& map, std::string_view key) const;
  // `drawn`: the value at the beginning, with the sine, if the file does not give it.
  static Law ReadLaw(const config::DeclaredMap& map, std::string_view value_key, std::optional<double> drawn = {});
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
