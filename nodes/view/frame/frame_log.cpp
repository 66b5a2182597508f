// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/frame/frame_log.hpp"

#include <fmt/format.h>

namespace rodeira::nodes {

base::Result<std::unique_ptr<FrameLog>> FrameLog::Open(const std::filesystem::path& file) {
  std::ofstream out(file);
  if (!out) return base::WrongInput("file.cannot_write", "the log of frames cannot be written", file.string());
  out << "wall_s,simulated_s,x_m,y_m,z_m,eye_x_m,eye_y_m,eye_z_m\n";
  return std::unique_ptr<FrameLog>(new FrameLog(std::move(out)));
}

void FrameLog::Add(double wall_s, const scene::SceneSnapshot& moment, std::size_t followed,
                   const scene::Camera& camera) {
  const auto body = scene::BodyAt(moment, followed);
  if (!body) return;
  const Eigen::Vector3d &p = body->p_WB_W, &eye = camera.eye_W;
  file_ << fmt::format("{:.6f},{:.9f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", wall_s,
                       static_cast<double>(moment.time_ns) * 1e-9, p.x(), p.y(), p.z(), eye.x(), eye.y(), eye.z());
}

}  // namespace rodeira::nodes
