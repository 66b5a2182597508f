// SPDX-License-Identifier: Apache-2.0
// The editor with 2000 curves over a background of 8000 by 8000 pixels, drawn by the processor without a display:
// opening, pan and zoom, undo.
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "nodes/editor/editor_app.hpp"

namespace {

using namespace rodeira;
using Clock = std::chrono::steady_clock;

constexpr int kPicture_px = 8000;

// Of all threads of this process, ms.
double Processor() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double Milliseconds(Clock::time_point since) {
  return std::chrono::duration<double, std::milli>(Clock::now() - since).count();
}

// Something like a photograph: large forms with noise upon them.
std::string Photograph(const char* kind, const std::filesystem::path& path) {
  GDALAllRegister();
  const std::unique_ptr<GDALDataset> set(
      GetGDALDriverManager()->GetDriverByName("MEM")->Create("", kPicture_px, kPicture_px, 3, GDT_Byte, nullptr));
  std::vector<std::uint8_t> row(kPicture_px), noise(1 << 20), wave(kPicture_px);
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<std::uint8_t>(base::RandomBits({i}) % 24);
  for (int band = 1; band <= 3; ++band) {
    for (std::size_t x = 0; x < wave.size(); ++x)
      wave[x] = static_cast<std::uint8_t>(80.0 + 50.0 * std::sin(0.003 * static_cast<double>(x) + band));
    for (int y = 0; y < kPicture_px; ++y) {
      for (std::size_t x = 0; x < row.size(); ++x)
        row[x] = static_cast<std::uint8_t>(wave[x] + wave[static_cast<std::size_t>(y)] / 2 +
                                           noise[(x / 2 + 7919 * static_cast<std::size_t>(y)) % noise.size()]);
      if (set->GetRasterBand(band)->RasterIO(GF_Write, 0, y, kPicture_px, 1, row.data(), kPicture_px, 1, GDT_Byte, 0,
                                             0) != CE_None)
        return {};
    }
  }
  std::unique_ptr<GDALDataset>(GetGDALDriverManager()->GetDriverByName(kind)->CreateCopy(path.c_str(), set.get(), FALSE,
                                                                                         nullptr, nullptr, nullptr))
      .reset();
  return base::ReadText(path, 1u << 28).value();
}

// 1000 lanes, 2000 curves, all bent, over 800 m by 800 m.
editor::Document Map(std::string picture) {
  editor::Document document;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d at(25.0 * (i % 32) - 400.0, 25.0 * (i / 32) - 400.0);
    const auto middle = editor::CurveBetween(at, 0.0, at + Eigen::Vector2d(20.0, 12.0), 1.1);
    editor::LaneLook look;
    look.mode = static_cast<traffic_map::LaneMode>(i % 3);
    if (!editor::LaneAlong(document, middle, look)) std::abort();
  }
  if (!editor::SetPicture(document, std::move(picture), 80.0f)) std::abort();
  return document;
}

void Measure(nodes::EditorApp& app, const char* what, int frames, const std::function<void(int)>& act) {
  std::vector<double> all;
  const double processor = Processor();
  for (int i = 0; i < frames; ++i) {
    const auto begin = Clock::now();
    act(i);
    app.Frame(0);
    all.push_back(Milliseconds(begin));
  }
  std::sort(all.begin(), all.end());
  double sum = 0.0;
  for (const double one : all) sum += one;
  fmt::print(
      "{:28} {:6.1f} pictures a second; a picture: median {:.1f} ms, worst {:.1f} ms, of the processor {:.1f} ms\n",
      what, 1000.0 * frames / sum, all[all.size() / 2], all.back(), (Processor() - processor) / frames);
}

void Try(const char* kind, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "large.motors";
  {
    const auto document = Map(Photograph(kind, folder / "photo"));
    if (!traffic_map::SaveMap(document.map, file)) std::abort();
    fmt::print("{}: {} curves, a map of {:.0f} MB\n", kind, document.map.curves.size(),
               static_cast<double>(std::filesystem::file_size(file)) / 1e6);
  }
  auto window = window::Window::Open({window::Kind::kOffscreen, 1280, 800, "bench"});
  if (!window) return fmt::print("{}\n", window.error().Text());
  const double processor = Processor();
  const auto begin = Clock::now();
  nodes::EditorApp app(*window.value(), file, {});
  app.Frame(0);
  fmt::print("{:28} {:.0f} ms\n", "opened, the map is seen", Milliseconds(begin));
  bool seen = false;
  while (app.work().picture.loading() || app.wait_ms() < 100) {
    app.Frame(app.wait_ms());
    if (seen || app.work().picture.picture() == nullptr) continue;
    seen = true;
    fmt::print("{:28} {:.0f} ms\n", "the background is seen", Milliseconds(begin));
  }
  fmt::print("{:28} {:.0f} ms, of the processor {:.0f} ms\n", "in all its detail", Milliseconds(begin),
             Processor() - processor);
  auto& view = app.work().view;
  Measure(app, "standing, all of it", 60, [](int) {});
  Measure(app, "panning, all of it", 120, [&](int i) { view.Go({i < 60 ? 2.0 : -2.0, 1.0}); });
  nodes::ShowAll(app.work());
  Measure(app, "zooming in and out", 240, [&](int i) { view.Zoom(i < 120 ? 1.04 : 1.0 / 1.04, {400.0, 300.0}); });
  view.metres_per_px = 0.1;
  Measure(app, "panning, pixel by pixel", 240, [&](int i) { view.Go({i < 120 ? 3.0 : -3.0, 1.0}); });
  nodes::ShowAll(app.work());
  auto& session = app.work().session;
  Measure(app, "a handle dragged, all of it", 60, [&](int i) {
    const auto move = [i](editor::Document& document) {
      return editor::MoveHandles(document, {{1000, 0}}, {0.01 * (i + 1), 0.0});
    };
    if (i == 0)
      session.Do(move);
    else
      session.Again(move);
  });
  session.Do([](editor::Document& document) { return editor::Reset(document); });
  const auto undo = Clock::now();
  session.Undo();
  fmt::print("{:28} {:.2f} ms\n", "undo of a reset", Milliseconds(undo));
  const auto check = Clock::now();
  const std::size_t findings = session.Findings().size();
  fmt::print("{:28} {:.0f} ms, {} findings\n", "the check before saving", Milliseconds(check), findings);
}

}  // namespace

int main() {
  auto folder = base::TemporaryFolder::Make("editor-bench");
  if (!folder) return 1;
  for (const char* kind : {"JPEG", "PNG"}) Try(kind, folder.value().path());
  return 0;
}
