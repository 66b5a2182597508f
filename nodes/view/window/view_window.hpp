// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/core/base/result.hpp"
#include "common/driving/scenario/request.hpp"
#include "nodes/view/dynamic_objects/chosen.hpp"
#include "nodes/view/dynamic_objects/driver_aims.hpp"
#include "nodes/view/frame/frame_log.hpp"
#include "nodes/view/frame/surface.hpp"
#include "nodes/view/headset/headset.hpp"
#include "nodes/view/overlays/menu.hpp"
#include "nodes/view/renderer/renderer.hpp"
#include "nodes/view/run_connection/ask_place.hpp"
#include "nodes/view/run_connection/pause_monitor.hpp"
#include "nodes/view/sound/speaker.hpp"
#include "nodes/view/view_settings.hpp"

union SDL_Event;

namespace rodeira::nodes {

// A surface with a world on it, and what the person before it chose to see. For one thread, as its surface.
class ViewWindow {
 public:
  // Everything is loaded and drawn once. `resizable`: of a window; frames are never read from one that is.
  // `help`: what h shows. The world must outlive it. Wrong input as Surface::Open.
  static base::Result<std::unique_ptr<ViewWindow>> Open(SurfaceKind kind, const ViewSettings& settings,
                                                        const road::World& world, bool resizable, std::string help);
  // The same on a surface that is open.
  static base::Result<std::unique_ptr<ViewWindow>> Open(std::unique_ptr<Surface> surface, const ViewSettings& settings,
                                                        const road::World& world, std::string help);

  // Where the person's requests go (false: it takes no more). Without one a key that asks says that none does.
  void set_ask(std::function<bool(const scenario::Request&)> ask) { ask_ = std::move(ask); }
  Surface& surface() { return *surface_; }
  Renderer& renderer() { return *renderer_; }
  // The picture changes without the world's time going on: camera, car, texts. False where the key is not the window's
  // own. `driven`: a person drives by this window, and s is the brake. `modifiers`: SDL's, of the moment of the press.
  bool TakeKey(int symbol, bool driven, int modifiers = 0);
  // The wheel brings free cameras nearer and farther; the window's own button (ViewSettings::mouse_button), held, turns
  // the one about the car; a click of it chooses the vehicle that is seen at its place, or none. Behind the placing
  // key, or with ctrl held, a click of the left button places the car instead. False where the event is not the
  // window's.
  bool TakeMouse(const SDL_Event& event);
  // Whether the person has chosen to close the window.
  bool asked_to_close() const { return asked_to_close_; }
  // Whether another picture is due although neither time nor a hand moves.
  bool is_restless() const { return menu_.is_restless(); }
  // Waits until the headset wants its next pictures; true where Show is then to draw them. False where there is none,
  // or it is not worn: the window is drawn as without one.
  bool WaitForHeadset();
  bool has_headset() const { return headset_ != nullptr; }
  // How loud what is shown is heard, from 0 to 1, where there is a device and time goes on so fast: fainter in slow
  // motion, never louder, silent where time stands, where the person switched it off, and where the settings want no
  // sound.
  double Loudness(double rate) const;
  // Draws the moment as the person wishes to see it, and shows it. `rate`: simulated seconds a second, for the
  // statistics.
  void Show(scene::SceneSnapshot moment, double rate, std::optional<Timeline> timeline = std::nullopt);

 private:
  ViewWindow(const road::World& world, const ViewSettings& settings)
      : world_(world), aims_(settings.autopilots, world), heat_(world) {}
  void OpenHeadset(const ViewSettings& settings);
  void ShowInHeadset();
  void Note(std::string note);
  void AskForPlace(int x_px, int y_px);
  void AskForStart();
  void AskForWeather(std::size_t which);
  void DrawMenu();
  void SetVolume(double volume);
  scene::Ray RayAt(int x_px, int y_px) const;
  void ChooseAt(int x_px, int y_px);
  void NextHeat();
  void GatherHeat();
  void FromAboveOrBack();
  bool Operate(bool asked);
  bool is_live() const { return shown_wall_s_ > 0.0 && !live_.timeline; }  // of a run, not of a recording

  const road::World& world_;
  std::function<bool(const scenario::Request&)> ask_;
  CarNames cars_;
  CarStarts starts_;
  CarPaints paints_;
  DriverAims aims_;
  bool placing_ = false;      // the next click says where
  bool swallows_up_ = false;  // of a button with a press that was the window's
  std::size_t weather_ = 0;   // that was asked for last
  scene::HeatMap heat_;
  std::optional<scene::HeatKind> heat_shown_;
  std::int64_t heat_laid_ns_ = 0;  // when its picture was made
  struct Before {                  // from where one went to look from above
    scene::CameraKind camera;
    scene::Aim aim;
  };
  std::optional<Before> before_above_;

  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Renderer> renderer_;  // before its surface in dying
  std::unique_ptr<Headset> headset_;    // likewise; null: none
  Menu menu_;                           // likewise
  bool asked_to_close_ = false;
  bool headset_waits_ = false;        // for pictures
  std::unique_ptr<FrameLog> log_;     // null: it is not wanted
  std::unique_ptr<Speaker> speaker_;  // null: nothing is heard
  bool has_sound_ = false;            // otherwise it was told to be silent
  double volume_ = 0.0;
  bool muted_ = false;
  std::string help_text_, title_;
  void TakePicture();
  void FollowNext(int step);
  void Follow();  // the one that the person chose, wherever it stands among the others now

  Picture live_;                                 // camera, followed car as the person chose
  std::optional<std::uint64_t> followed_agent_;  // of the traffic
  Chosen chosen_;
  std::size_t home_ = 0;  // what the window followed first: there none is chosen by key
  int mouse_button_ = kLeftButton;
  int dragged_px_ = 0;  // since that button went down
  static constexpr std::array<bool, scene::kMirrors> kNoMirrors{};
  std::array<bool, scene::kMirrors> mirrors_ = {true, true, true};  // those that the key brings back
  bool picture_wanted_ = false;
  PauseMonitor pause_monitor_;
  std::string note_;  // what the window says for a while
  double note_until_s_ = 0.0;
  bool help_ = false;
  bool statistics_ = false;
  double frame_s_ = 0.0;      // smoothed time of drawing
  double interval_s_ = 0.02;  // smoothed time from picture to picture
  double shown_wall_s_ = 0.0;
};

// What the mouse does in a window with this own button, a line each, with a line's end before each.
std::string MouseHelp(int mouse_button);
// The window's own keys, and what its button of the mouse does (0: it has none), a line each.
std::string WindowHelp(int mouse_button);

}  // namespace rodeira::nodes
