// SPDX-License-Identifier: Apache-2.0
// Keys of a terminal and lines of a socket. The terminal is a pseudo-terminal with a child that has it as its own.
#include "launch/rodeira/run/operator.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "launch/rodeira/run/control_folder.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;

TEST(Operator, EveryKeyOfTheHelpDoesSomething) {
  EXPECT_EQ(CommandOfKey(' '), "toggle");
  EXPECT_EQ(CommandOfKey('\n'), "step");
  EXPECT_EQ(CommandOfKey('+'), "faster");
  EXPECT_EQ(CommandOfKey('-'), "slower");
  EXPECT_EQ(CommandOfKey('m'), "mark key m");
  EXPECT_EQ(CommandOfKey('q'), "stop");
  for (const char key : {'x', '\x1b', '\0', '0'}) EXPECT_EQ(CommandOfKey(key), "");
}

// A program on a terminal of its own, started by a session leader as a shell would: it takes keys, says each, and ends
// as its last key says: q well, k by SIGKILL. The leader then says how: "[left 0]", "[signal 9]".
class Terminal : public ::testing::Test {
 protected:
  Terminal() {
    leader_ = ::forkpty(&master_, nullptr, nullptr, nullptr);
    if (leader_ == 0) Lead();
  }
  ~Terminal() override {
    ::kill(leader_, SIGKILL);
    ::waitpid(leader_, nullptr, 0);
    ::close(master_);
  }
  static void Write(const std::string& text) { (void)!::write(STDOUT_FILENO, text.data(), text.size()); }
  [[noreturn]] static void Lead() {
    ::signal(SIGTTOU, SIG_IGN);
    const pid_t program = ::fork();
    if (program == 0) {
      ::setpgid(0, 0);
      ::tcsetpgrp(STDIN_FILENO, ::getpid());
      ::signal(SIGTTOU, SIG_DFL);
      TakeKeys();
    }
    int status = 0;
    ::waitpid(program, &status, 0);
    Write(WIFEXITED(status) ? "[left " + std::to_string(WEXITSTATUS(status)) + "]"
                            : "[signal " + std::to_string(WTERMSIG(status)) + "]");
    for (;;) ::pause();
  }
  [[noreturn]] static void TakeKeys() {
    auto keys = TerminalKeys::Open(STDIN_FILENO);
    if (keys == nullptr) ::_exit(3);
    (void)keys->Next();
    Write("up");
    for (;;) {
      const auto key = keys->Next();
      if (!key) {
        std::this_thread::sleep_for(1ms);
        continue;
      }
      Write(std::string(1, *key));
      if (*key == 'k') ::raise(SIGKILL);
      if (*key == 'q') break;
    }
    keys.reset();
    ::_exit(0);
  }
  bool Echoes() const {
    termios now{};
    EXPECT_EQ(::tcgetattr(master_, &now), 0);
    return (now.c_lflag & ECHO) != 0 && (now.c_lflag & ICANON) != 0;
  }
  bool SoonEchoes() const {
    for (int i = 0; i < 500; ++i) {
      if (Echoes()) return true;
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }
  std::string ReadUntil(const std::string& text) const {
    std::string all;
    char c = 0;
    while (all.find(text) == std::string::npos && ::read(master_, &c, 1) == 1) all += c;
    return all;
  }
  void Type(const std::string& keys) const {
    ASSERT_EQ(::write(master_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }
  int master_ = -1;
  pid_t leader_ = -1;
};

TEST_F(Terminal, KeysComeOneByOneAndTheTerminalIsPutBack) {
  EXPECT_EQ(ReadUntil("up"), "up");
  EXPECT_FALSE(Echoes());
  Type("a ");
  EXPECT_EQ(ReadUntil(" "), "a ") << "each once: no echo, no Enter";
  Type("q");
  EXPECT_EQ(ReadUntil("]"), "q[left 0]");
  EXPECT_TRUE(Echoes());
}

TEST_F(Terminal, KilledItIsPutBackTooByTheGuardian) {
  EXPECT_EQ(ReadUntil("up"), "up");
  EXPECT_FALSE(Echoes());
  Type("k");
  EXPECT_EQ(ReadUntil("]"), "k[signal 9]");
  EXPECT_TRUE(SoonEchoes());
}

// No copy of this process: another thread could hold a lock at that moment.
TEST_F(Terminal, TheGuardianIsAProgramOfItsOwn) {
  EXPECT_EQ(ReadUntil("up"), "up");
  std::vector<std::string> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::error_code none;
    const std::string program = std::filesystem::read_symlink(entry.path() / "exe", none).filename().string();
    std::ifstream stat(entry.path() / "stat");
    std::string text;
    std::getline(stat, text);
    const auto behind_name = text.rfind(") ");
    pid_t parent = 0;
    char state = 0;
    if (behind_name == std::string::npos) continue;
    std::istringstream(text.substr(behind_name + 2)) >> state >> parent;
    std::ifstream stat_of_parent("/proc/" + std::to_string(parent) + "/stat");
    std::getline(stat_of_parent, text);
    pid_t grandparent = 0;
    if (text.rfind(") ") == std::string::npos) continue;
    std::istringstream(text.substr(text.rfind(") ") + 2)) >> state >> grandparent;
    if (grandparent == leader_) children.push_back(program);
  }
  EXPECT_EQ(children, std::vector<std::string>{"rodeira-keys"});
}

TEST_F(Terminal, CtrlCKeepsItsMeaning) {
  EXPECT_EQ(ReadUntil("up"), "up");
  Type("\x03");
  EXPECT_NE(ReadUntil("]").find("[signal 2]"), std::string::npos);
  EXPECT_TRUE(SoonEchoes());
}

TEST(TerminalKeysTest, WhatIsNoTerminalHasNoKeys) {
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  EXPECT_EQ(TerminalKeys::Open(pipe[0]), nullptr);
  ::close(pipe[0]);
  ::close(pipe[1]);
}

class Socket : public ::testing::Test {
 protected:
  std::optional<AskedLine> Next(ControlServer& server) {
    for (int i = 0; i < 200; ++i) {
      if (auto asked = server.Next()) return asked;
      std::this_thread::sleep_for(1ms);
    }
    return std::nullopt;
  }
  static std::string Heard(int file) {
    char buffer[512];
    const ssize_t size = ::recv(file, buffer, sizeof(buffer), 0);
    return size > 0 ? std::string(buffer, static_cast<std::size_t>(size)) : "";
  }
  static void Say(int file, const std::string& text) {
    ASSERT_EQ(::send(file, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  const TemporaryFolder folder_;
  const std::filesystem::path path_ = ControlSocket(folder_.path(), "a run");
};

TEST_F(Socket, LinesInAnswersOutForSeveralAtATime) {
  auto server = ControlServer::Open(path_);
  ASSERT_TRUE(server.ok()) << server.error().Text();
  const int one = ConnectTo(path_), two = ConnectTo(path_);
  ASSERT_GE(one, 0);
  ASSERT_GE(two, 0);
  Say(one, "pau");
  EXPECT_FALSE(server.value()->Next().has_value()) << "half a line";
  Say(one, "se\nmark x\n");
  auto first = Next(*server.value());
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->line, "pause");
  auto second = Next(*server.value());
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->line, "mark x");
  Say(two, "state\n");
  auto third = Next(*server.value());
  ASSERT_TRUE(third.has_value());
  third->answer("ok three");
  first->answer("ok one");
  EXPECT_EQ(Heard(two), "ok three\n");
  EXPECT_EQ(Heard(one), "ok one\n");
  ::close(one);
  second->answer("ok nobody listens");
  ::close(two);
}

TEST_F(Socket, ALineWithoutEndIsCutOff) {
  auto server = ControlServer::Open(path_);
  ASSERT_TRUE(server.ok());
  const int one = ConnectTo(path_);
  Say(one, std::string(10'000, 'x'));
  EXPECT_FALSE(Next(*server.value()).has_value());
  EXPECT_EQ(Heard(one), "wrong command.too_long a line of more than 1024 bytes was found\n");
  ::close(one);
}

TEST_F(Socket, ALivingRunIsNotReplacedAndADeadOneIs) {
  EXPECT_TRUE(LivingRuns(folder_.path()).empty());
  {
    auto server = ControlServer::Open(path_);
    ASSERT_TRUE(server.ok());
    EXPECT_EQ(LivingRuns(folder_.path()), std::vector{path_});
    EXPECT_FALSE(ControlServer::Open(path_).ok());
  }
  EXPECT_FALSE(std::filesystem::exists(path_));
  // What a run that was killed leaves: a child binds it and dies.
  if (const pid_t child = ::fork(); child == 0) {
    auto server = ControlServer::Open(path_);
    ::_exit(server.ok() ? 0 : 1);
  } else {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0);
  }
  EXPECT_TRUE(std::filesystem::exists(path_));
  EXPECT_TRUE(LivingRuns(folder_.path()).empty());
  EXPECT_TRUE(ControlServer::Open(path_).ok());
}

TEST_F(Socket, NamesThatAreNoFileNamesAreHashed) {
  EXPECT_EQ(ControlSocket("/x", "lab-3.b").string(), "/x/lab-3.b.ctl");
  for (const std::string& name : std::vector<std::string>{"../../etc", "", ".hidden", "a b", std::string(200, 'a')}) {
    const auto path = ControlSocket("/x", name);
    EXPECT_EQ(path.parent_path(), "/x");
    EXPECT_EQ(path.stem().string().size(), 16u) << path;
  }
}

}  // namespace
}  // namespace rodeira::cli
