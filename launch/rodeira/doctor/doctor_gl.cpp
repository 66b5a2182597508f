// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/doctor/doctor_gl.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <sstream>

#include "common/core/base/result.hpp"
#include "launch/rodeira/doctor/capture.hpp"

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;

constexpr const char* kInstall = "sudo apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri";
constexpr int kSize = 64;  // of the picture, pixels each way

constexpr const char* kVertexShader = "#version 120\nvoid main() { gl_Position = gl_Vertex; }\n";
constexpr const char* kFragmentShader = "#version 120\nvoid main() { gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0); }\n";

// EGL and OpenGL by name, so that nothing is linked.
class Gl {
 public:
  base::Status Load(const std::string& library) {
    void* handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr)
      return base::Failed("system.no_opengl", fmt::format("{} cannot be loaded ({})", library, ::dlerror()));
    get_ = reinterpret_cast<decltype(get_)>(::dlsym(handle, "eglGetProcAddress"));
    if (get_ == nullptr)
      return base::Failed("system.no_opengl", fmt::format("{} is no EGL: it has no eglGetProcAddress", library));
    return {};
  }
  // Calls a function by its name; a missing one is remembered and gives a zero.
  template <class Function, class... Args>
  auto Call(const char* name, Args... args) {
    using Value = decltype((*static_cast<Function>(nullptr))(args...));
    const auto function = reinterpret_cast<Function>(get_(name));
    if (function != nullptr) return function(args...);
    missing_ = name;
    return Value();
  }
  const std::string& missing() const { return missing_; }

 private:
  decltype(&::eglGetProcAddress) get_ = nullptr;
  std::string missing_;
};

#define RODEIRA_GL(gl, name, ...) (gl).Call<decltype(&::name)>(#name __VA_OPT__(, ) __VA_ARGS__)

// The displays that need no display server, in the order that the view's library tries them, then the system's choice.
std::vector<EGLDisplay> Displays(Gl& gl) {
  std::vector<EGLDisplay> displays;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (gl.Call<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT", static_cast<EGLint>(devices.size()), devices.data(),
                                         &count) == EGL_TRUE) {
    for (EGLint i = 0; i < count; ++i) {
      displays.push_back(gl.Call<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
          "eglGetPlatformDisplayEXT", EGLenum{EGL_PLATFORM_DEVICE_EXT}, devices[static_cast<std::size_t>(i)],
          static_cast<const EGLint*>(nullptr)));
    }
  }
  displays.push_back(gl.Call<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      "eglGetPlatformDisplayEXT", EGLenum{EGL_PLATFORM_SURFACELESS_MESA}, static_cast<void*>(EGL_DEFAULT_DISPLAY),
      static_cast<const EGLint*>(nullptr)));
  displays.push_back(RODEIRA_GL(gl, eglGetDisplay, EGL_DEFAULT_DISPLAY));
  std::erase(displays, EGL_NO_DISPLAY);
  return displays;
}

base::Status MakeContext(Gl& gl, EGLDisplay display) {
  const auto failed = [&](const char* what) {
    return base::Failed("system.no_opengl", fmt::format("{} failed (0x{:x})", what, RODEIRA_GL(gl, eglGetError)));
  };
  EGLint major = 0;
  EGLint minor = 0;
  if (RODEIRA_GL(gl, eglInitialize, display, &major, &minor) != EGL_TRUE) return failed("eglInitialize");
  if (RODEIRA_GL(gl, eglBindAPI, EGLenum{EGL_OPENGL_API}) != EGL_TRUE) return failed("eglBindAPI(EGL_OPENGL_API)");
  const EGLint wanted[] = {EGL_SURFACE_TYPE,
                           EGL_PBUFFER_BIT,
                           EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_BIT,
                           EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_DEPTH_SIZE,
                           24,
                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint found = 0;
  if (RODEIRA_GL(gl, eglChooseConfig, display, wanted, &config, EGLint{1}, &found) != EGL_TRUE || found < 1)
    return failed("eglChooseConfig for a pbuffer with 24 bits of depth");
  const EGLint size[] = {EGL_WIDTH, kSize, EGL_HEIGHT, kSize, EGL_NONE};
  const EGLSurface surface = RODEIRA_GL(gl, eglCreatePbufferSurface, display, config, size);
  if (surface == EGL_NO_SURFACE) return failed("eglCreatePbufferSurface");
  const EGLint none[] = {EGL_NONE};
  const EGLContext context = RODEIRA_GL(gl, eglCreateContext, display, config, EGLContext{EGL_NO_CONTEXT}, none);
  if (context == EGL_NO_CONTEXT) return failed("eglCreateContext");
  if (RODEIRA_GL(gl, eglMakeCurrent, display, surface, surface, context) != EGL_TRUE) return failed("eglMakeCurrent");
  return {};
}

base::Status UseShaders(Gl& gl) {
  const GLuint program = gl.Call<PFNGLCREATEPROGRAMPROC>("glCreateProgram");
  for (const auto& [kind, text] :
       {std::pair(GLenum{GL_VERTEX_SHADER}, kVertexShader), std::pair(GLenum{GL_FRAGMENT_SHADER}, kFragmentShader)}) {
    const GLuint shader = gl.Call<PFNGLCREATESHADERPROC>("glCreateShader", kind);
    const GLchar* source = text;
    gl.Call<PFNGLSHADERSOURCEPROC>("glShaderSource", shader, GLsizei{1}, static_cast<const GLchar* const*>(&source),
                                   static_cast<const GLint*>(nullptr));
    gl.Call<PFNGLCOMPILESHADERPROC>("glCompileShader", shader);
    gl.Call<PFNGLATTACHSHADERPROC>("glAttachShader", program, shader);
  }
  gl.Call<PFNGLLINKPROGRAMPROC>("glLinkProgram", program);
  GLint linked = GL_FALSE;
  gl.Call<PFNGLGETPROGRAMIVPROC>("glGetProgramiv", program, GLenum{GL_LINK_STATUS}, &linked);
  if (linked != GL_TRUE) return base::Failed("system.no_opengl", "a shader of GLSL 1.20 cannot be compiled");
  gl.Call<PFNGLUSEPROGRAMPROC>("glUseProgram", program);
  return {};
}

// A green triangle over the lower left half on blue: a pixel of each is read back.
base::Status Draw(Gl& gl) {
  if (auto status = UseShaders(gl); !status) return status;
  RODEIRA_GL(gl, glViewport, 0, 0, kSize, kSize);
  RODEIRA_GL(gl, glClearColor, 0.0F, 0.0F, 1.0F, 1.0F);
  RODEIRA_GL(gl, glClear, GLbitfield{GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT});
  RODEIRA_GL(gl, glBegin, GLenum{GL_TRIANGLES});
  RODEIRA_GL(gl, glVertex2f, -1.0F, -1.0F);
  RODEIRA_GL(gl, glVertex2f, 1.0F, -1.0F);
  RODEIRA_GL(gl, glVertex2f, -1.0F, 1.0F);
  RODEIRA_GL(gl, glEnd);
  std::array<unsigned char, 4> inside{};
  std::array<unsigned char, 4> outside{};
  RODEIRA_GL(gl, glReadPixels, kSize / 4, kSize / 4, 1, 1, GLenum{GL_RGBA}, GLenum{GL_UNSIGNED_BYTE},
             static_cast<void*>(inside.data()));
  RODEIRA_GL(gl, glReadPixels, 3 * kSize / 4, 3 * kSize / 4, 1, 1, GLenum{GL_RGBA}, GLenum{GL_UNSIGNED_BYTE},
             static_cast<void*>(outside.data()));
  if (!gl.missing().empty()) return base::Failed("system.no_opengl", fmt::format("OpenGL has no {}", gl.missing()));
  if (std::memcmp(inside.data(), "\0\xFF\0", 3) != 0 || std::memcmp(outside.data(), "\0\0\xFF", 3) != 0) {
    return base::Failed(
        "system.no_opengl",
        fmt::format("a drawn pixel is ({}, {}, {}) where (0, 255, 0) was expected, and beside it ({}, {}, {}) instead "
                    "of (0, 0, 255)",
                    inside[0], inside[1], inside[2], outside[0], outside[1], outside[2]));
  }
  return {};
}

std::string GlString(Gl& gl, GLenum name) {
  const GLubyte* text = RODEIRA_GL(gl, glGetString, name);
  return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

// In the child: prints "drawn …" or "fault …".
int DrawOffScreen(const GlSettings& settings) {
  for (const auto& [name, value] : settings.environment) ::setenv(name.c_str(), value.c_str(), 1);
  Gl gl;
  const auto say = [](const char* word, const std::string& text) {
    std::printf("\n%s %s\n", word, text.c_str());
    std::fflush(stdout);
  };
  if (auto status = gl.Load(settings.library); !status) {
    say("fault", status.error().message);
    return 1;
  }
  std::string last = "EGL knows no display that needs no display server";
  for (const EGLDisplay display : Displays(gl)) {
    base::Status status = MakeContext(gl, display);
    if (status.ok()) status = Draw(gl);
    if (status.ok()) {
      say("drawn", fmt::format("{}, OpenGL {}", GlString(gl, GL_RENDERER), GlString(gl, GL_VERSION)));
      return 0;
    }
    last = status.error().message;
  }
  say("fault", last);
  return 1;
}

// What stands behind the last line that begins with `word`.
std::string LineWith(const std::string& output, const std::string& word) {
  std::istringstream lines(output);
  std::string found;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(word + " ")) found = line.substr(word.size() + 1);
  }
  return found;
}

}  // namespace

Finding CheckGl(const GlSettings& settings) {
  const Captured drawing = CaptureFork([&settings] { return DrawOffScreen(settings); }, 30s);
  if (drawing.well()) return Ok("GL", fmt::format("off-screen pictures by {}", LineWith(drawing.output, "drawn")));
  std::string why = LineWith(drawing.output, "fault");
  if (drawing.too_late) why = "drawing took more than 30 s";
  if (!drawing.status && !drawing.too_late) why = "the driver crashed";
  return Fault(
      "system.no_gl", "GL",
      fmt::format("no off-screen picture can be drawn: {}; without it the view node cannot run: {}", why, kInstall));
}

}  // namespace rodeira::cli
