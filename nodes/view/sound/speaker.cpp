// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/sound/speaker.hpp"

#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace rodeira::nodes {
namespace {

constexpr double kLeast_s = 0.05, kMost_s = 0.30;  // kept in the queue
constexpr double kPictures = 2.5;                  // of them

// ALSA's library complains at length on standard error where there is no card: it is asked only where something may
// answer.
bool MayBeHeard() {
  if (std::getenv("SDL_AUDIODRIVER") != nullptr || std::getenv("PULSE_SERVER") != nullptr) return true;
  std::error_code problem;
  if (const char* runtime = std::getenv("XDG_RUNTIME_DIR"); runtime != nullptr) {
    for (const char* socket : {"pulse/native", "pipewire-0"}) {
      if (std::filesystem::exists(std::filesystem::path(runtime) / socket, problem)) return true;
    }
  }
  std::ifstream cards("/proc/asound/cards");
  std::string first;
  return std::getline(cards, first) && first.find("no soundcards") == std::string::npos;
}

}  // namespace

base::Result<std::unique_ptr<Speaker>> Speaker::Open() {
  if (!MayBeHeard()) return base::Failed("device.no_sound", "this PC has no sound card and no sound server");
  if (SDL_InitSubSystem(SDL_INIT_AUDIO) != 0)
    return base::Failed("device.no_sound", fmt::format("SDL has no sound: {}", SDL_GetError()));
  SDL_AudioSpec wanted{};
  wanted.freq = sound::kRate_Hz;
  wanted.format = AUDIO_F32SYS;
  wanted.channels = 2;
  wanted.samples = 512;
  std::unique_ptr<Speaker> speaker(new Speaker());
  speaker->device_ = SDL_OpenAudioDevice(nullptr, 0, &wanted, nullptr, 0);
  if (speaker->device_ == 0)
    return base::Failed("device.no_sound", fmt::format("the sound device cannot be opened: {}", SDL_GetError()));
  SDL_PauseAudioDevice(speaker->device_, 0);
  return speaker;
}

Speaker::~Speaker() {
  if (device_ != 0) SDL_CloseAudioDevice(device_);
  SDL_QuitSubSystem(SDL_INIT_AUDIO);
}

double Speaker::queued_s() const {
  return static_cast<double>(SDL_GetQueuedAudioSize(device_)) / (2.0 * sizeof(float) * sound::kRate_Hz);
}

void Speaker::Play(const sound::Heard& heard, double interval_s) {
  const double missing_s = std::clamp(kPictures * interval_s, kLeast_s, kMost_s) - queued_s();
  if (missing_s <= 0.0) return;
  samples_.resize(2 * static_cast<std::size_t>(missing_s * sound::kRate_Hz));
  synth_.Render(heard, samples_);
  SDL_QueueAudio(device_, samples_.data(), static_cast<Uint32>(samples_.size() * sizeof(float)));
}

}  // namespace rodeira::nodes
